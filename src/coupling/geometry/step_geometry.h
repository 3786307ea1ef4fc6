#pragma once
// The solids on the grid at one time: distances at nodes, open fractions of faces, and the share that each body closes.
#include <memory>
#include <vector>

#include "coupling/geometry/seams.h"
#include "fluid/boundary/domain_boundary.h"
#include "fluid/boundary/face_geometry.h"
#include "levelset/surface_distance.h"
#include "solid/rigid/state.h"

namespace seiche {

// The part of a face that one body closes. The parts of all bodies and the open fraction sum to one.
struct FaceShare {
  Site face;
  int axis;
  double closed;
};
using FaceShares = std::vector<FaceShare>;

// Per face share of an elastic body: mesh nodes and weights that interpolate the surface velocity there. Thick bodies
// use the nearest surface point, thin ones a local mean over the surface. Empty where the surface is not near.
using FaceWeights = std::vector<SurfaceWeights>;

// Entry of J besides the body's face shares: flux out of `cell` at unit velocity of the unknown `column`, per face
// area.
struct CellFlux {
  Site cell;
  int column;
  double value;
};
using CellFluxes = std::vector<CellFlux>;

// A face that a thin body closes as a whole: the body separates the centres of the adjacent cells or contains one.
struct SealedFace {
  Site face;
  int axis, body;
  // Elastic bodies only. gaps: distances along the axis from the centres of the lower and upper cell to the body, m; 0
  // for centres inside. weight: n_a^2 with the surface normal n; it sums to one over the axes.
  std::array<double, 2> gaps{};
  double weight = 0;
};

template <int Dim>
class PlacedSolid;

template <int Dim>
struct StepGeometry {
  NodeField<Dim> psi;                 // distance to the nearest solid, m, negative inside; without thin elastic solids
  NodeField<Dim, std::int16_t> body;  // index of that solid, -1: none
  FaceGeometry<Dim> faces;
  std::vector<std::shared_ptr<const FaceShares>> shares;         // per body; owned faces and two layers around
  std::vector<std::shared_ptr<const FaceWeights>> face_weights;  // per deforming body, one entry per share; else null
  std::vector<std::shared_ptr<const CellFluxes>> cell_fluxes;    // per deforming body, once coupled; else null
  std::vector<SealedFace> sealed;  // of all thin bodies; owned faces and two layers around
  // Placement of each body at the solve. After a leapfrog step, poses, psi and body are at the end of the step. Shares,
  // faces and the velocities of twists are at its middle.
  std::vector<Placement> placed;
  std::vector<Vec3> pivots;  // reference point of each body at the solve, m

  // One a body: it deforms, and moves by less than a tenth of a cell in the step. Empty: none is known to.
  std::vector<char> slow;

  // True if the flow is continued into body k to second order (docs/decisions/0049-flow-beside-solids.md).
  bool continues_flow(int k) const { return !deforms(k) || (!slow.empty() && slow[std::size_t(k)]); }
  bool deforms(int k) const { return face_weights[std::size_t(k)] != nullptr; }
};

// Sets the velocity of a body: its twist and, if it deforms, its nodal velocities (m/s). Updates faces.closed_flux by
// the change of s_k v.e at each share, and faces.cell_flux by that of the body's cell fluxes.
template <int Dim>
void set_motion(const Layout<Dim>& layout, int body, const Placement& motion, StepGeometry<Dim>& g);
template <int Dim>
void set_twist(const Layout<Dim>& layout, int body, const Twist& twist, StepGeometry<Dim>& g);

template <int Dim>
void set_node_velocity(const Layout<Dim>& layout, int body, const Eigen::VectorXd& velocity, StepGeometry<Dim>& g);

// Component along `axis` of the surface velocity with these `weights`, m/s. `node_velocity` is stacked node by node.
template <int Dim>
double velocity_at(const SurfaceWeights& weights, int axis, const Eigen::VectorXd& node_velocity);

template <int Dim>
class SolidGeometry {
 public:
  // `shared`: moving solids that may reach into each other.
  SolidGeometry(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, const std::vector<Body<Dim>>& bodies,
                SharedPairs shared = {});

  // Geometry for the given placements of all bodies; values of the domain's sides are those at time t (s).
  StepGeometry<Dim> measure(const std::vector<Placement>& placed, double t) const;

  // Upper bound of the distance (m) that any point of a body within the domain moves in dt at the given velocities.
  double largest_displacement(const std::vector<Placement>& placed, double dt) const;

 private:
  void measure_static();
  FaceField<Dim, std::int16_t> seal_static() const;
  bool seals(const PlacedSolid<Dim>& solid, double distance, int axis, const IVec<Dim>& face) const;
  FaceShares measure_moving(int body, const Placement& placed, NodeField<Dim>& scratch, StepGeometry<Dim>& g) const;
  FaceShares take_in(int body, const PlacedSolid<Dim>& solid, const Box<Dim>& box, NodeField<Dim>& scratch,
                     StepGeometry<Dim>& g) const;
  void close_faces(std::vector<FaceShares>& shares, StepGeometry<Dim>& g) const;
  void set_sides(double t, StepGeometry<Dim>& g) const;
  bool is_leaving(const Placement& placed, double radius) const;

  const Layout<Dim>& layout_;
  const DomainBoundary<Dim>& sides_;
  const std::vector<Body<Dim>>& bodies_;
  StepGeometry<Dim> still_;  // of the static bodies
  std::vector<SeamFacet<Dim>> seams_;
  SharedPairs shared_;
  std::vector<double> radius_;  // of the moving bodies about their pivots, m
};

}  // namespace seiche
