// Shapes without a closed form: expressions, meshes and level sets of frames.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/expression.h"
#include "geometry/mesh/polyline.h"
#include "geometry/shapes/makers.h"
#include "geometry/shapes/mesh_shape.h"
#include "geometry/shapes/sampled_mesh.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche::shape {
namespace {

constexpr double mesh_band = 5;         // voxels to each side; distances are true within the redistancing band
constexpr double steps_per_cell = 16;   // for central differences of phi; a power of two keeps linear phi exact
constexpr double reach_in_cells = 1e6;  // bound of phi / |grad phi|, e.g. if the gradient vanishes

// phi / |grad phi|: a first-order distance near phi = 0, exact if phi is linear.
template <int Dim>
struct ExpressionShape : ShapeField<Dim> {
  Expression phi;
  std::string text, where;
  double step = 0, reach = 0;  // m, in the shape's own frame

  explicit ExpressionShape(const Formula& formula) : phi(formula), text(formula) {}

  double at(const Vec<Dim>& x) const { return phi(extend<Dim>(x), 0); }

  double slope(const Vec<Dim>& x) const {
    Vec<Dim> gradient;
    for (int axis = 0; axis < Dim; ++axis) {
      const Vec<Dim> e = step * Vec<Dim>::Unit(axis);
      gradient[axis] = (at(x + e) - at(x - e)) / (2 * step);
    }
    return gradient.norm();
  }

  double operator()(const Vec<Dim>& x) const override {
    const double value = at(x);
    if (!std::isfinite(value)) {
      const Vec3 p = extend<Dim>(x);
      refuse(fmt::format("{}phi = \"{}\" is {} at ({:g}, {:g}, {:g}); it must be finite in the whole domain", where,
                         text, std::isnan(value) ? "nan" : "infinite", p[0], p[1], p[2]));
    }
    const double gradient = slope(x);
    if (value == 0) return 0;
    const double distance = std::isfinite(gradient) && gradient > 0 ? value / gradient : std::copysign(reach, value);
    return std::clamp(distance, -reach, reach);
  }
};

template <int Dim>
struct SampledShape : ShapeField<Dim> {
  std::unique_ptr<vdb::SampledDistance> distance;
  double operator()(const Vec<Dim>& x) const override { return (*distance)(extend<Dim>(x)); }
};

struct PolylineShape : ShapeField<2> {
  mesh::PolylineDistance distance;
  explicit PolylineShape(SurfaceMesh polylines) : distance(std::move(polylines)) {}
  double operator()(const Vec<2>& x) const override { return distance(extend<2>(x)); }
};

void transform_points(std::vector<Vec3>& points, const TransformSpec& t) {
  const Eigen::Matrix3d r = rotation<3>(t.rotate);
  for (Vec3& p : points) p = t.translate + r * (t.scale * p);
}

void require_cell_size(const ShapeOptions& options, const std::string& kind) {
  if (!(options.cell_size > 0)) refuse("the shape '" + kind + "' needs a positive cell size to be sampled");
}

}  // namespace

template <int Dim>
Field<Dim> make_expression(const ShapeSpec& spec, const ShapeOptions& options) {
  require_cell_size(options, spec.kind);
  if (spec.phi.empty()) refuse("the expression shape has no phi; give for example phi = \"y-0.5\"");
  auto field = std::make_unique<ExpressionShape<Dim>>(spec.phi);
  field->where = spec.where.empty() ? "" : spec.where + ": ";
  field->step = options.cell_size / spec.transform.scale / steps_per_cell;
  field->reach = options.cell_size / spec.transform.scale * reach_in_cells;
  return field;
}

void turn_inside_out(SurfaceMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  for (auto& s : mesh.segments) std::swap(s[0], s[1]);
}

template <int Dim>
SurfaceMesh read_shape_mesh(const ShapeSpec& spec, const ShapeOptions& options) {
  std::vector<std::string> notes;
  SurfaceMesh mesh = spec.kind == "polygon" ? close_polyline(spec.points)
                     : Dim == 2             ? read_closed_polylines(spec.file, notes)
                                            : read_closed_mesh(spec.file, notes);
  if (options.notes) options.notes->insert(options.notes->end(), notes.begin(), notes.end());
  transform_points(mesh.points, spec.transform);
  if (spec.invert) turn_inside_out(mesh);
  return mesh;
}

template <int Dim>
Field<Dim> make_mesh(const ShapeSpec& spec, const ShapeOptions& options) {
  require_cell_size(options, spec.kind);
  ShapeSpec upright = spec;
  upright.invert = false;  // make_shape() inverts the distance
  return make_mesh_shape<Dim>(read_shape_mesh<Dim>(upright, options), options.cell_size);
}

template <int Dim>
Field<Dim> make_level_set(const ShapeSpec& spec, const ShapeOptions&) {
  auto field = std::make_unique<SampledShape<Dim>>();
  field->distance = vdb::read_distance(spec.file, Dim);
  return field;
}

template SurfaceMesh read_shape_mesh<2>(const ShapeSpec&, const ShapeOptions&);
template SurfaceMesh read_shape_mesh<3>(const ShapeSpec&, const ShapeOptions&);
template Field<2> make_mesh<2>(const ShapeSpec&, const ShapeOptions&);
template Field<3> make_mesh<3>(const ShapeSpec&, const ShapeOptions&);
template Field<2> make_expression<2>(const ShapeSpec&, const ShapeOptions&);
template Field<3> make_expression<3>(const ShapeSpec&, const ShapeOptions&);
template Field<2> make_level_set<2>(const ShapeSpec&, const ShapeOptions&);
template Field<3> make_level_set<3>(const ShapeSpec&, const ShapeOptions&);

}  // namespace seiche::shape

namespace seiche {

template <int Dim>
std::unique_ptr<ShapeField<Dim>> make_mesh_shape(SurfaceMesh mesh, double cell_size) {
  if constexpr (Dim == 2) {
    return std::make_unique<shape::PolylineShape>(std::move(mesh));
  } else {
    auto field = std::make_unique<shape::SampledShape<3>>();
    field->distance = std::make_unique<SampledMesh>(std::move(mesh), cell_size, shape::mesh_band);
    return field;
  }
}

template std::unique_ptr<ShapeField<2>> make_mesh_shape<2>(SurfaceMesh, double);
template std::unique_ptr<ShapeField<3>> make_mesh_shape<3>(SurfaceMesh, double);

}  // namespace seiche
