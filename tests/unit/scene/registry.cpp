// Properties of every key in the table.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "fluid/rheology/rheology.h"
#include "geometry/shapes/shapes.h"
#include "linalg/precond/preconditioners.h"
#include "scene/docs.h"
#include "scene/options.h"
#include "unit/scene/common.h"

namespace registry_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

using T = OptionType;

// The path with entry 0 of each list. In the rich scene the motion belongs to the second solid, inertia to the third,
// elastic keys to the fourth, springs to the fifth. Joints have drive, second axis, rope and ratio in this order.
std::string concrete_path(const Option& option) {
  std::string path = option.path;
  const auto& kinds = option.only_for.values;
  if (std::find(kinds.begin(), kinds.end(), "rigid") != kinds.end()) path.replace(0, 7, "solid.2");
  const bool is_inside = path.rfind("solid[].material", 0) == 0 || path.rfind("solid[].pinned", 0) == 0 ||
                         path.rfind("solid[].traction", 0) == 0;
  if (is_inside || kinds == std::vector<std::string>{"elastic"}) path.replace(0, 7, "solid.3");
  if (kinds == std::vector<std::string>{"sprung"}) path.replace(0, 7, "solid.4");
  if (path.rfind("solid[].motion", 0) == 0) path.replace(0, 7, "solid.1");
  if (path.rfind("solid[].sequence", 0) == 0) path.replace(0, 7, "solid.5");
  const auto is_in = [&](const char* key) { return path.rfind(std::string("joint[].") + key, 0) == 0; };
  if (is_in("drive")) path.replace(0, 7, "joint.1");
  if (is_in("second_axis")) path.replace(0, 7, "joint.2");
  if (is_in("to") || is_in("length")) path.replace(0, 7, "joint.3");
  if (is_in("ratio")) path.replace(0, 7, "joint.4");
  for (std::size_t at = path.find("[]"); at != std::string::npos; at = path.find("[]")) path.replace(at, 2, ".0");
  return path;
}

// A rheology with all keys of the model.
std::string rheology_text(const std::string& model) {
  std::string text = "rheology = { model = \"" + model + "\"";
  for (const std::string_view key : rheology_model(model).keys) text += fmt::format(", {} = 0.5", key);
  return text + " }";
}

// A scene in which the option applies.
std::string scene_for(const Option& option) {
  std::string shape = "sphere", side = "inflow", probe = "pressure";
  const Condition& condition = option.only_for;
  if (condition.key == "shape") shape = condition.values[0];
  if (condition.key == "type") side = condition.values[0];
  if (option.path.rfind("domain.boundary.x_lower.waves", 0) == 0) side = "waves";
  if (condition.key == "kind" && option.path.rfind("probe[]", 0) == 0) probe = condition.values[0];
  for (const char* key : {"from", "to", "count"})
    if (option.path == std::string("probe[].") + key) probe = "line";
  for (const char* key : {"corner", "edge_a", "edge_b", "counts"})
    if (option.path == std::string("probe[].") + key) probe = "plane";
  std::string text = rich_scene(shape == "polygon" ? 2 : 3, shape, side, probe);
  const std::string pull = "kind = \"acceleration\"";
  if (condition.key == "kind" && option.path.rfind("force[]", 0) == 0)
    text.replace(text.find(pull), pull.size(), "kind = \"" + condition.values[0] + "\"");
  if (option.path.rfind("robot[]", 0) == 0)
    text +=
        "[[robot]]\nfile = \"arm.urdf\"\nrotate = { axis = [0, 0, 1], degrees = 30 }\n[[robot.joint]]\nname = \"j\"\n"
        "spring = { stiffness = 1 }\nmotor = { target = \"t\", stiffness = 1 }\ndrive = { degrees = \"t\" }\n"
        "breaks_at = { force = 1 }\n";
  if (option.path.rfind("solid[].sequence", 0) == 0)
    text +=
        "[[solid]]\nkind = \"deforming\"\nshape = \"mesh\"\nfile = \"wing.01.obj\"\n"
        "sequence = { meshes = 3, rate = 2, start = 0.5, loop = true }\n";
  const std::string plain = "viscosity = \"1+x\"";
  if (option.path.rfind("liquid.rheology.", 0) == 0)
    text.replace(text.find(plain), plain.size(),
                 rheology_text(condition.key == "model" ? condition.values[0] : "bingham"));
  return text;
}

bool is_numeric(const Option& o) {
  const bool number = o.type == T::number || o.type == T::integer || o.type == T::formula;
  return number && o.availability == Availability::present;
}

bool is_numeric_vector(const Option& o) {
  return o.type == T::vector || o.type == T::axis || o.type == T::spin || o.type == T::formula_vector;
}

// Only x_lower has a table in the rich scene; the rows of the other sides are built alike.
bool is_testable(const Option& o) {
  return o.path.rfind("domain.boundary.", 0) != 0 || o.path.rfind("domain.boundary.x_lower.", 0) == 0;
}

const std::vector<std::string> never_numbers{
    "nan",       "+nan",       "inf",     "-inf",        "1e999",
    "-1e999",    "1e300",      "0x10",    "0b1",         "99999999999999999999",
    "true",      "1979-05-27", "[[1]]",   "{ a = 1 }",   "\"\"",
    "\"1e999\"", "\"nan\"",    "\"1/0\"", "\"sqrt(-1)\""};

void check_refused(const Option& option, const std::string& path, const std::string& value) {
  INFO(path << " = " << value);
  const std::string message = fault(scene_for(option), {{path, value}});
  CHECK_THAT(message, Contains(path));
  CHECK_THAT(message, Contains("--set " + path));
}

}  // namespace

TEST_CASE("no numeric key takes NaN, infinity, overflow, coded integers or other types") {
  int tried = 0;
  for (const Option& option : scene_options()) {
    if (!is_testable(option)) continue;
    const std::string path = concrete_path(option);
    for (const std::string& value : never_numbers) {
      if (is_numeric(option)) check_refused(option, path, value);
      for (int i = 0; i < 3 && is_numeric_vector(option); ++i)
        check_refused(option, fmt::format("{}.{}", path, i), value);
    }
    tried += is_numeric(option) || is_numeric_vector(option);
  }
  CHECK(tried > 60);
}

TEST_CASE("no numeric key takes a value beyond its range") {
  for (const Option& option : scene_options()) {
    if (!is_numeric(option) || !is_testable(option)) continue;
    const std::string path = concrete_path(option);
    const Range& range = option.range;
    if (range.low_bound == Bound::excluded) check_refused(option, path, fmt::format("{:.1f}", range.low));
    if (option.type == T::integer) {
      check_refused(option, path, fmt::format("{}", range.low - 1));
      check_refused(option, path, "2.5");
    } else if (range.low > -number_limit) {
      check_refused(option, path, fmt::format("{:.20f}", range.low - 1e-13));
    }
    check_refused(option, path, fmt::format("{:e}", range.high * 1.001));
  }
}

TEST_CASE("no vector key takes another number of components") {
  for (const Option& option : scene_options()) {
    if (!is_numeric_vector(option) || !is_testable(option)) continue;
    for (const char* value : {"[]", "[1]", "[1, 1]", "[1, 1, 1, 1]", "1"})
      check_refused(option, concrete_path(option), value);
  }
}

TEST_CASE("no key takes a value of another type") {
  for (const Option& option : scene_options()) {
    if (!is_testable(option) || option.availability == Availability::later) continue;
    const std::string path = concrete_path(option);
    if (option.only_for.key == "kind" && option.only_for.values[0] != "pressure") continue;
    const bool list = option.type == T::table_list;
    check_refused(option, list ? path : path, option.type == T::boolean ? "3" : "2020-01-01");
  }
}

TEST_CASE("each misspelt key is refused, and the right one suggested") {
  for (const Option& option : scene_options()) {
    const bool placed = is_testable(option) && option.availability == Availability::present;
    if (!placed || option.key.size() < 4) continue;
    std::string path = concrete_path(option);
    path.erase(path.size() - 2, 1);
    INFO(path);
    const std::string message = fault(scene_for(option), {{path, "1"}});
    CHECK_THAT(message, Contains("unknown key"));
    CHECK_THAT(message, Contains("did you mean '" + option.key + "'?"));
  }
}

TEST_CASE("shapes and preconditioners of the table are those that exist") {
  for (const Option& option : scene_options()) {
    const std::set<std::string> names(option.choices.begin(), option.choices.end());
    const std::vector<std::string> shapes = shape_names(), preconditioners = preconditioner_names();
    if (option.key == "shape") CHECK(names == std::set<std::string>(shapes.begin(), shapes.end()));
    if (option.key == "preconditioner") {
      CHECK(names == std::set<std::string>(preconditioners.begin(), preconditioners.end()));
    }
  }
}

TEST_CASE("every key is documented and its default lies in its range") {
  std::set<std::string> seen;
  for (const Option& option : scene_options()) {
    INFO(option.path);
    CHECK(!option.doc.empty());
    CHECK(option.doc.find('\n') == std::string::npos);
    CHECK((seen.insert(option.path).second || option.key == "from"));
    if (option.type == T::number && !option.fallback.empty()) CHECK(contains(option.range, std::stod(option.fallback)));
  }
}

TEST_CASE("docs/scene-reference.md is what the table of keys says") {
  const auto page = std::filesystem::path(__FILE__).parent_path() / "../../../docs/scene-reference.md";
  std::ifstream file(page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto fresh = std::filesystem::temp_directory_path() / "scene-reference.md";
  if (text != scene_reference()) std::ofstream(fresh) << scene_reference();
  INFO("the page as it should be: " << fresh.string());
  CHECK(text == scene_reference());
}

}  // namespace registry_tests
