#pragma once
// Contact and friction between rigid and deformable bodies over one time interval: incremental potential contact (Li et
// al. 2020; rigid bodies: Ferguson et al. 2021). Impacts are inelastic. docs/contact.md has the equations.
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "solid/body/body.h"
#include "solid/energy/rigid_problem.h"
#include "solid/energy/velocity_potential.h"

namespace seiche {

enum class BodyControl { free, prescribed, deformable };

struct ContactBody {
  SurfaceMesh surface;  // in the rest pose: closed, or a sheet that is touched on both sides; empty: touches nothing
  BodyControl control = BodyControl::free;
  double mass = 0;                 // kg (kg/m in 2D) of a free or deformable body
  std::optional<double> friction;  // Coulomb's coefficient
  std::string name;
  // Deformable bodies: the mesh node of each point of `surface`, and the number of nodes of the mesh.
  std::vector<int> nodes = {};
  int node_count = 0;
  // Flags of pinned points (empty: none). Primitives with all points pinned do not collide with walls and prescribed
  // bodies, so pinned parts may rest on them.
  std::vector<char> pinned = {};
};

// Coefficients of pairs of bodies, the lower index first; the second is -1 for all walls.
using PairCoefficients = std::map<std::array<int, 2>, double>;

// The half-space behind the plane is closed to bodies. A wall has no friction coefficient of its own.
struct ContactWall {
  Vec3 point, normal;  // the normal points into the domain
};

// Motion of one body. Free body: `start`, whose pivot is the centre of mass at rest. Prescribed body: `start` and
// `end`. Deformable body: nodal displacements at the start (m), Dim numbers a node.
struct ContactMotion {
  Pose start, end;
  Eigen::VectorXd displacement = {};
  // Velocities of its unknowns from which Newton's method may start. Empty: from rest.
  Eigen::VectorXd guess = {};
};

struct ContactOptions {
  double reach = 1e-3;            // d^ (m), the distance below which the barrier acts; meant as 0.02 to 0.1 of a cell
  double acceleration = 9.81;     // m/s^2: kappa holds the heaviest body's weight at half the reach
  double creep_speed = 1e-4;      // eps_v (m/s): velocity below which friction is static, apart from creep of this size
  double usual_speed = 1;         // m/s: velocity scale of convergence tests when everything is at rest
  double speed_tolerance = 1e-5;  // m/s: Newton stops when its step moves no point faster
  int newton_limit = 200;         // Newton iterations for fixed friction forces
  int friction_limit = 30;        // updates of the friction forces
  bool keeps_hessian = false;     // ContactReport::hessian is wanted
};

struct BodyImpulse {
  Vec3 linear{0, 0, 0}, angular{0, 0, 0};  // N s; N m s about the centre of mass (prescribed body: about its pivot)
};

// Normal impulse of contact at one place. The other body gets the opposite.
struct PairImpulse {
  int first, second;   // bodies; second below 0: wall -1 - second
  Vec3 point, linear;  // m; N s on the first body
};

enum class FrictionState { none, settled, unsettled };

struct ContactReport {
  std::string failure;                 // empty if the velocities minimise the energy without intersections
  Eigen::VectorXd velocity, gradient;  // stacked: m/s and rad/s; gradient of e there, N s and N m s
  // Gradient of e, contact, friction and potential. Zero at free degrees of freedom, else the constraint impulse.
  Eigen::VectorXd residual;
  int active = 0;  // pairs within reach
  int newton_iterations = 0, solves = 0, friction_updates = 0;
  double smallest_gap = 0;  // m, of the pairs within reach; equals `reach` if there are none
  double stiffness = 0;     // kappa (N/m)
  // Fraction of the straight paths to the end positions that is free of collisions. At 1, no body has passed another in
  // this interval. Below 1 one may have passed, or bodies only rotate about their contacts; halve the interval to tell.
  double straight_share = 1;
  FrictionState friction = FrictionState::none;
  std::vector<BodyImpulse> impulses;  // from contact, one a body
  std::vector<PairImpulse> pairs;     // of pairs of bodies that do not deform, or of such a body and a wall
  // Second derivatives of contact, friction and potential in Newton's last iteration, in the columns of
  // InertiaProblem::columns() alone. Empty: none.
  Eigen::SparseMatrix<double> hessian = {};
};

// Bodies and walls prepared for any number of solves. Copies share the prepared data.
template <int Dim>
class ContactScene {
 public:
  struct Data;
  // `apart`: pairs of bodies that never touch each other, as jointed ones; ascending, the lower index first.
  // `friction`: coefficients of pairs in place of those of both bodies. Throws Error(bad_input) on indices out of
  // range.
  ContactScene(const std::vector<ContactBody>& bodies, const std::vector<ContactWall>& walls,
               std::vector<std::array<int, 2>> apart = {}, PairCoefficients friction = {});
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

// Solves for the velocities over the interval, stacked in the order of the bodies: twists of free bodies, nodal
// velocities of deformable ones (Dim numbers each), nothing for prescribed ones. They minimise
//   e(v) + dt/H B(x(v)) + dt D(v) + P(v),
// with the barrier energy B of all near pairs at the positions x(v) after H, the friction D and the potential P.
// `start`: velocities of an earlier solve for the same bodies and motions, from which Newton's method continues; empty:
// none. horizon, dt: s. ContactReport::failure tells why there is no solution.
template <int Dim>
ContactReport solve_contact(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions, double horizon,
                            double dt, InertiaProblem& inertia, const ContactOptions& options,
                            const Eigen::VectorXd& start = {}, const VelocityPotential* potential = nullptr);

// The report of solve_contact() if no contact acts at the minimum of e alone, which has this velocity and gradient;
// else none. For problems without a potential.
template <int Dim>
std::optional<ContactReport> report_without_contact(const ContactScene<Dim>& scene,
                                                    const std::vector<ContactMotion>& motions, double horizon,
                                                    double dt, const InertiaResponse& minimum,
                                                    const ContactOptions& options);

// The pose of a free body after moving for `horizon` with the generalised velocity `twist`.
template <int Dim>
Pose moved_pose(const Pose& start, const Eigen::Matrix<double, twist_size<Dim>, 1>& twist, double horizon);

// Fraction of the motion (0 to 1) that is certainly free of collisions and keeps a share of each gap. Free and
// deformable bodies move with `velocity` (stacked), prescribed ones to their end poses.
template <int Dim>
double largest_safe_fraction(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions, double horizon,
                             const Eigen::VectorXd& velocity);

struct Overlap {
  int body;   // index of a free or deformable body
  int other;  // index of a body (the same: self-intersection) or of a wall
  enum class With { body, wall } with;
  double depth;         // m; negative: the gap is below the clearance; 0 for self-intersection
  std::string message;  // names both
};

// Pairs with at least one moving body that intersect, contain each other or are closer than `clearance` (m), and
// deformable bodies that intersect themselves.
template <int Dim>
std::vector<Overlap> find_initial_overlaps(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions,
                                           double clearance);

}  // namespace seiche
