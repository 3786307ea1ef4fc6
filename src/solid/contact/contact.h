#pragma once
// Contact and friction between rigid and deformable bodies: incremental potential contact (Li et al. 2020; rigid
// bodies: Ferguson et al. 2021) over one interval of time. Impacts are inelastic. docs/contact.md has the equations.
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
  SurfaceMesh surface;  // closed, in the rest pose; empty: the body touches nothing
  BodyControl control = BodyControl::free;
  double mass = 0;                 // kg (kg/m in 2D) of a free or deformable body
  std::optional<double> friction;  // Coulomb's coefficient
  std::string name;
  // Of a deformable body: the mesh node of each point of `surface`, and how many nodes the mesh has.
  std::vector<int> nodes = {};
  int node_count = 0;
  // Whether each of those points is pinned (empty: none). What is pinned altogether does not collide with walls and
  // prescribed bodies: it may stand on them.
  std::vector<char> pinned = {};
};

// The half-space that bodies keep out of lies behind the plane; its friction counts as unset.
struct ContactWall {
  Vec3 point, normal;  // the normal points into the domain
};

// Of a free body: `start`, with the centre of mass at rest as its pivot. Of a prescribed one also `end`. Of a
// deformable one the displacements of its nodes at the start (m), Dim numbers a node.
struct ContactMotion {
  Pose start, end;
  Eigen::VectorXd displacement = {};
};

struct ContactOptions {
  double reach = 1e-3;            // d^ (m): bodies push each other when nearer; 0.02 to 0.1 of a cell is meant
  double acceleration = 9.81;     // m/s^2: that of a body's weight; sets the stiffness
  double creep_speed = 1e-4;      // eps_v (m/s): below it contacts stick, but for a creep of at most this
  double usual_speed = 1;         // m/s: what speeds are small against where all are at rest
  double speed_tolerance = 1e-5;  // m/s: a Newton step that moves no point faster ends the iteration
  int newton_limit = 200;         // iterations for one set of friction forces
  int friction_limit = 20;        // times that the friction forces are brought up to date
};

struct BodyImpulse {
  Vec3 linear{0, 0, 0}, angular{0, 0, 0};  // N s; N m s about the centre of mass (of a prescribed body: its pivot)
};

enum class FrictionState { none, settled, unsettled };

struct ContactReport {
  std::string failure;                 // empty if the velocities are an intersection-free minimum
  Eigen::VectorXd velocity, gradient;  // of e, stacked
  // Gradient of e, contact, friction and potential: zero where v is free, else the impulse that holds it.
  Eigen::VectorXd residual;
  int active = 0;  // pairs within reach
  int newton_iterations = 0, solves = 0, friction_updates = 0;
  double smallest_gap = 0;  // m, of the pairs within reach; `reach` if there are none
  double stiffness = 0;     // kappa (N/m)
  // How far bodies can go straight to where they end. 1: surely none has got round another in this interval. Below 1
  // one may have, or bodies only turned about their contacts; halve the interval to tell.
  double straight_share = 1;
  FrictionState friction = FrictionState::none;
  std::vector<BodyImpulse> impulses;  // by contact, one a body
};

// Bodies and walls prepared for any number of solves. Copies share what was prepared.
template <int Dim>
class ContactScene {
 public:
  struct Data;
  // Throws Error(bad_input) on indices out of range.
  ContactScene(const std::vector<ContactBody>& bodies, const std::vector<ContactWall>& walls);
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

// The accepted velocities over the interval, stacked in the order of the bodies: twists of free ones, velocities of all
// nodes of deformable ones (Dim numbers each), none of prescribed ones. They are the minimum of
//   e(v) + dt/H B(x(v)) + dt D(v) + P(v),
// B the barrier energy of all near pairs where v leads to after H, D the friction, P the potential. `start` may give
// the velocities that an earlier solve found for the same bodies and motions: Newton's method then goes on from there.
template <int Dim>
ContactReport solve_contact(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions, double horizon,
                            double dt, InertiaProblem& inertia, const ContactOptions& options,
                            const Eigen::VectorXd& start = {}, const VelocityPotential* potential = nullptr);

// The pose of a free body after moving for `horizon` with the generalised velocity `twist`.
template <int Dim>
Pose moved_pose(const Pose& start, const Eigen::Matrix<double, twist_size<Dim>, 1>& twist, double horizon);

// The share of the motion (0 to 1) that surely is free of collisions, leaving a share of each gap. Free bodies move
// and deformable ones with `velocity` (stacked), prescribed ones to their end poses.
template <int Dim>
double largest_safe_fraction(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions, double horizon,
                             const Eigen::VectorXd& velocity);

struct Overlap {
  int body;   // index of a free or deformable body
  int other;  // index of a body (the same: it intersects itself), or of a wall
  enum class With { body, wall } with;
  double depth;         // m; negative: apart by less than the clearance; 0 where a body intersects itself
  std::string message;  // names both
};

// Pairs with at least one body that moves freely that intersect, contain one another's matter or are closer than
// `clearance` (m); deformable bodies that intersect themselves.
template <int Dim>
std::vector<Overlap> find_initial_overlaps(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions,
                                           double clearance);

}  // namespace seiche
