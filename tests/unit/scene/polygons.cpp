// Corners of polygons in a scene.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace polygons_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

std::string region_with(const std::string& points) {
  return flat_scene + "[[liquid.region]]\nshape = \"polygon\"\n" + points + "\n";
}

}  // namespace

TEST_CASE("polygons: corners are read, and written as they were") {
  const std::string text = "points = [[0.1, 0.2], [\"w\", 0.2], [0.3, 0.7]]\n[parameters]\nw = 0.5";
  const Scene scene = parse(region_with(text));
  const std::vector<Vec3> corners{{0.1, 0.2, 0}, {0.5, 0.2, 0}, {0.3, 0.7, 0}};
  REQUIRE(scene.liquid.regions.size() == 1);
  CHECK(scene.liquid.regions[0].shape.points == corners);
  const std::string written = write_scene(scene);
  CHECK_THAT(written, Catch::Contains("points = [[0.1, 0.2], [0.5, 0.2], [0.3, 0.7]]"));
  CHECK(parse(written).liquid.regions[0].shape.points == corners);
}

TEST_CASE("polygons: what is no list of corners is refused with its line") {
  check_refused(region_with(""), "needs 'points'");
  check_refused(region_with("points = 3"), "liquid.region.0.points must be an array of points");
  check_refused(region_with("points = [1, 2, 3]"), "liquid.region.0.points.0");
  check_refused(region_with("points = [[0, 0], [1, 0]]"), "scene.toml:9: liquid.region.0.points gives 2 corners");
  check_refused(region_with("points = [[0, 0], [1, 0], [0, 0]]"), "gives 2 corners; an outline takes 3 or more");
  check_refused(region_with("points = [[0, 0], [1, 0],\n[1, 0], [0, 1]]"), "corners 2 and 3 are both (1, 0)");
  check_refused(region_with("points = [[0, 0], [1, 0], [nan, 1]]"), "liquid.region.0.points.2.0");
  check_refused(region_with("points = [[0, 0], [1, 0], [1, 1, 1]]"), "liquid.region.0.points.2 must have 2 components");
  check_refused(small_scene + "[[liquid.region]]\nshape = \"polygon\"\npoints = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n",
                "a polygon exists in 2D only");
}

}  // namespace polygons_tests
