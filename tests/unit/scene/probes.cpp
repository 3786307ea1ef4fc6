// Probes at several points, in boxes and of groups of solids.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace probes_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

std::string probe(const std::string& keys) {
  return small_scene + "[[probe]]\n" + keys + "\n";
}

}  // namespace

TEST_CASE("a probe along a line gives one probe a point, ends included") {
  const Scene s = parse(probe("name = \"wave\"\nkind = \"surface_height\"\nfrom = [0.1, 0, 0.5]\nto = [0.7, 0, 0.5]\n"
                              "count = 4\nevery = 0.1") +
                        "[[probe]]\nkind = \"front\"\n");
  REQUIRE(s.probes.size() == 5);
  for (int n = 0; n < 4; ++n) {
    CHECK(s.probes[std::size_t(n)].name == "wave-" + std::to_string(n + 1));
    CHECK(s.probes[std::size_t(n)].position.isApprox(Vec3(0.1 + 0.2 * n, 0, 0.5), 1e-15));
    CHECK(s.probes[std::size_t(n)].every == 0.1);
  }
  CHECK(s.probes[0].position == Vec3(0.1, 0, 0.5));
  CHECK(s.probes[3].position == Vec3(0.7, 0, 0.5));
  CHECK(s.probes[4].name == "probe2");
  const Scene again = parse(write_scene(s));
  CHECK(again.probes.size() == 5);
  CHECK(again.probes[2].position == s.probes[2].position);
}

TEST_CASE("a probe in a parallelogram counts along both edges") {
  const Scene s =
      parse(probe("name = \"p\"\nkind = \"pressure\"\ncorner = [0, 0.5, 0]\nedge_a = [1, 0, 0]\n"
                  "edge_b = [0, 0.25, 0.5]\ncounts = [3, 2]"));
  REQUIRE(s.probes.size() == 6);
  CHECK(s.probes[1].name == "p-2-1");
  CHECK(s.probes[1].position == Vec3(0.5, 0.5, 0));
  CHECK(s.probes[5].name == "p-3-2");
  CHECK(s.probes[5].position == Vec3(1, 0.75, 0.5));
}

TEST_CASE("points of probes are one form, complete and in the domain") {
  const std::string line = "kind = \"pressure\"\nfrom = [0, 0, 0]\n", needs = "[[probe]] needs one of these: position;";
  check_refused(probe("kind = \"pressure\""), needs);
  check_refused(probe(line + "to = [1, 1, 1]"), needs);
  check_refused(probe(line + "count = 3"), needs);
  check_refused(probe(line + "to = [1, 1, 1]\ncount = 3\nposition = [0, 0, 0]"), "it has keys of several");
  check_refused(probe("kind = \"pressure\"\ncorner = [0, 0, 0]\nedge_a = [1, 0, 0]\nedge_b = [0, 1, 0]"), needs);
  check_refused(probe(line + "to = [1, 1, 1.5]\ncount = 3"), "probe \"probe1\" lies outside the domain: z = 1.5");
  check_refused(probe("kind = \"pressure\"\ncorner = [0.5, 0, 0]\nedge_a = [0.5, 0, 0]\nedge_b = [0.5, 1, 0]\n"
                      "counts = [2, 2]"),
                "lies outside the domain: x = 1.5");
  check_refused(probe("kind = \"pressure\"\ncorner = [0, 0, 0]\nedge_a = [1, 0, 0]\nedge_b = [0, 1, 0]\n"
                      "counts = [2, 2.5]"),
                "probe.0.counts must hold whole numbers");
  check_refused(probe("kind = \"pressure\"\ncorner = [0, 0, 0]\nedge_a = [1, 0, 0]\nedge_b = [0, 1, 0]\n"
                      "counts = [200, 200]"),
                "40000 points; at most 10000");
  check_refused(probe(line + "to = [1, 1, 1]\ncount = 1"), "probe.0.count must be >= 2");
  check_refused(probe("kind = \"front\"\ncount = 3"), "'count' in [[probe]] is only for kind");
  check_refused(
      probe("name = \"a\"\n" + line + "to = [1, 1, 1]\ncount = 2") + "[[probe]]\nname = \"a-2\"\nkind = \"front\"\n",
      "there are two probes \"a-2\"");
}

TEST_CASE("boxes of probes are flat for a flux alone, and in the domain") {
  const std::string volume = "kind = \"volume\"\n", flux = "kind = \"flux\"\n";
  CHECK(parse(probe(flux + "lower = [0.5, 0, 0]\nupper = [0.5, 1, 1]")).probes[0].upper == Vec3(0.5, 1, 1));
  check_refused(probe(volume + "lower = [0.5, 0, 0]\nupper = [0.5, 1, 1]"), "the box is flat");
  check_refused(probe(flux + "lower = [0, 0, 0]\nupper = [0.5, 1, 1]"), "a flux passes a flat box");
  check_refused(probe(flux + "lower = [0, 0, 0]\nupper = [0, 0, 1]"), "a flux passes a flat box");
  check_refused(probe(volume + "lower = [0.5, 0, 0]\nupper = [0.2, 1, 1]"), "lower is above upper along x");
  check_refused(probe(volume + "lower = [0, 0, 0]\nupper = [1, 2, 1]"), "lies outside the domain: y = 2");
  check_refused(probe(volume + "lower = [0, 0, 0]"), "needs 'upper' with kind = \"volume\"");
}

TEST_CASE("probes of loads name solids that are there, copies too") {
  const std::string posts =
      "[[solid]]\nname = \"post\"\nshape = \"box\"\nlower = [0, 0, 0]\nupper = [0.1, 1, 0.1]\narray = { count = [3, 1, "
      "1], spacing = [0.3, 0, 0] }\n";
  const auto loads = [&](const std::string& solids) { return probe("kind = \"force\"\nsolids = " + solids) + posts; };
  CHECK(parse(loads("[\"post-?\"]")).probes[0].solids == std::vector<std::string>{"post-?"});
  check_refused(loads("[\"pots-1\"]"), "but no solid is named so; did you mean \"post-1\"?");
  check_refused(loads("[\"post-1\", \"gate*\"]"), "\"gate*\", but no solid is named like that");
  check_refused(loads("[]"), "probe.0.solids must name at least one");
  check_refused(loads("[\"a\", \"a\"]"), "lists \"a\" twice");
  check_refused(loads("\"post-1\""), "must be an array of names in quotes");
  check_refused(probe("kind = \"torque\"\nsolids = [\"x\"]"), "the scene has none");
}

}  // namespace probes_tests
