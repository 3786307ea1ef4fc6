#pragma once
// A solid where it stands at one time, as the grid sees it: by its pose, or by its deformed surface.
#include <memory>

#include "coupling/geometry/step_geometry.h"

namespace seiche {

template <int Dim>
class PlacedSolid {
 public:
  virtual ~PlacedSolid() = default;

  // Writes the signed distance to the nodes of the box that is returned, m. Others are far away.
  virtual Box<Dim> fill(NodeField<Dim>& distance) const = 0;
  // Signed, m; of a deformed surface as SurfaceDistance has it.
  virtual double distance(const Vec<Dim>& x) const = 0;
  // Of a thin solid: whether the segment from x to y, at most two cells along each axis, meets its surface.
  virtual bool lies_between(const Vec<Dim>& x, const Vec<Dim>& y) const = 0;
  // Where a point beside the solid was in another placement of it.
  virtual Vec<Dim> carried_to(const PlacedSolid& other, const Vec<Dim>& x) const = 0;

  // Nodes whose velocities its surface has near x; no list at all where it moves as its pose does.
  virtual bool deforms() const { return false; }
  virtual SurfaceWeights weights_at(const Vec<Dim>&) const { return {}; }
  // Whether it closes faces altogether or not at all. What a thin solid stretches by over a cell could leave it
  // through a sliver beside sealed faces.
  virtual bool closes_whole_faces() const { return false; }
  // Sets gaps and weight of a face that it seals, between the cells with these centres.
  virtual void measure_gaps(const std::array<Vec<Dim>, 2>& /*centers*/, SealedFace&) const {}
};

// Keeps references to layout and body.
template <int Dim>
std::unique_ptr<PlacedSolid<Dim>> place_solid(const Layout<Dim>& layout, const Body<Dim>& body,
                                              const Placement& placed);

}  // namespace seiche
