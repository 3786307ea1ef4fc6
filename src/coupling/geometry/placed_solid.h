#pragma once
// A solid at one time, as the grid sees it: placed by its pose, or by its deformed surface.
#include <memory>

#include "coupling/geometry/step_geometry.h"

namespace seiche {

template <int Dim>
class PlacedSolid {
 public:
  virtual ~PlacedSolid() = default;

  // Writes the signed distance (m) at the nodes of the returned box. Other nodes are far from the solid.
  virtual Box<Dim> fill(NodeField<Dim>& distance) const = 0;
  // Signed distance, m. For deformed surfaces limited as in SurfaceDistance::distance.
  virtual double distance(const Vec<Dim>& x) const = 0;
  // True if the segment from x to y crosses the surface. For thin solids. The segment spans at most two cells along
  // each axis.
  virtual bool lies_between(const Vec<Dim>& x, const Vec<Dim>& y) const = 0;
  // Position of a point beside the solid after moving with it from this placement to `other`.
  virtual Vec<Dim> carried_to(const PlacedSolid& other, const Vec<Dim>& x) const = 0;

  // True if the surface moves with nodal velocities instead of the pose.
  virtual bool deforms() const { return false; }
  // Nodes and weights of the surface velocity near x. Empty if the surface is not near, or if deforms() is false.
  virtual SurfaceWeights weights_at(const Vec<Dim>&) const { return {}; }
  // True if each face is closed entirely or not at all, as by thin deforming solids. Their stretching changes the flux
  // balance of a cell. Slivers left open beside sealed faces would carry that volume away.
  virtual bool closes_whole_faces() const { return false; }
  // Sets `gaps` and `weight` of a face that the solid seals. `centers`: centres of the cells below and above, m.
  virtual void measure_gaps(const std::array<Vec<Dim>, 2>& /*centers*/, SealedFace&) const {}
};

// The result keeps references to `layout` and `body`.
template <int Dim>
std::unique_ptr<PlacedSolid<Dim>> place_solid(const Layout<Dim>& layout, const Body<Dim>& body,
                                              const Placement& placed);

}  // namespace seiche
