// Scenes that include others.
#include <fmt/format.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "base/scene.h"
#include "scene/reader.h"
#include "unit/scene/common.h"

namespace include_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

// Scenes in a folder of their own.
class Files {
 public:
  void put(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  Scene read(const std::string& text, const std::vector<Override>& overrides = {}) const {
    put("scene.toml", text);
    return read_scene(folder_ / "scene.toml", overrides);
  }
  void check_refused(const std::string& text, const std::string& why) const {
    INFO(text);
    CHECK_THROWS_WITH(read(text), Contains(why));
  }

 private:
  ScratchFolder folder_;
};

const std::string ball =
    "[[solid]]\nname = \"{}\"\nkind = \"static\"\nshape = \"sphere\"\ncenter = [0.5, 0.5, 0.5]\nradius = \"size\"\n";

std::string ball_named(const std::string& name) {
  std::string text = ball;
  return text.replace(text.find("{}"), 2, name);
}

}  // namespace

TEST_CASE("a scene lies on top of those that it includes") {
  const Files files;
  files.put("tank.toml", "title = \"tank\"\n[parameters]\nsize = 0.1\n" + small_scene + ball_named("low"));
  files.put("inner/more.toml", "include = \"deep.toml\"\n" + ball_named("inner"));
  files.put("inner/deep.toml", ball_named("deep"));
  const Scene scene = files.read(
      "include = [\"tank.toml\", \"inner/more.toml\"]\ntitle = \"mine\"\n[parameters]\nsize = 0.2\n[time]\ncfl = "
      "0.7\n" +
      ball_named("top"));
  CHECK(scene.title == "mine");
  CHECK(scene.time.cfl == 0.7);
  CHECK(scene.time.end == 1);  // the tank's
  REQUIRE(scene.solids.size() == 4);
  const std::vector<std::string> order{"low", "deep", "inner", "top"};
  for (std::size_t n = 0; n < order.size(); ++n) {
    CHECK(scene.solids[n].name == order[n]);
    CHECK(scene.solids[n].shape.radius == 0.2);
  }
  CHECK(files.read("include = \"tank.toml\"\n", {{"solid.0.radius", "0.3"}}).solids[0].shape.radius == 0.3);
}

TEST_CASE("faults in included scenes name their file") {
  const Files files;
  files.put("tank.toml", small_scene + "[liquid]\ndensity = -1\n");
  files.check_refused("include = \"tank.toml\"\n", "tank.toml:");
  files.check_refused("include = \"tank.toml\"\n[time]\ncfl = 100\n", "scene.toml:3: time.cfl");
  files.put("round.toml", "include = \"inner/back.toml\"\n");
  files.put("inner/back.toml", "include = \"../round.toml\"\n");
  files.check_refused("include = \"round.toml\"\n", "back.toml:1: include: \"../round.toml\" includes itself");
  files.check_refused("include = \"none.toml\"\n", "scene.toml:1: include: cannot read");
  files.check_refused("include = \"../../etc/passwd\"\n", "lies outside the scene's folder");
  files.check_refused("include = 3\n", "it must be the path of a scene");
  files.put("bad.toml", "[time\n");
  files.check_refused("include = \"bad.toml\"\n", "bad.toml:1:");
  CHECK_THROWS_WITH(files.read(small_scene, {{"include", "\"tank.toml\""}}),
                    Contains("--set include: include belongs into"));
}

}  // namespace include_tests
