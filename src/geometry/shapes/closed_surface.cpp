#include "geometry/shapes/closed_surface.h"

#include <array>
#include <utility>

#include <Eigen/Geometry>

#include "base/error.h"
#include "geometry/shapes/makers.h"
#include "geometry/shapes/tessellate.h"

namespace seiche {
namespace {

constexpr double chord_share = 0.05;  // chord error in cells; far below contact gaps
constexpr double plane_reach = 4;     // half width of a plane's face, in domain diagonals
constexpr double contour_margin = 2;  // contoured shapes are cut off this many cells beyond the domain

template <int Dim>
struct Row {
  const char* kind;
  SurfaceMesh (*tessellate)(const ShapeSpec&, double chord);
};
template <int Dim>
constexpr std::array<Row<Dim>, 4> primitives{{{"box", tessellate_box<Dim>},
                                              {"sphere", tessellate_sphere<Dim>},
                                              {"cylinder", tessellate_cylinder<Dim>},
                                              {"capsule", tessellate_capsule<Dim>}}};

// x -> translate + R (scale x). 2D: ignores z.
template <int Dim>
Vec3 to_world(const Vec3& own, const TransformSpec& t) {
  const Vec<Dim> turned = shape::rotation<Dim>(t.rotate) * truncate<Dim>(own);
  return extend<Dim>(Vec<Dim>(truncate<Dim>(t.translate) + t.scale * turned));
}

// The block behind the part of the plane near the domain. An inverted plane has the opposite normal.
template <int Dim>
SurfaceMesh plane_surface(const ShapeSpec& spec, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  const TransformSpec turn{1, spec.transform.rotate, Vec3::Zero()};
  const Vec3 up = (spec.invert ? -1 : 1) * to_world<Dim>(spec.normal, turn).stableNormalized();
  const Vec3 middle = extend<Dim>(Vec<Dim>(0.5 * (lower + upper))),
             on_plane = to_world<Dim>(spec.point, spec.transform);
  const Vec3 foot = middle - up.dot(middle - on_plane) * up;
  const double reach = plane_reach * (upper - lower).norm();
  // u, up, w right-handed; in 2D u and up span the plane of the scene
  const Vec3 u = Dim == 2 ? Vec3(up.cross(Vec3::UnitZ())) : up.unitOrthogonal(), w = u.cross(up);
  const Vec3 corner = foot - reach * (u + up) - (Dim == 3 ? reach : 0) * w;
  return block_surface<Dim>(corner, {2 * reach * u, reach * up, 2 * reach * w});
}

// Contours the shape itself; an inverted shape has the same surface facing the other way.
template <int Dim>
SurfaceMesh contoured_surface(ShapeSpec spec, const ShapeOptions& options, const Vec<Dim>& lower,
                              const Vec<Dim>& upper) {
  const bool inverted = std::exchange(spec.invert, false);
  const Vec<Dim> margin = Vec<Dim>::Constant(contour_margin * options.cell_size);
  const auto field = make_shape<Dim>(spec, options);
  SurfaceMesh mesh = closed_contour<Dim>(*field, options.cell_size, lower - margin, upper + margin);
  if (inverted) shape::turn_inside_out(mesh);
  return mesh;
}

template <int Dim>
SurfaceMesh primitive_surface(const ShapeSpec& spec, const ShapeOptions& options, const Row<Dim>& row) {
  make_shape<Dim>(spec, options);  // throws on impossible sizes
  SurfaceMesh mesh = row.tessellate(spec, chord_share * options.cell_size / spec.transform.scale);
  for (Vec3& p : mesh.points) p = to_world<Dim>(p, spec.transform);
  if (spec.invert) shape::turn_inside_out(mesh);
  return mesh;
}

}  // namespace

template <int Dim>
SurfaceMesh contact_surface(const ShapeSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                            const Vec<Dim>& upper) {
  for (const Row<Dim>& row : primitives<Dim>) {
    if (spec.kind == row.kind) return primitive_surface<Dim>(spec, options, row);
  }
  if (spec.has_facets()) return shape::read_shape_mesh<Dim>(spec, {options.cell_size, nullptr});
  if (spec.kind != "plane") return contoured_surface<Dim>(spec, options, lower, upper);
  make_shape<Dim>(spec, options);
  return plane_surface<Dim>(spec, lower, upper);
}

template SurfaceMesh contact_surface<2>(const ShapeSpec&, const ShapeOptions&, const Vec<2>&, const Vec<2>&);
template SurfaceMesh contact_surface<3>(const ShapeSpec&, const ShapeOptions&, const Vec<3>&, const Vec<3>&);

}  // namespace seiche
