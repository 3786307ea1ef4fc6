// Meshes in a wrong unit are detected by their width before anything is computed.
#include <catch2/catch.hpp>

#include <fstream>

#include "base/error.h"
#include "base/scene.h"
#include "run/mesh_extents.h"
#include "unit/files/scratch.h"

namespace mesh_extents_tests {
using namespace seiche;

namespace {

// A tetrahedron of the given width as a solid of a domain of 1 m.
Scene scene_with(const std::filesystem::path& file, double width, SolidKind kind) {
  std::ofstream out(file);
  out << "v 0 0 0\nv " << width << " 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  Scene scene;
  scene.domain.cell_size = 0.05;
  SolidSpec solid;
  solid.name = "bunny";
  solid.kind = kind;
  solid.shape.kind = "mesh";
  solid.shape.file = file;
  solid.shape.where = "scene.toml:7";
  scene.solids.push_back(solid);
  return scene;
}

}  // namespace

TEST_CASE("a mesh far wider than the domain is refused or told, with the scale that would fit") {
  const ScratchFolder scratch;
  const auto file = scratch / "tetrahedron.obj";
  CHECK(check_mesh_extents(scene_with(file, 1, SolidKind::rigid)).empty());
  CHECK(check_mesh_extents(scene_with(file, 3, SolidKind::fixed)).empty());
  const auto told = check_mesh_extents(scene_with(file, 156, SolidKind::fixed));
  REQUIRE(told.size() == 1);
  CHECK(told[0] ==
        "scene.toml:7: 'bunny' is 156 m wide, the domain 1 m; is it in millimetres? scale = 0.001 makes it "
        "0.156 m");
  for (const SolidKind kind : {SolidKind::rigid, SolidKind::elastic})
    CHECK_THROWS_WITH(check_mesh_extents(scene_with(file, 156, kind)), told[0]);
  CHECK(check_mesh_extents(scene_with(file, 39, SolidKind::fixed)).at(0).find("centimetres") != std::string::npos);
  CHECK(check_mesh_extents(scene_with(file, 1e9, SolidKind::fixed)).at(0).find("a smaller scale") != std::string::npos);
  Scene scaled = scene_with(file, 156, SolidKind::rigid);
  scaled.solids[0].shape.transform.scale = 0.001;
  CHECK(check_mesh_extents(scaled).empty());
}

}  // namespace mesh_extents_tests
