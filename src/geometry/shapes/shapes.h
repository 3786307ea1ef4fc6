#pragma once
// Shapes of a scene as signed distances (or, for expressions, level sets): negative inside.
#include <memory>
#include <string>
#include <vector>

#include "base/shape_spec.h"
#include "geometry/mesh/mesh.h"

namespace seiche {

template <int Dim>
class ShapeField {
 public:
  virtual ~ShapeField() = default;
  // Signed distance at x (m), negative inside. Must be called by one thread at a time. Expressions return the
  // first-order distance phi / |grad phi|.
  virtual double operator()(const Vec<Dim>& x) const = 0;
};

struct ShapeOptions {
  double cell_size = 0;                       // resolution of sampled meshes, contours and expressions' gradients, m
  std::vector<std::string>* notes = nullptr;  // notes about repaired files, for the log
};

// Builds the shape with its transform and inversion applied. Throws Error(bad_input) naming spec.where.
template <int Dim>
std::unique_ptr<ShapeField<Dim>> make_shape(const ShapeSpec& spec, const ShapeOptions& options);

// The names of the shape table, for the reader and the documentation.
std::vector<std::string> shape_names();

// The surface of a shape as a mesh, for pictures and .vtu frames: the file's own facets for "mesh", otherwise
// contoured on a grid of the given spacing within [lower, upper]. 2D gives segments.
template <int Dim>
SurfaceMesh shape_surface(const ShapeSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                          const Vec<Dim>& upper);

// The zero contour of a field on a grid of the given spacing. The shape is cut off flat at [lower, upper], so that its
// surface is closed.
template <int Dim>
SurfaceMesh closed_contour(const ShapeField<Dim>& field, double spacing, const Vec<Dim>& lower, const Vec<Dim>& upper);

}  // namespace seiche
