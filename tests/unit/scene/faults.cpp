#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <random>

#include "base/gravity.h"
#include "base/scene.h"
#include "unit/scene/common.h"

namespace faults_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

struct Case {
  std::string text, expected;
};

void check_all(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    INFO(c.text);
    const std::string message = fault(c.text);
    CHECK_THAT(message, StartsWith("scene.toml"));
    CHECK_THAT(message, Contains(c.expected));
  }
}

std::string refused_file(const std::filesystem::path& file) {
  try {
    read_scene(file);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  FAIL_CHECK("the scene was accepted");
  return "";
}

std::string repeat(const std::string& text, int count) {
  std::string all;
  all.reserve(text.size() * std::size_t(count));
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

std::string solid(const std::string& keys) {
  return small_scene + "[[solid]]\n" + keys;
}
std::string region(const std::string& keys) {
  return small_scene + "[[liquid.region]]\n" + keys;
}
std::string domain(const std::string& upper, const std::string& cell_size) {
  return "[domain]\nupper = " + upper + "\ncell_size = " + cell_size + "\n[time]\nend = 1\n";
}

}  // namespace

TEST_CASE("a scene file that cannot be opened is named with the system's reason") {
  const ScratchFolder folder;
  CHECK_THAT(refused_file(folder.path() / "none.toml"), Contains("none.toml") && Contains("No such file or directory"));
  CHECK_THAT(refused_file(folder.path()), Contains(folder.path().string()) && Contains("Is a directory"));
  CHECK_THAT(refused_file(folder.write("file", "") / "scene.toml"), Contains("Not a directory"));
  const auto locked = folder.write("locked.toml", small_scene);
  std::filesystem::permissions(locked, std::filesystem::perms::none);
  if (::geteuid() != 0) CHECK_THAT(refused_file(locked), Contains("Permission denied"));  // root may read any file
}

TEST_CASE("an empty scene is told what it needs") {
  for (const char* text : {"", " \n\t\n", "# nothing\n", "\xef\xbb\xbf"}) {
    CHECK_THAT(fault(text), StartsWith("scene.toml: the scene is empty; it needs at least [domain]"));
  }
}

TEST_CASE("what is not TOML is named by line and column") {
  check_all({{"a = \"\xff\xfe\"\n", "scene.toml:1:"},
             {"\xff\xfe[\0d", "scene.toml:1:"},
             {small_scene + "title = \"abc", "scene.toml:6:"},
             {small_scene + "[liquid\n", "scene.toml:6:"},
             {small_scene + "x = [1, 2", "scene.toml:6:"},
             {small_scene + "= 3\n", "scene.toml:6:"},
             {small_scene + "x = 1 2\n", "scene.toml:6:"},
             {small_scene + "x = 1e999\n", "scene.toml:6:"},
             {small_scene + "end = 2\n", ": not valid TOML: Error while parsing key-value pair: cannot redefine"},
             {small_scene + "[time]\n", "scene.toml:6:"},
             {std::string("a\0b = 1", 7), "scene.toml:1:"}});
}

TEST_CASE("keys and types that do not fit are named by line") {
  check_all(
      {{small_scene + "[liquid]\ndensty = 3\n",
        "scene.toml:7: unknown key 'densty' in [liquid]; did you mean 'density'?"},
       {small_scene + "[liqid]\n", "scene.toml:6: unknown key 'liqid' in the scene; did you mean 'liquid'?"},
       {"liquid = 3\n" + small_scene, "scene.toml:1: liquid must be a table"},
       {"solid = { shape = \"box\" }\n" + small_scene,
        "scene.toml:1: solid must be an array of tables, written [[solid]]"},
       {"solid = [1]\n" + small_scene, "scene.toml:1: solid.0 must be a table"},
       {"[time]\nend = 1\n", "scene.toml: the scene needs 'domain'"},
       {"[domain]\nupper = [1, 1, 1]\n[time]\nend = 1\n", "scene.toml:1: [domain] needs 'cell_size'"},
       {"dimension = 4\n" + small_scene, "scene.toml:1: dimension must be >= 2 and <= 3; it is 4"},
       {"dimension = 2\n" + small_scene, "scene.toml:3: domain.upper must have 2 components (dimension = 2), not 3"},
       {small_scene + "[output]\nframes = \"surface\"\n", "output.frames must be an array of names"},
       {small_scene + "[output]\nframes = [\"surface\", \"surface\"]\n", "lists \"surface\" twice"},
       {"title = \"two\\nlines\"\n" + small_scene, "title must be one line"}});
}

TEST_CASE("physical ranges hold") {
  check_all(
      {{small_scene + "[liquid]\ndensity = 0\n", "liquid.density must be > 0 kg/m^3; it is 0"},
       {small_scene + "[liquid]\ndensity = -5.5\n", "liquid.density must be > 0 kg/m^3; it is -5.5"},
       {small_scene + "[liquid]\nviscosity = -1\n", "liquid.viscosity must be >= 0 Pa s; it is -1"},
       {small_scene + "cfl = 9\n", "time.cfl must be > 0 and <= 8; it is 9"},
       {small_scene + "frame_rate = 1e300\n", "time.frame_rate must be"},
       {small_scene + "frame_rate = 0\n", "time.frame_rate must be"},
       {"[domain]\nupper = [1, 1, 1]\ncell_size = 0.5\n[time]\nend = 1e9\nframe_rate = 1e3\n", "frames in all"},
       {small_scene + "fixed_step = 1\nmax_step = 0.5\n", "time.fixed_step = 1 is longer than time.max_step = 0.5"},
       {small_scene + "[solver]\ntolerance = 0.1\n", "solver.tolerance must be > 0 and <= 0.01; it is 0.1"}});
}

TEST_CASE("the domain is a whole number of cells, more than one, and no more than the solvers can number") {
  check_all({{domain("[1, 1, 1]", "0"), "scene.toml:3: domain.cell_size must be > 0 m; it is 0"},
             {domain("[1, 1, 1]", "-1"), "domain.cell_size must be > 0 m"},
             {domain("[1, 0, 1]", "0.5"), "the domain must have lower < upper; along y they are 0 and 0"},
             {domain("[1, -1, 1]", "0.5"), "along y"},
             {domain("[1, 1, 1]", "1"), "the domain is a single cell; lower cell_size"},
             {domain("[0.4, 4, 4]", "1"), "along x: 0.4 cells of 1 m"},
             {domain("[1, 1.003, 1]", "0.125"), "it must be a whole number of cells (upper y = 1 would be)"},
             {domain("[1, 1, 1]", "0.3"), "along x: 3.3333333333333335 cells of 0.3 m"},
             {domain("[1e5, 1e5, 1e5]", "1"),
              "100000 x 100000 x 100000 = 1e+15 cells; the linear solvers (hypre) number rows "
              "with 32-bit integers"},
             {domain("[1291, 1291, 1291]", "1"), "32-bit"},
             {domain("[1, 1, 1]", "1e-300"), "raise cell_size"}});
  CHECK(parse(domain("[2, 2, 2]", "1")).domain.cells == std::array{2, 2, 2});
  CHECK(parse(domain("[1, 4, 4]", "1")).domain.cells == std::array{1, 4, 4});
  CHECK(parse(domain("[1290, 1290, 1290]", "1")).domain.cells[0] == 1290);             // 1290^3 < 2^31 < 1291^3
  CHECK(parse(domain("[0.3, 0.7, 0.9]", "0.1")).domain.cells == std::array{3, 7, 9});  // none is exact in binary
}

TEST_CASE("sides fit the domain and each other") {
  const std::string sides = small_scene + "[domain.boundary]\n";
  const std::string flat =
      "dimension = 2\n[domain]\nupper = [1, 1]\ncell_size = 0.125\n[time]\nend = 1\n[domain.boundary]\n";
  check_all(
      {{sides + "x_lower = \"periodic\"\n", "scene.toml:7: x_lower is periodic, so x_upper must be too"},
       {flat + "z_lower = \"no_slip\"\n", "z_lower is for 3D; this scene has dimension = 2"},
       {sides + "x_lower = \"inflow\"\n", "[domain.boundary.x_lower] needs 'velocity' with type = \"inflow\""},
       {sides + "x_lower = { velocity = [1, 0, 0] }\n", "[domain.boundary.x_lower] needs 'type'"},
       {sides + "x_lower = { type = \"no_slip\", velocity = [1, 0, 0] }\n",
        "is only for type = \"inflow\" or \"moving_wall\""},
       {sides + "x_lower = { type = \"inflow\", velocity = [1, 0] }\n", "x_lower.velocity must have 3 components"},
       {sides + "x_lower = \"free_slp\"\n", "did you mean \"free_slip\"?"},
       {sides + "x_lower = 3\n", "domain.boundary.x_lower must be a table (a type in quotes"},
       {sides + "w_lower = \"no_slip\"\n", "unknown key 'w_lower' in [domain.boundary]"}});
}

TEST_CASE("shapes have what they need and nothing else") {
  check_all(
      {{region("shape = \"box\"\nlower = [0, 0, 0]\n"),
        "scene.toml:6: [[liquid.region]] needs 'upper' with shape = \"box\""},
       {region("shape = \"box\"\nlower = [0, 0, 0]\nupper = [1, 0, 1]\n"), "must have lower < upper; along y"},
       {region("shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0\n"), "radius must be > 0 m; it is 0"},
       {region("shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nlower = [0, 0, 0]\n"),
        "'lower' in [[liquid.region]] is only for shape = \"box\""},
       {region("lower = [0, 0, 0]\n"), "[[liquid.region]] needs 'shape'"},
       {region("shape = \"spere\"\n"), "did you mean \"sphere\"?"},
       {region("shape = \"capsule\"\nfrom = [1, 1, 1]\nto = [1, 1, 1]\nradius = 1\n"),
        "from and to are the same point"},
       {region("shape = \"plane\"\npoint = [1, 1, 1]\nnormal = [0, 0, 0]\n"), "normal must not be zero"},
       {region("shape = \"expression\"\nphi = \"x+\"\n"), "phi: expression 'x+'"},
       {region("shape = \"expression\"\nphi = \"foo(x)\"\n"), "phi: expression 'foo(x)'"},
       {region("shape = \"expression\"\nphi = \"x-t\"\n"), "uses t; it may depend on x, y, z alone"},
       {region("shape = \"expression\"\nphi = \"x=2\"\n"), "assigns"},
       {region("shape = \"expression\"\nphi = \"x, y\"\n"), "is a list"},
       {region("shape = \"expression\"\nphi = \"\"\n"), "phi: "},
       {region("shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nscale = 0\n"), "scale must be > 0"},
       {region("shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nrotate = { degrees = 1 }\n"),
        "needs an axis in 3D"},
       {region("shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nrotate = { axis = [0, 0, 0], degrees = 1 }\n"),
        "must not be zero"}});
}

TEST_CASE("a source of a cylinder begins at start, its from being a point") {
  const std::string tube = "[[liquid.source]]\nshape = \"cylinder\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nradius = 0.1\n";
  const Scene scene = parse(small_scene + tube + "start = 0.25\n");
  CHECK(scene.liquid.sources[0].from == 0.25);
  CHECK(scene.liquid.sources[0].shape.to == Vec3(1, 0, 0));
  const std::string disc =
      "[[liquid.source]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.1\nfrom = 2\nuntil = 1\n";
  CHECK_THAT(fault(small_scene + disc), Contains("must begin before its until"));
}

TEST_CASE("what this version does not have is refused with what it has") {
  const std::string ball = "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n";
  check_all({{small_scene + "[liquid]\nseparates = true\n[gas]\nbubbles = \"volume_conserving\"\n",
              "liquid.separates = true does not work with gas.bubbles = \"volume_conserving\""},
             {small_scene + "[tracking]\nmethod = \"apic\"\n", "this version has \"level_set\""}});
  for (const char* key : {"density", "velocity"}) {
    check_all({{solid(fmt::format("kind = \"static\"\n{}{} = 1\n", ball, key)),
                "is only for kind = \"rigid\", \"elastic\" or \"sprung\""}});
  }
  check_all(
      {{solid("kind = \"static\"\n" + ball + "angular_velocity = 1\n"), "is only for kind = \"rigid\" or \"elastic\""},
       {solid("kind = \"rigid\"\n" + ball + "spring_stiffness = 1\n"), "is only for kind = \"sprung\""}});
  check_all({{solid("kind = \"kinematic\"\nmotion = {}\nfixed = []\n" + ball), "is only for kind = \"rigid\""}});
  for (const char* key : {"material", "element_size", "pinned"}) {
    check_all({{solid(fmt::format("kind = \"rigid\"\n{}{} = 1\n", ball, key)), "is only for kind = \"elastic\""}});
  }
  check_all({{solid(ball + "motion = {}\n"), "'motion' in [[solid]] is only for kind = \"kinematic\""}});
  CHECK_NOTHROW(parse(small_scene + "[liquid]\nviscosity = 0\nsurface_tension = 0\n"));
}

TEST_CASE("gas has a density, and flows where liquid does not separate") {
  check_all({{small_scene + "[gas]\ndensity = 0\n", "gas.density"},
             {small_scene + "[gas]\nviscosity = -1\n", "gas.viscosity"},
             {small_scene + "[gas]\nbubbles = \"resolve\"\n", "did you mean \"resolved\""},
             {small_scene + "[liquid]\nseparates = true\n[gas]\n", "does not work with flowing gas"}});
  const Scene scene = parse(small_scene + "[gas]\ndensity = 2\nviscosity = 1e-5\nvelocity = [1, 0, 0]\n");
  CHECK(scene.gas.flows());
  CHECK(scene.gas.density == 2);
  CHECK(scene.gas.viscosity == 1e-5);
  CHECK(write_scene(scene).find("[gas]") != std::string::npos);
  CHECK(write_scene(parse(write_scene(scene))) == write_scene(scene));
  CHECK(write_scene(parse(small_scene)).find("[gas]") == std::string::npos);
}

TEST_CASE("volumes are carried in cells beside whatever a scene has") {
  const std::string cells = small_scene + "[liquid]\nvolume = \"cells\"\n",
                    ball = "[[solid]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n";
  check_all({{small_scene + "[liquid]\nvolume = \"cell\"\n", "did you mean \"cells\""}});
  CHECK(parse(cells).liquid.volume == VolumeKeeping::in_cells);
  CHECK_NOTHROW(parse(cells + "separates = true\n"));
  CHECK(parse(cells).liquid.spray);
  CHECK(!parse(cells + "spray = false\n").liquid.spray);
  CHECK(!parse(small_scene + "[liquid]\nspray = false\n").liquid.spray);
  const std::string needs = "liquid.spray = false does not go with liquid.volume = \"shift\"";
  check_all({{small_scene + "[liquid]\nvolume = \"shift\"\nspray = false\n", needs},
             {cells + "spray = 1\n", "liquid.spray must be true or false"},
             {cells + "spray = false\n[gas]\n", needs},
             {cells + "spray = false\nprescribed_velocity = [0, 0, 0]\n", needs}});
  CHECK_NOTHROW(parse(cells + "[gas]\n"));
  CHECK_NOTHROW(parse(cells + "[gas]\nbubbles = \"volume_conserving\"\n"));
  CHECK_NOTHROW(parse(cells + ball + "kind = \"static\"\n"));
  CHECK_NOTHROW(parse(cells + ball + "kind = \"rigid\"\ndensity = 500\n"));
  CHECK_NOTHROW(parse(cells + "[domain.boundary]\nx_lower = { type = \"outflow\" }\n"));
  CHECK_NOTHROW(parse(cells + "[[liquid.source]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n"));
}

TEST_CASE("names are unique and fit into a table column") {
  const std::string ball = "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n";
  check_all(
      {{solid("name = \"a\"\n" + ball + "[[solid]]\nname = \"a\"\n" + ball), "the name \"a\" of [[solid]] is taken"},
       {solid("name = \"a,b\"\n" + ball), "solid.0.name must have 1 to 200 characters, none of them a comma"},
       {solid("name = \"\"\n" + ball), "solid.0.name must have 1 to 200 characters"}});
  const Scene scene = parse(solid("name = \"solid2\"\n" + ball + "[[solid]]\n" + ball));
  CHECK(scene.solids[1].name == "solid2_");
}

TEST_CASE("probes lie in the domain") {
  const std::string probe = small_scene + "[[probe]]\nposition = [0.5, 1.5, 0.5]\n";
  check_all({{probe + "kind = \"pressure\"\n", "probe \"probe1\" lies outside the domain: y = 1.5"}});
  CHECK_NOTHROW(parse(probe + "kind = \"surface_height\"\n"));  // the coordinate along gravity does not matter
}

TEST_CASE("a prescribed motion must be finite and must not jump") {
  const auto moving = [](const std::string& motion) {
    return solid(
        "name = \"gate\"\nkind = \"kinematic\"\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nmotion = " +
        motion + "\n");
  };
  check_all(
      {{moving("{ translate = [\"t < 0.5 ? 0 : 10\", 0, 0] }"), "solid \"gate\": the motion jumps by 10 m at t = 0.5"},
       {moving("{ translate = [\"1/(t-0.5)\", 0, 0] }"), "solid \"gate\": the motion"},
       {moving("{ translate = [\"sqrt(0.5-t)\", 0, 0] }"), "the motion is not finite at t = 0.5005"},
       {moving("{ rotate = { axis = [0, 0, 1], degrees = \"1/t\" } }"), "the motion is not finite at t = 0 s"},
       {moving("{ translate = [\"0.1*x\", 0, 0] }"), "uses x; it may depend on t alone"},
       {moving("{ trnslate = [0, 0, 0] }"), "did you mean 'translate'?"}});
  CHECK_NOTHROW(parse(moving("{ translate = [\"exp(-t)*t\", \"0.1*sin(6.28*t)\", 0] }")));
  CHECK_NOTHROW(parse(moving("{ translate = [\"1000*t\", 0, 0] }")));  // fast, but without a jump
}

TEST_CASE("gravity is numbers, or formulas in t alone") {
  const Scene s = parse("gravity = [\"2*t\", \"-9.81*sign(sin(t))\", 1]\n" + small_scene);
  CHECK(Gravity(s.gravity).at(1.5) == Vec3(3, -9.81, 1));
  CHECK(Gravity(parse(write_scene(s)).gravity).at(4.5) == Vec3(9, 9.81, 1));
  CHECK(Gravity(s.gravity).largest(0, 10) == Approx(Vec3(20, 9.81, 1).norm()));
  check_all({{"gravity = [0, \"x\", 0]\n" + small_scene, "uses x; it may depend on t alone"},
             {"gravity = [0, \"1/0\", 0]\n" + small_scene, "gravity"},
             {"gravity = [0, nan, 0]\n" + small_scene, "gravity"},
             {"gravity = [0, \"-9.81\"]\n" + small_scene, "gravity"},
             {"gravity = \"-9.81\"\n" + small_scene, "gravity"}});
}

TEST_CASE("a run that ends before it starts, zero and huge gravity are scenes") {
  CHECK(parse("[domain]\nupper = [1, 1, 1]\ncell_size = 0.5\n[time]\nend = 0\n").time.end == 0);
  CHECK(parse("[domain]\nupper = [1, 1, 1]\ncell_size = 0.5\n[time]\nend = -1\n").time.end == 0);
  CHECK(Gravity(parse("gravity = [-0.0, 0, -0]\n" + small_scene).gravity).at(0) == Vec3(0, 0, 0));
  CHECK(Gravity(parse("gravity = [1e6, 0, 0]\n" + small_scene).gravity).at(0) == Vec3(1e6, 0, 0));
  CHECK(parse(small_scene + "max_step = 1e6\n").time.max_step == 1e6);
}

TEST_CASE("files are looked for in the scene's folder and nowhere else unless allowed") {
  const ScratchFolder outer;
  const auto folder = outer.path() / "scene folder é";
  outer.write("out.obj", "o");
  outer.write("scene folder é/in.obj", "o");
  outer.write("scene folder é/empty.obj", "");
  outer.write("scene folder é/tets.vtu", "o");
  outer.write("scene folder é/notes.txt", "o");
  std::filesystem::create_symlink(outer.path() / "out.obj", folder / "link.obj");
  std::filesystem::create_symlink(folder / "loop.obj", folder / "loop.obj");
  std::filesystem::create_directory(folder / "dir.obj");
  const auto mesh = [](const std::string& file) { return solid("shape = \"mesh\"\nfile = \"" + file + "\"\n"); };
  const std::string allow = "allow_outside_files = true\n", absolute = (outer.path() / "out.obj").string();
  const std::vector<Case> refused{{"../out.obj", "outside the scene's folder"},
                                  {absolute, "outside the scene's folder"},
                                  {"link.obj", "outside the scene's folder"},
                                  {"none.obj", "cannot read \"none.obj\": No such file or directory"},
                                  {"dir.obj", "Is a directory"},
                                  {"empty.obj", "the file is empty"},
                                  {"loop.obj", "loop.obj"},
                                  {"tets.vtu", "elements are for elastic solids"},
                                  {"notes.txt", "cannot read a mesh from 'notes.txt'"},
                                  {std::string(300, 'a') + ".obj", "name too long"},
                                  {"", "must be a path"}};
  for (const Case& c : refused) {
    INFO(c.text);
    const std::string message = fault(mesh(c.text), {}, folder);
    CHECK_THAT(message, StartsWith("scene.toml:8: "));
    CHECK_THAT(message, Contains(c.expected, Catch::CaseSensitive::No));
  }
  CHECK(parse(mesh("in.obj"), {}, folder).solids[0].shape.file == folder / "in.obj");
  CHECK(parse(mesh("../scene folder é/in.obj"), {}, folder).solids[0].shape.file == folder / "in.obj");
  for (const std::string& file : {std::string("../out.obj"), absolute, std::string("link.obj")}) {
    CHECK(parse(allow + mesh(file), {}, folder).solids[0].shape.file == outer.path() / "out.obj");
  }
}

// The peak memory of the whole test program bounds that for each of these texts.
TEST_CASE("texts beyond all measure are refused in seconds and within a gigabyte") {
  using Clock = std::chrono::steady_clock;
  std::string many_keys, deep_header = "[a";
  for (int i = 0; i < 100000; ++i) many_keys += fmt::format("key{} = 1\n", i);
  for (int i = 0; i < 100000; ++i) deep_header += ".a";
  const std::vector<Case> cases{
      {fmt::format("a = {:[>100000}", ""), "scene.toml:1: nested more than 32 deep"},
      {fmt::format("a = {}", repeat("{a=", 100000)), "nested more than 32 deep"},
      {deep_header + "]\n", "nested more than 32 deep"},
      {fmt::format("x{} = 1", repeat(".a", 100000)), "nested more than 32 deep"},
      {fmt::format("title = \"{:x>100000000}\"\n", ""), "a scene has at most 16777216"},
      {small_scene + repeat("[[solid]]\n", 1'000'000), "more than 1000000 values"},
      {small_scene + repeat("[[solid]]\n", 100'000), "solid has 100000 entries; at most 20000"},
      {small_scene + repeat("[[solid]]\nshape=3\n", 20'000), "and 19900 more"},
      {small_scene + many_keys, "and 99900 more"},
      {fmt::format("title = \"{:x>1000000}\"\n{}", "", small_scene), "title must have at most 1000"},
      {region("shape = \"expression\"\nphi = \"" + repeat("(", 100000) + "\"\n"), "at most 4096"},
      {region("shape = \"expression\"\nphi = \"" + repeat("(", 4000) + "\"\n"), "phi: "},
      {fmt::format("a = [{}]\n{}", repeat("1,", 900'000), small_scene), "unknown key 'a'"}};
  for (const Case& c : cases) {
    INFO(c.text.substr(0, 80));
    const auto start = Clock::now();
    CHECK_THAT(fault(c.text), Contains(c.expected));
    CHECK(std::chrono::duration<double>(Clock::now() - start).count() < 5);
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  CHECK(usage.ru_maxrss < 1024 * 1024);  // KiB
}

TEST_CASE("no damaged scene does anything but fail with exit code 2 or read") {
  std::mt19937 random(7);
  const std::string good = rich_scene(3, "sphere", "inflow", "pressure");
  const std::string bytes = "[]{}\"'#=,.\n\\0159eE+-_ax\x80\xff";
  for (int i = 0; i < 3000; ++i) {
    std::string text = good;
    for (unsigned edits = random() % 4 + 1; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0)
        text.erase(at, random() % 30);
      else
        text[at] = bytes[random() % bytes.size()];
    }
    try {
      parse(text);
    } catch (const Error& e) {
      if (e.code() != ExitCode::bad_input) FAIL("exit code of: " << text);
    }
  }
}

}  // namespace faults_tests
