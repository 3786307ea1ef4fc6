#pragma once
// The viscous operator of one step: minimises 1/2 (u-u*)'M(u-u*) + dt/2 z'Vz over z = (face velocities, body unknowns)
// subject to D u + J v = q. Equations: docs/viscous-operator.md.
#include <functional>
#include <memory>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include "fluid/boundary/domain_boundary.h"
#include "fluid/pressure/pressure.h"
#include "linalg/core/block_columns.h"

namespace seiche {

// Velocity of a rigid motion, m/s.
struct RigidField {
  Vec3 linear{0, 0, 0}, angular{0, 0, 0}, center{0, 0, 0};
  Vec3 at(const Vec3& x) const { return linear + angular.cross(x - center); }
};

// Data of a solid for the viscous operator. The index in the list is that of the scene's bodies.
template <int Dim>
struct ViscousSolid {
  bool no_slip = true;
  RigidField frame;        // known motion; for rigid unknowns zero, with v the velocity of the point `center`
  int first_unknown = -1;  // >= 0: index of the body's first unknown
  bool rigid = false;      // true: its unknowns are a twist: v, omega (2D: vx, vy, omega about z)
  // Elastic solids: appends the velocity along `axis` of the surface point nearest to a face, as weights of unknowns
  // counted from first_unknown.
  std::function<void(int axis, Site face, std::vector<std::pair<int, double>>& weights)> surface;

  bool moves_freely() const { return first_unknown >= 0; }
};

// phi, psi, body and u_star must be valid two cells (nodes: three) around the owned ones.
template <int Dim>
struct ViscousInput {
  const Layout<Dim>& layout;
  const Halo<Dim>& halo;
  const Communicator& ranks;
  const DomainBoundary<Dim>& sides;
  const CellField<Dim>& phi;
  const FaceGeometry<Dim>& faces;
  const NodeField<Dim>& psi;                 // signed distance from the nearest solid, m
  const NodeField<Dim, std::int16_t>& body;  // index of the nearest solid, -1: none
  const std::vector<ViscousSolid<Dim>>& solids;
  int unknowns;                     // number of unknowns of all bodies
  const CellField<Dim>& viscosity;  // Pa s, valid two cells around
  bool uniform_viscosity;
  double density;                // kg/m^3
  double dt, time;               // s; the time of the sides' velocities
  const FaceField<Dim>& u_star;  // m/s, ghosts filled
  const ProjectionInput<Dim>& projection;
  const PressureRows<Dim>& rows;
  const EdgeField<Dim>* edge_viscosity = nullptr;  // Pa s, one cell around; null: harmonic mean of the adjacent cells
};

// Unknown face velocities: faces that touch a pressure row or viscous liquid.
template <int Dim>
struct FaceRows {
  FaceField<Dim, std::int64_t> row;         // global row or -1, ghosts filled
  std::vector<std::pair<int, Site>> faces;  // owned (axis, face), in row order
  Row first = 0, global = 0;
};

template <int Dim>
struct ViscousSamples;

// Blocks of the coupled system:
//   F u + G v + D'p^ = f,  G'u + (H + Hvv) v + J^'p^ = g,  D u + J^ v = q;  p^ = -dt p, J^ = h^(Dim-1) J.
template <int Dim>
struct ViscousSystem {
  FaceRows<Dim> rows;
  DistributedMatrix F;              // M + dt V_uu, kg; the diagonal is the first entry of each row
  std::vector<double> mass;         // M, kg
  BlockColumns G;                   // dt V_uv: one block per body with unknowns, in the order of first_unknown
  Eigen::SparseMatrix<double> Hvv;  // dt V_vv, equal on all ranks
  std::vector<double> f;            // M u* + terms of known motions and pressures
  Eigen::VectorXd g;                // terms of known motions, equal on all ranks
  DistributedMatrix D;              // +- w h^(Dim-1): pressure rows by faces; columns ascend
  DistributedMatrix Dt;             // transpose of D
  std::vector<double> q;            // -(closed + prescribed + cell + missing flux) h^(Dim-1), m^Dim/s
  std::vector<double> schur_mass;   // about dt mu/h^Dim for each pressure row (Cahouet, Chabard 1988)
  std::shared_ptr<const ViscousSamples<Dim>> samples;
};

// Collective.
template <int Dim>
FaceRows<Dim> number_faces(const ViscousInput<Dim>& in);
template <int Dim>
ViscousSystem<Dim> assemble_viscosity(const ViscousInput<Dim>& in);

// Force and torque on a solid: N and N m; in 2D N/m and N.
struct SolidLoad {
  Vec3 force{0, 0, 0}, torque{0, 0, 0};
};

// Load on each solid, with the torque about about[k], for face velocities u (ghosts filled) and body unknowns v.
// Collective.
template <int Dim>
std::vector<SolidLoad> viscous_forces(const ViscousInput<Dim>& in, const ViscousSystem<Dim>& system,
                                      const FaceField<Dim>& u, const Eigen::VectorXd& v,
                                      const std::vector<Vec3>& about);

// Powers of viscous stress, W (2D: W/m).
struct ViscousPower {
  double dissipation = 0;  // what the stress takes from the flow: z'V z_strained; negative if these differ much
  double sides = 0;        // of the domain's sides on the fluid: sum of given velocities times the forces there
  double before = 0;       // what the stress would take from the motion before the step: z_before'V z_strained
};

// Face velocities (ghosts filled) and body unknowns. Keeps references.
template <int Dim>
struct ViscousMotion {
  const FaceField<Dim>& u;
  const Eigen::VectorXd& v;
};

// Power of the stress of the motion `strained` on the motion z and on that before the step. Collective.
template <int Dim>
ViscousPower viscous_power(const ViscousInput<Dim>& in, const ViscousSystem<Dim>& system,
                           const ViscousMotion<Dim>& strained, const ViscousMotion<Dim>& z,
                           const ViscousMotion<Dim>& before);

}  // namespace seiche
