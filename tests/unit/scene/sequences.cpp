// Keys of deforming solids: what they mean, and what is refused.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace sequences_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

std::string wing(const std::string& keys) {
  return small_scene + "[[solid]]\nname = \"wing\"\nkind = \"deforming\"\n" + keys;
}

const std::string mesh = "shape = \"mesh\"\nfile = \"wing.09.obj\"\n";

}  // namespace

TEST_CASE("a sequence of meshes is read and written back") {
  const ScratchFolder folder;
  for (const char* name : {"wing.09.obj", "wing.10.obj", "wing.11.obj"}) folder.write(name, "o\n");
  const Scene s =
      parse(wing(mesh + "sequence = { meshes = 3, rate = 25, start = 0.5, loop = true }\n"), {}, folder.path());
  const SequenceSpec& sequence = s.solids[0].sequence;
  CHECK(sequence.meshes == 3);
  CHECK(sequence.rate == 25);
  CHECK(sequence.start == 0.5);
  CHECK(sequence.loop);
  CHECK(s.solids[0].kind.is_prescribed());
  CHECK(s.solids[0].kind.deforms());
  CHECK(write_scene(parse(write_scene(s), {}, "/")) == write_scene(s));
  const std::string four = fault(wing(mesh + "sequence = { meshes = 4, rate = 25 }\n"), {}, folder.path());
  CHECK_THAT(four, Contains("scene.toml:10: solid.0.file") && Contains("wing.12.obj") && Contains("counts 4 files"));
}

TEST_CASE("sequences that cannot be are refused") {
  const ScratchFolder folder;
  folder.write("wing.obj", "o\n");
  const std::string sequence = "sequence = { meshes = 3, rate = 25 }\n";
  CHECK_THAT(fault(wing("shape = \"mesh\"\nfile = \"wing.obj\"\n" + sequence), {}, folder.path()),
             Contains("needs a number that counts up, as in flag.0000.ply"));
  check_refused(wing("shape = \"box\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n" + sequence), "give shape = \"mesh\"");
  check_refused(wing("shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n"), "sequence");
  check_refused(
      small_scene + "[[solid]]\nkind = \"static\"\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n" + sequence,
      "is only for kind = \"deforming\"");
  folder.write("wing.0.ply", "ply\n");
  const std::string flat = flat_scene + "[[solid]]\nkind = \"deforming\"\nshape = \"mesh\"\nfile = \"wing.0.ply\"\n";
  CHECK_THAT(fault(flat + sequence, {}, folder.path()), Contains("a mesh in 2D is a closed outline"));
}

}  // namespace sequences_tests
