#pragma once
// The solids as the grid sees them at one time: distances at nodes, what faces let through, which body closes a face.
#include <memory>
#include <vector>

#include "coupling/geometry/joints.h"
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

// What each face share of an elastic body hangs on: nodes of its mesh with their weights. Of a thick body the nearest
// point of the surface, of a thin one the mean of the surface within some cells; none where there is none near.
using FaceWeights = std::vector<SurfaceWeights>;

// What the velocity of a body's unknown takes out of a cell besides what the body's faces show, per face area.
struct CellFlux {
  Site cell;
  int column;
  double value;
};
using CellFluxes = std::vector<CellFlux>;

// A face between cells that a thin body parts, or one of which lies within it.
struct SealedFace {
  Site face;
  int axis, body;
  // Of an elastic body: how far it is from the centres of the cells below and above, along the axis, m; and n_a^2, n
  // its normal there, which sums to one over the axes.
  std::array<double, 2> gaps{};
  double weight = 0;
};

template <int Dim>
class PlacedSolid;

template <int Dim>
struct StepGeometry {
  NodeField<Dim> psi;                 // distance to the nearest solid, m, negative inside
  NodeField<Dim, std::int16_t> body;  // index of that solid, -1 without solids
  FaceGeometry<Dim> faces;
  std::vector<std::shared_ptr<const FaceShares>> shares;  // of each body, on the owned faces and two layers around
  std::vector<std::shared_ptr<const FaceWeights>> face_weights;  // of each body that deforms; else null
  std::vector<std::shared_ptr<const CellFluxes>> cell_fluxes;    // likewise, once they are coupled; else null
  std::vector<SealedFace> sealed;                                // likewise
  // Of each body as the solve finds it; after a step by halves poses and psi are those of its end, while shares, faces
  // and the velocities of twists are those of its middle.
  std::vector<Placement> placed;
  std::vector<Vec3> pivots;  // reference points as the solve finds them

  bool deforms(int k) const { return face_weights[std::size_t(k)] != nullptr; }
};

// Lets a body move with a twist and, if it deforms, the velocities of its nodes: its share of each face pushes volume
// through it.
template <int Dim>
void set_motion(const Layout<Dim>& layout, int body, const Placement& motion, StepGeometry<Dim>& g);
template <int Dim>
void set_twist(const Layout<Dim>& layout, int body, const Twist& twist, StepGeometry<Dim>& g);

template <int Dim>
void set_node_velocity(const Layout<Dim>& layout, int body, const Eigen::VectorXd& velocity, StepGeometry<Dim>& g);

// The velocity along an axis of what a share hangs on.
template <int Dim>
double velocity_at(const SurfaceWeights& weights, int axis, const Eigen::VectorXd& node_velocity);

template <int Dim>
class SolidGeometry {
 public:
  SolidGeometry(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, const std::vector<Body<Dim>>& bodies);

  // The solids as placed, at time t.
  StepGeometry<Dim> measure(const std::vector<Placement>& placed, double t) const;

  // Farthest any point of a moving body within the domain goes with these twists in dt, m.
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
  std::vector<JoinedFacet<Dim>> joints_;
  std::vector<double> radius_;  // of the moving bodies about their pivots, m
};

}  // namespace seiche
