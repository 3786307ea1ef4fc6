// Mesh files of every format: read back as written; truncated, inconsistent and mutated files are rejected with a
// message.
#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "base/error.h"
#include "solid/mesh/file.h"
#include "unit/files/scratch.h"
#include "unit/solid/elastic_cases.h"

namespace elastic_mesh_file_tests {
using namespace seiche;
using Catch::Matchers::Contains;

namespace {

using Folder = ScratchFolder;

template <int Dim>
std::string point(const Vec<Dim>& X) {
  const Vec3 x = extend<Dim>(X);
  return fmt::format("{} {} {}\n", x[0], x[1], x[2]);
}

// Nodes of element e, numbered from `first`. Gmsh swaps the last two nodes of a quadratic tetrahedron.
template <int Dim>
std::string cell(const ElasticMesh<Dim>& mesh, int e, int first, bool gmsh = false) {
  std::vector<int> n(mesh.element(e), mesh.element(e) + mesh.nodes_per_element());
  if (gmsh && n.size() == 10) std::swap(n[8], n[9]);
  std::string r;
  for (int i : n) r += fmt::format(" {}", i + first);
  return r;
}

template <int Dim>
int gmsh_type(int order) {
  return Dim == 2 ? (order == 1 ? 2 : 9) : (order == 1 ? 4 : 11);
}

template <int Dim>
std::string msh2(const ElasticMesh<Dim>& mesh) {
  std::string r = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.nodes.size());
  for (size_t n = 0; n < mesh.nodes.size(); ++n) r += fmt::format("{} ", 2 * n + 5) + point<Dim>(mesh.nodes[n]);
  r += fmt::format("$EndNodes\n$Elements\n{}\n1 15 2 0 1 5\n", mesh.element_count() + 1);
  ElasticMesh<Dim> tagged = mesh;
  for (int& n : tagged.elements) n = 2 * n + 5;
  for (int e = 0; e < mesh.element_count(); ++e) {
    r += fmt::format("{} {} 2 7 8{}\n", e + 2, gmsh_type<Dim>(mesh.order), cell(tagged, e, 0, true));
  }
  return r + "$EndElements\n";
}

template <int Dim>
std::string msh4(const ElasticMesh<Dim>& mesh) {
  const size_t count = mesh.nodes.size();
  std::string r = fmt::format("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {0} 1 {0}\n2 1 0 {0}\n", count);
  for (size_t n = 0; n < count; ++n) r += fmt::format("{}\n", n + 1);
  for (const auto& X : mesh.nodes) r += point<Dim>(X);
  r += fmt::format("$EndNodes\n$Elements\n1 {0} 1 {0}\n{1} 1 {2} {0}\n", mesh.element_count(), Dim,
                   gmsh_type<Dim>(mesh.order));
  for (int e = 0; e < mesh.element_count(); ++e) r += fmt::format("{}{}\n", e + 1, cell(mesh, e, 1, true));
  return r + "$EndElements\n";
}

template <int Dim>
std::string medit(const ElasticMesh<Dim>& mesh) {
  std::string r =
      fmt::format("MeshVersionFormatted 2\n# a comment\nDimension {}\nVertices {}\n", Dim, mesh.nodes.size());
  for (const auto& X : mesh.nodes) {
    for (double c : X) r += fmt::format("{} ", c);
    r += "0\n";
  }
  r += fmt::format("Edges 1\n1 2 0\n{} {}\n", Dim == 2 ? "Triangles" : "Tetrahedra", mesh.element_count());
  for (int e = 0; e < mesh.element_count(); ++e) r += cell(mesh, e, 1) + " 3\n";
  return r + "End\n";
}

template <int Dim>
std::string vtu(const ElasticMesh<Dim>& mesh) {
  const int type = Dim == 2 ? (mesh.order == 1 ? 5 : 22) : (mesh.order == 1 ? 10 : 24);
  std::string nodes, offsets, types, r = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece>\n";
  r += "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto& X : mesh.nodes) r += point<Dim>(X);
  for (int e = 0; e < mesh.element_count(); ++e) {
    nodes += cell(mesh, e, 0) + "\n";
    offsets += fmt::format("{} ", (e + 1) * mesh.nodes_per_element());
    types += fmt::format("{} ", type);
  }
  const std::string head = "<DataArray type=\"Int64\" format=\"ascii\" Name=", end = "</DataArray>\n";
  return r + end + "</Points><Cells>" + head + "\"connectivity\">\n" + nodes + end + head + "\"offsets\">\n" + offsets +
         end + head + "\"types\">\n" + types + end + "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

template <int Dim>
std::vector<std::pair<std::string, std::string>> files(const ElasticMesh<Dim>& mesh) {
  std::vector<std::pair<std::string, std::string>> r{
      {"a.msh", msh2(mesh)}, {"b.msh", msh4(mesh)}, {"c.vtu", vtu(mesh)}};
  if (mesh.order == 1) r.push_back({"d.mesh", medit(mesh)});
  return r;
}

template <int Dim>
ElasticMesh<Dim> sample(int order) {
  return box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Constant(0.3), IVec<Dim>::Constant(2), order);
}

void expect_refused(const Folder& folder, const std::string& name, const std::string& bytes, const std::string& words) {
  std::vector<std::string> notes;
  INFO(name << ": " << words);
  CHECK_THROWS_WITH(read_elastic_mesh<2>(folder.write(name, bytes), notes), Contains(words) && Contains(name));
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Mesh files are read as they were written", "[elastic]", ((int Dim), Dim), 2, 3) {
  const Folder folder;
  for (int order : {1, 2}) {
    const auto mesh = sample<Dim>(order);
    for (const auto& [name, bytes] : files(mesh)) {
      INFO(name << ", order " << order);
      std::vector<std::string> notes;
      const auto read = read_elastic_mesh<Dim>(folder.write(name, bytes), notes);
      CHECK(read.order == order);
      CHECK(read.elements == mesh.elements);
      CHECK(read.nodes == mesh.nodes);
      CHECK(notes.size() == (name == "a.msh" ? 1 : 0));
    }
  }
}

TEST_CASE("Mesh files that lie are refused", "[elastic]") {
  const Folder folder;
  std::vector<std::string> notes;
  CHECK_THROWS_WITH(read_elastic_mesh<2>(folder / "none.msh", notes), Contains("cannot be read"));
  expect_refused(folder, "x.obj", "v 0 0 0", "use .msh, .vtu or .mesh");
  expect_refused(folder, "x.msh", "", "0 bytes");
  expect_refused(folder, "x.msh", "version https://git-lfs.github.com/spec/v1\n", "git lfs pull");
  expect_refused(folder, "x.msh", "$MeshFormat\n4.1 1 8\n", "binary");
  expect_refused(folder, "x.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4294967296\n1 0 0 0\n",
                 ":5: 4294967296 nodes");
  expect_refused(folder, "x.msh",
                 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 nan 0\n$EndNodes\n$Elements\n1\n1 2 0 1 1 9\n",
                 "no node 9");
  expect_refused(folder, "x.mesh", "Dimension 2\nVertices 1\n0 0 0\nTriangles 1\n1 1 -2 0\nEnd\n",
                 ":5: there is no vertex -2");
  expect_refused(folder, "x.mesh", "Dimension 2\nVertices -1\n", "-1 vertices");
  expect_refused(folder, "x.vtu", "<VTKFile><Piece></Piece>", ":1: is not XML, or is cut short");
  expect_refused(folder, "x.vtu", "<VTKFile type=\"UnstructuredGrid\">\n</VTKFile>", ":1: <Piece> is missing");
  const auto solid = medit(sample<3>(1));
  expect_refused(folder, "x.mesh", solid, "no triangles");
}

// Files truncated or with bytes changed anywhere are either read or rejected with a message.
TEST_CASE("Mutated mesh files are read or refused", "[elastic]") {
  const Folder folder;
  std::mt19937 random(7);
  int refused = 0, tried = 0;
  for (const auto& [name, bytes] : files(sample<3>(1))) {
    for (int i = 0; i < 200; ++i, ++tried) {
      std::string wrong = i % 2 ? bytes : bytes.substr(0, random() % bytes.size());
      for (int k = 0; i % 2 && k < 3; ++k) wrong[random() % wrong.size()] = "0123456789- .eENa<>$\n"[random() % 21];
      std::vector<std::string> notes;
      try {
        read_elastic_mesh<3>(folder.write(name, wrong), notes);
      } catch (const Error& e) {
        CHECK(e.code() == ExitCode::bad_input);
        ++refused;
      }
    }
  }
  WARN("mesh files cut or changed: " << refused << " of " << tried << " refused");
  CHECK(2 * refused > tried);  // all truncated files except for missing trailing white space
}

}  // namespace elastic_mesh_file_tests
