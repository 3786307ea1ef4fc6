#include "solid/mesh/cgal_adapter.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/make_mesh_3.h>

#include <deque>
#include <map>

#include "base/error.h"

namespace seiche::cgal {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

[[noreturn]] void fail(const std::string& what) {
  throw Error(ExitCode::bad_input, "no elements can be made of the shape: " + what);
}

// Numbers vertices in the order of their first use by elements.
template <class Handle, int Dim>
class Numbering {
 public:
  explicit Numbering(ElasticMesh<Dim>& mesh) : mesh_(mesh) {}
  int operator()(const Handle& vertex) {
    const auto [at, is_new] = numbers_.try_emplace(vertex, int(mesh_.nodes.size()));
    if (is_new) {
      Vec<Dim> x;
      for (int a = 0; a < Dim; ++a) x[a] = CGAL::to_double(vertex->point()[a]);
      mesh_.nodes.push_back(x);
    }
    return at->second;
  }

 private:
  ElasticMesh<Dim>& mesh_;
  std::map<Handle, int> numbers_;
};

namespace plane {

using Vertex = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using Face = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Mesher = CGAL::Delaunay_mesher_2<Triangulation, Criteria>;

Kernel::Point_2 point(const Vec3& x) {
  return {x[0], x[1]};
}

// Inside are the faces whose shortest way from infinity crosses the outline an odd number of times. Decided by
// adjacency, not by position: slivers along straight sides have no reliable position.
void mark_inside(Triangulation& t) {
  std::map<Triangulation::Face_handle, int> crossings;
  std::deque<std::pair<Triangulation::Face_handle, int>> next{{t.infinite_face(), 0}};
  while (!next.empty()) {
    const auto [face, count] = next.front();
    next.pop_front();
    if (!crossings.try_emplace(face, count).second) continue;
    face->set_in_domain(count % 2 == 1);
    for (int i = 0; i < 3; ++i) {
      if (t.is_constrained({face, i})) {
        next.emplace_back(face->neighbor(i), count + 1);
      } else {
        next.emplace_front(face->neighbor(i), count);
      }
    }
  }
}

}  // namespace plane

namespace space {

using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Polyhedron>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

Polyhedron polyhedron(const SurfaceMesh& surface) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3& x : surface.points) points.emplace_back(x[0], x[1], x[2]);
  std::vector<std::vector<std::size_t>> faces;
  for (const auto& [a, b, c] : surface.triangles) faces.push_back({std::size_t(a), std::size_t(b), std::size_t(c)});
  if (!CGAL::Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(faces)) fail("its surface is not manifold");
  Polyhedron r;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, r);
  return r;
}

// Sizes are radii of circumscribed balls: 0.577 edges for a regular triangle, 0.612 for a regular tetrahedron.
Criteria criteria(const TetrahedraOptions& o) {
  namespace p = CGAL::parameters;
  return Criteria(p::edge_size = o.size, p::facet_angle = 25, p::facet_size = 0.58 * o.size,
                  p::facet_distance = o.distance, p::cell_radius_edge_ratio = 2, p::cell_size = 0.62 * o.size);
}

ElasticMesh<3> elements_of(const Complex& complex) {
  ElasticMesh<3> mesh;
  Numbering<Triangulation::Vertex_handle, 3> number(mesh);
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    for (int i = 0; i < 4; ++i) mesh.elements.push_back(number(cell->vertex(i)));
  }
  return mesh;
}

}  // namespace space
}  // namespace

ElasticMesh<2> triangulate(const SurfaceMesh& outline, double size) {
  constexpr double least_sine_squared = 0.125;  // of an angle, 20.7 degrees: termination is proven up to it
  plane::Triangulation t;
  try {
    for (const auto& [i, j] : outline.segments)
      t.insert_constraint(plane::point(outline.points[std::size_t(i)]), plane::point(outline.points[std::size_t(j)]));
  } catch (const plane::Triangulation::Intersection_of_constraints_exception&) {
    fail(
        "its outline crosses itself when drawn with edges of element_size, because it has parts, gaps or notches "
        "narrower than an element; lower element_size or remove such detail");
  }
  if (t.dimension() < 2) fail("its outline has no area");
  plane::mark_inside(t);
  plane::Mesher mesher(t, plane::Criteria(least_sine_squared, size));
  mesher.init(true);
  mesher.refine_mesh();
  ElasticMesh<2> mesh;
  Numbering<plane::Triangulation::Vertex_handle, 2> number(mesh);
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
    for (int i = 0; i < 3 && f->is_in_domain(); ++i) mesh.elements.push_back(number(f->vertex(i)));
  }
  if (mesh.elements.empty()) fail("its outline has no inside");
  return mesh;
}

ElasticMesh<3> tetrahedralize(const SurfaceMesh& surface, const TetrahedraOptions& options) {
  constexpr double sharp = 60;  // degrees
  namespace p = CGAL::parameters;
  try {
    space::Domain domain(space::polyhedron(surface));
    if (options.edges == SharpEdges::kept) domain.detect_features(sharp);
    const auto complex =
        CGAL::make_mesh_3<space::Complex>(domain, space::criteria(options), p::manifold(), p::no_odt(), p::no_lloyd(),
                                          p::perturb(p::time_limit = 0), p::exude(p::time_limit = 0));
    ElasticMesh<3> mesh = space::elements_of(complex);
    if (mesh.elements.empty()) fail("its surface has no inside");
    return mesh;
  } catch (const CGAL::Failure_exception& e) {
    fail(std::string("CGAL: ") + e.what());
  }
}

}  // namespace seiche::cgal
