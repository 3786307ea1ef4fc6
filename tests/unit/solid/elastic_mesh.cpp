// Meshes: boxes, boundary, promotion, quality, and rejected faults.
#include <Eigen/Dense>

#include "base/error.h"
#include "unit/solid/elastic_cases.h"

namespace elastic_mesh_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

template <int Dim>
ElasticMesh<Dim> box(int order) {
  Vec<Dim> upper;
  IVec<Dim> cells;
  for (int a = 0; a < Dim; ++a) {
    upper[a] = 1 + a;
    cells[a] = 2 + a;
  }
  return box_mesh<Dim>(Vec<Dim>::Zero(), upper, cells, order);
}

// Volume inside the surface, by the divergence theorem.
double enclosed(const SurfaceMesh& s) {
  double r = 0;
  for (const auto& t : s.triangles) r += s.points[t[0]].dot(s.points[t[1]].cross(s.points[t[2]])) / 6;
  for (const auto& l : s.segments) r += s.points[l[0]].cross(s.points[l[1]])[2] / 2;
  return r;
}

template <int Dim>
void check(ElasticMesh<Dim> mesh) {
  std::vector<std::string> notes;
  check_mesh(mesh, "body", notes);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Boxes have their volume, inside and by their surface", "[elastic]", ((int Dim), Dim), 2, 3) {
  const double volume = Dim == 2 ? 2 : 6;
  for (int order : {1, 2}) {
    auto mesh = box<Dim>(order);
    std::vector<std::string> notes;
    check_mesh(mesh, "box", notes);
    CHECK(notes.empty());
    CHECK(std::abs(mesh_quality(mesh).volume - volume) < 1e-13);
    auto surface = surface_of(mesh);
    CHECK(std::abs(enclosed(surface.facets) - volume) < 1e-13);
    const Eigen::VectorXd u = at_nodes(mesh, [](const Vec<Dim>& X) -> Vec<Dim> { return X + Vec<Dim>::Ones(); });
    move_surface(surface, mesh, u);  // twice as large
    CHECK(std::abs(enclosed(surface.facets) - volume * std::pow(2, Dim)) < 1e-11);
  }
}

TEST_CASE("Quality knows regular and flat simplices", "[elastic]") {
  const double h = std::sqrt(3.) / 2;
  ElasticMesh<2> mesh{1, {{0, 0}, {1, 0}, {0.5, h}, {0.5, -1e-3}}, {0, 1, 2, 1, 0, 3}};
  const MeshQuality q = mesh_quality(mesh);
  CHECK(q.worst_element == 1);
  CHECK(q.worst < 0.01);
  CHECK(std::abs(2 * q.mean - q.worst - 1) < 1e-12);
  CHECK(q.longest_edge == 1);
}

TEST_CASE("Faulty meshes are refused with the first ids", "[elastic]") {
  auto inverted = box<3>(1);
  std::swap(inverted.elements[4 * 7], inverted.elements[4 * 7 + 1]);
  CHECK_THROWS_WITH(check(inverted), Contains("body: 1 elements are inverted: 7"));
  auto flat = box<2>(2);
  for (int a = 0; a < 6; ++a) flat.nodes[flat.element(3)[a]][1] = 0;
  CHECK_THROWS_AS(check(flat), Error);
  ElasticMesh<2> two{1, {{0, 0}, {1, 0}, {0, 1}, {5, 0}, {6, 0}, {5, 1}}, {0, 1, 2, 3, 4, 5}};
  CHECK_THROWS_WITH(check(two), Contains("do not hang together") && Contains(": 1 "));
  ElasticMesh<2> outside{1, {{0, 0}, {1, 0}, {0, 1}}, {0, 1, 3}};
  CHECK_THROWS_WITH(check(outside), Contains("does not exist"));
  ElasticMesh<2> twice{1, {{0, 0}, {1, 0}, {0, 1}}, {0, 1, 1}};
  CHECK_THROWS_WITH(check(twice), Contains("node twice"));
  ElasticMesh<2> line{1, {{0, 0}, {1, 0}, {2, 0}}, {0, 1, 2}};
  CHECK_THROWS_WITH(check(line), Contains("no volume"));
  ElasticMesh<2> wild{1, {{0, 0}, {1, 0}, {0, std::nan("")}}, {0, 1, 2}};
  CHECK_THROWS_WITH(check(wild), Contains("not finite"));
  CHECK_THROWS_AS(check(ElasticMesh<3>{}), Error);
}

TEST_CASE("A node that no element has is dropped with a note", "[elastic]") {
  ElasticMesh<2> mesh{1, {{9, 9}, {0, 0}, {1, 0}, {0, 1}}, {1, 2, 3}};
  std::vector<std::string> notes;
  check_mesh(mesh, "body", notes);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains("dropped 1 nodes"));
  CHECK(mesh.nodes.size() == 3);
  CHECK(mesh.elements == std::vector<int>{0, 1, 2});
}

}  // namespace elastic_mesh_tests
