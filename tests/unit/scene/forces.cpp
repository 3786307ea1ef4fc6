// Keys of [[force]] and [[contact]]: what they mean, and what is refused.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace force_keys_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

const std::string crate =
    "[[solid]]\nname = \"crate\"\nkind = \"rigid\"\ndensity = 500\nshape = \"box\"\nlower = [0.1, 0.1, 0.1]\n"
    "upper = [0.3, 0.3, 0.3]\n";

std::string force(const std::string& keys) {
  return small_scene + crate + "[[force]]\n" + keys;
}

std::string contact(const std::string& keys) {
  return small_scene + crate + "[[contact]]\n" + keys;
}

}  // namespace

TEST_CASE("forces are read and written back") {
  const Scene s =
      parse(force("kind = \"vortex\"\ncenter = [0, 0, 0]\naxis = [0, 1, 0]\nstrength = \"2*t\"\nradius = \"20 cm\"\n"
                  "solids = [\"cra*\"]\nregion = { shape = \"sphere\", center = [0, 0, 0], radius = 1 }\n"
                  "[[force]]\nname = \"jet\"\nkind = \"load\"\nforce = [1, \"sin(t)\", 0]\nat = [0.2, 0.2, "
                  "0.2]\nturns_with_solid = true\n"));
  REQUIRE(s.forces.size() == 2);
  CHECK(s.forces[0].name == "force1");
  CHECK(s.forces[0].radius == Approx(0.2));
  CHECK(s.forces[0].region->kind == "sphere");
  CHECK(s.forces[1].turns_with_solid);
  CHECK(write_scene(parse(write_scene(s))) == write_scene(s));
}

TEST_CASE("forces that could do nothing are refused with the remedy") {
  const std::string field = "kind = \"acceleration\"\nacceleration = [1, 0, 0]\n";
  check_refused(force(field + "solids = [\"crat\"]\n"), "did you mean \"crate\"?");
  check_refused(small_scene + "[[force]]\n" + field + "acts_on = \"solids\"\n", "no solid that forces move");
  check_refused(force(field + "acts_on = \"liquid\"\nsolids = [\"crate\"]\n"), "acts on no solid");
  check_refused(force("kind = \"load\"\nforce = [1, 0, 0]\naxis = [0, 0, 0]\n"), "axis");
  check_refused(force("kind = \"point\"\ncenter = [0, 0, 0]\nstrength = 1\n"), "needs 'radius'");
  check_refused(force(field + "rate = 3\n"), "'rate' in [[force]] is only for kind = \"drag\"");
  check_refused(force("kind = \"wind\"\nvelocity = [1, 0, 0]\n[gas]\ndensity = 1\n"), "here [gas] flows");
  const std::string flat = "dimension = 2\n[domain]\nupper = [1, 1]\ncell_size = 0.125\n[time]\nend = 1\n";
  check_refused(flat + "[[force]]\nkind = \"vortex\"\ncenter = [0, 0]\nstrength = 1\nradius = 1\naxis = [1, 0, 0]\n",
                "in 2D the axis is [0, 0, 1]");
}

TEST_CASE("contacts name solids that are there, and say something") {
  const Scene s = parse(contact("between = [\"crate\", \"domain\"]\nfriction = 0.4\n"));
  CHECK(s.contacts[0].friction == 0.4);
  CHECK(write_scene(parse(write_scene(s))) == write_scene(s));
  check_refused(contact("between = [\"crat\"]\nfriction = 0.4\n"), "did you mean \"crate\"?");
  check_refused(contact("between = [\"crate\"]\n"), "give friction, restitution, or collide = false");
  check_refused(contact("between = [\"crate\", \"domain\"]\ncollide = false\n"),
                "cannot pass through the domain's sides");
  check_refused(contact("between = [\"crate\"]\ncollide = false\nfriction = 1\n"), "have no friction");
}

TEST_CASE("restitution is for pairs that collide and do not deform") {
  const Scene s = parse(contact("between = [\"crate\", \"domain\"]\nrestitution = 0.5\n"));
  CHECK(s.contacts[0].restitution == 0.5);
  CHECK(write_scene(parse(write_scene(s))) == write_scene(s));
  check_refused(contact("between = [\"crate\", \"domain\"]\nrestitution = 1.1\n"), "contact.0.restitution");
  check_refused(contact("between = [\"crate\"]\ncollide = false\nrestitution = 0.5\n"), "have no restitution");
  const std::string bob =
      "[[solid]]\nname = \"bob\"\nkind = \"sprung\"\nshape = \"sphere\"\ncenter = [0.5, 0.5, 0.5]\nradius = 0.1\n"
      "density = 700\nspring_stiffness = 50\n";
  check_refused(contact("between = [\"*\"]\nrestitution = 0.5\n") + bob, "\"bob\" is sprung; restitution is for");
}

}  // namespace force_keys_tests
