#include "solid/mesh/meshing.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/shapes/closed_surface.h"
#include "geometry/shapes/makers.h"
#include "solid/mesh/cgal_adapter.h"
#include "solid/mesh/file.h"
#include "solid/mesh/fit.h"
#include "solid/mesh/outline.h"

namespace seiche {
namespace {

constexpr double most_elements = 2e6;            // above it the factors of a body exceed the memory of any machine
constexpr double sample_share = 0.25;            // of an element: sampling distance of a shape before meshing
constexpr double most_samples_of_formula = 5e7;  // samples of a formula in search of its surface: some 10 s
constexpr double fitted_distance = 0.1;  // of an element: largest error of Mesh_3's surface where nodes are fitted,
constexpr double kept_distance = 0.05;   // and for surfaces from files, where they are not
constexpr double whole_blocks = 1e-9;    // relative: tolerance for an extent of a whole number of elements in decimals
constexpr double warn_below_quality = 0.05;  // mean ratio; below it elements spoil the stiffness around them

[[noreturn]] void fail(const SolidSpec& spec, const std::string& what) {
  throw Error(ExitCode::bad_input, fmt::format("{}: solid '{}': {}", spec.shape.where, spec.name, what));
}

// x -> translate + R (scale x)
template <int Dim>
void transform(std::vector<Vec<Dim>>& nodes, const TransformSpec& t) {
  const auto turn = shape::rotation<Dim>(t.rotate);
  for (Vec<Dim>& x : nodes) x = truncate<Dim>(t.translate) + turn * Vec<Dim>(t.scale * x);
}

// An element of edge h has an area of about h^2/2.3 (regular triangle) or a volume of h^3/8.5 (regular tetrahedron).
template <int Dim>
void check_size(const SolidSpec& spec, const Vec<Dim>& extent, double volume) {
  const double h = spec.elastic.element_size, longest = extent.maxCoeff();
  if (h > longest * (1 + whole_blocks)) {
    fail(spec,
         fmt::format("element_size = {:g} m is larger than the solid, whose longest extent is {:g} m; make it {:g} "
                     "or less",
                     h, longest, longest / 2));
  }
  const double count = volume * (Dim == 2 ? 2.3 : 8.5) / std::pow(h, Dim);
  if (count <= most_elements) return;
  const double finest = h * std::pow(count / most_elements, 1. / Dim);
  fail(spec, fmt::format("element_size = {:g} m would make about {:.2g} elements; at most {:.0g} are possible, make it "
                         "{:.2g} m or more",
                         h, count, most_elements, finest));
}

// Divides each edge into the fewest equal blocks not longer than an element.
template <int Dim>
ElasticMesh<Dim> mesh_box(const SolidSpec& spec) {
  const ShapeSpec& s = spec.shape;
  const Vec<Dim> lower = truncate<Dim>(s.lower), upper = truncate<Dim>(s.upper),
                 size = s.transform.scale * (upper - lower);
  check_size<Dim>(spec, size, size.prod());
  const Vec<Dim> blocks = (size / spec.elastic.element_size * (1 - whole_blocks)).array().ceil().max(1.0);
  if (blocks.prod() * (Dim == 2 ? 2 : 6) > most_elements)
    fail(spec, fmt::format("element_size = {:g} m makes more than {:.0g} elements; raise it", spec.elastic.element_size,
                           most_elements));
  const IVec<Dim> cells = blocks.template cast<int>();
  ElasticMesh<Dim> mesh = box_mesh<Dim>(lower, upper, cells, 1);
  transform<Dim>(mesh.nodes, s.transform);
  return mesh;
}

template <int Dim>
double measure(const SurfaceMesh& surface) {
  double volume = 0;
  for (const auto& [a, b] : surface.segments) {
    const Vec3 &p = surface.points[std::size_t(a)], &q = surface.points[std::size_t(b)];
    volume += (p[0] * q[1] - p[1] * q[0]) / 2;
  }
  for (const auto& [a, b, c] : surface.triangles) {
    Eigen::Matrix3d corners;
    corners << surface.points[std::size_t(a)], surface.points[std::size_t(b)], surface.points[std::size_t(c)];
    volume += corners.determinant() / 6;
  }
  return volume;
}

double boundary_measure(const SurfaceMesh& surface) {
  double sum = 0;
  for (const auto& [a, b] : surface.segments)
    sum += (surface.points[std::size_t(b)] - surface.points[std::size_t(a)]).norm();
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3& p = surface.points[std::size_t(a)];
    sum += (surface.points[std::size_t(b)] - p).cross(surface.points[std::size_t(c)] - p).norm() / 2;
  }
  return sum;
}

// Well-shaped elements are no larger than the solid is thick; the thickness of a thin solid is about 2 V/A.
template <int Dim>
void check_thickness(const SolidSpec& spec, const SurfaceMesh& surface) {
  const double volume = measure<Dim>(surface), thickness = 2 * volume / boundary_measure(surface);
  if (thickness >= spec.elastic.element_size) return;
  const double count = volume * (Dim == 2 ? 2.3 : 8.5) / std::pow(thickness, Dim);
  if (count <= most_elements) return;
  fail(spec,
       fmt::format("it is about {:.2g} m thick; elements of that size would be about {:.2g} in number, and at most "
                   "{:.0g} are possible; make it thicker, or use shape = \"box\", whose elements may be flat",
                   thickness, count, most_elements));
}

// Sampled shapes: the contour's edges have notches of the sampling distance, which must not be kept.
bool is_sampled(const ShapeSpec& s) {
  return s.kind == "expression" || s.kind == "level_set";
}

// Sampling distance of formulas and level sets, a share of an element. They are sampled over the whole domain.
template <int Dim>
double sampling(const SolidSpec& spec, const Vec<Dim>& domain) {
  const double spacing = sample_share * spec.elastic.element_size;
  if (is_sampled(spec.shape) && (domain / spacing).prod() > most_samples_of_formula) {
    fail(spec, fmt::format("element_size = {:g} m is too small: the shape has no bounds of its own and would be "
                           "sampled every {:g} m all over the domain; raise element_size",
                           spec.elastic.element_size, spacing));
  }
  return spacing;
}

// Surface, sampled finely enough for the elements. At least one element must fit into it.
template <int Dim>
SurfaceMesh surface_to_mesh(const SolidSpec& spec, ShapeOptions options, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  options.cell_size = std::min(options.cell_size, sampling<Dim>(spec, upper - lower));
  SurfaceMesh surface = contact_surface<Dim>(spec.shape, options, lower, upper);
  if (surface.points.empty()) fail(spec, "the shape is empty within the domain");
  Vec3 low = surface.points[0], high = low;
  for (const Vec3& x : surface.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  check_size<Dim>(spec, truncate<Dim>(high - low), measure<Dim>(surface));
  check_thickness<Dim>(spec, surface);
  return surface;
}

// True if nodes are projected onto the shape. Given facets are the shape themselves.
bool is_curved(const ShapeSpec& s) {
  return s.kind != "box" && !s.has_facets();
}

template <int Dim>
ElasticMesh<Dim> fill(const SurfaceMesh& surface, const SolidSpec& spec) {
  const double size = spec.elastic.element_size;
  if constexpr (Dim == 2) {
    return cgal::triangulate(resample_outline(surface, size), size);
  } else {
    const double distance = (is_curved(spec.shape) ? fitted_distance : kept_distance) * size;
    return cgal::tetrahedralize(
        surface, {size, distance, is_sampled(spec.shape) ? cgal::SharpEdges::rounded : cgal::SharpEdges::kept});
  }
}

template <int Dim>
ElasticMesh<Dim> mesh_surface(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                              const Vec<Dim>& upper) {
  const SurfaceMesh surface = surface_to_mesh<Dim>(spec, options, lower, upper);
  try {
    return fill<Dim>(surface, spec);
  } catch (const Error& e) {
    fail(spec, e.what());
  }
}

template <int Dim>
ElasticMesh<Dim> read_mesh(const SolidSpec& spec, std::vector<std::string>& notes) {
  ElasticMesh<Dim> mesh = read_elastic_mesh<Dim>(spec.shape.file, notes);
  if (mesh.order > spec.elastic.element_order)
    fail(spec, fmt::format("element_order = 1, but the elements of '{}' are quadratic; leave it out",
                           spec.shape.file.filename().string()));
  transform<Dim>(mesh.nodes, spec.shape.transform);
  return mesh;
}

template <int Dim>
void note_poor_elements(const SolidSpec& spec, const ElasticMesh<Dim>& mesh, std::vector<std::string>& notes) {
  const MeshQuality q = mesh_quality(mesh);
  if (q.worst >= warn_below_quality) return;
  const int* nodes = mesh.element(q.worst_element);
  const Vec3 at = extend<Dim>(mesh.nodes[std::size_t(nodes[0])]);
  notes.push_back(
      fmt::format("solid '{}': its worst element, at ({:g}, {:g}, {:g}), has quality {:.3g} of 1; a mesh file "
                  "of better elements, or another element_size, would be solved more accurately",
                  spec.name, at[0], at[1], at[2], q.worst));
}

}  // namespace

template <int Dim>
ElasticMesh<Dim> mesh_solid(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                            const Vec<Dim>& upper) {
  std::vector<std::string> unheard;
  std::vector<std::string>& notes = options.notes ? *options.notes : unheard;
  const ShapeSpec& s = spec.shape;
  ElasticMesh<Dim> mesh;
  if (s.kind == "mesh" && holds_elements(s.file)) {
    mesh = read_mesh<Dim>(spec, notes);
  } else {
    mesh = s.kind == "box" ? mesh_box<Dim>(spec) : mesh_surface<Dim>(spec, options, lower, upper);
  }
  const bool fit = is_curved(s);
  const auto field = fit ? make_shape<Dim>(s, {options.cell_size, nullptr}) : nullptr;
  if (fit) fit_to_shape(mesh, *field);
  if (mesh.order < spec.elastic.element_order) {
    mesh = promote_to_quadratic(mesh);
    if (fit) fit_to_shape(mesh, *field);
  }
  check_mesh(mesh, fmt::format("{}: solid '{}'", s.where, spec.name), notes);
  note_poor_elements(spec, mesh, notes);
  return mesh;
}

template ElasticMesh<2> mesh_solid<2>(const SolidSpec&, const ShapeOptions&, const Vec<2>&, const Vec<2>&);
template ElasticMesh<3> mesh_solid<3>(const SolidSpec&, const ShapeOptions&, const Vec<3>&, const Vec<3>&);

}  // namespace seiche
