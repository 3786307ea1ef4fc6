#pragma once
// Finer surfaces of static and prescribed solids.
#include <memory>
#include <tuple>
#include <vector>

#include "base/solid_spec.h"
#include "geometry/shapes/shapes.h"
#include "render/frame.h"

namespace seiche::render {

// Replaces the surfaces of static and prescribed solids of frames, which the run sampled on its grid, by those of the
// scene's shapes. 2D: exact for boxes, planes and meshes, polygons of up to 256 corners for round shapes; formulas and
// level sets are contoured up to eight times finer. 3D: these alone, up to four times finer. Solids whose shape is not
// where the frame has them, as after a change of the scene, or cannot be read, keep the frame's surface.
//
// Keeps the shapes and their surfaces at rest from one frame to the next. `solids` must outlive it.
class SurfaceRefiner {
 public:
  explicit SurfaceRefiner(const std::vector<SolidSpec>& solids) : solids_(solids) {}
  void refine(LoadedFrame& frame);

 private:
  template <int Dim>
  struct Kept {
    double h = 0;  // m, of a cell of the frame; 0: nothing is kept
    std::shared_ptr<const ShapeField<Dim>> shape;
    Vec<Dim> lower, upper;  // the surface is that within this box
    SurfaceMesh surface;    // at rest; empty if it would be no finer than the frame's
  };
  template <int Dim>
  void refine_solid(LoadedFrame& frame, std::size_t n, double h);

  const std::vector<SolidSpec>& solids_;
  std::tuple<std::vector<Kept<2>>, std::vector<Kept<3>>> kept_;  // by solid
};

}  // namespace seiche::render
