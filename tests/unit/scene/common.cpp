#include "unit/scene/common.h"
#include "base/scene.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>

namespace seiche::testing {
namespace {

std::string vector_text(int dimension, const std::vector<std::string>& parts) {
  return fmt::format("[{}]", fmt::join(parts.begin(), parts.begin() + dimension, ", "));
}

std::string geometry(int dimension, const std::string& shape) {
  const auto v = [&](const char* x, const char* y, const char* z) { return vector_text(dimension, {x, y, z}); };
  std::string text = "shape = \"" + shape + "\"\n";
  if (shape == "box") text += "lower = " + v("0.1", "0.1", "0.1") + "\nupper = " + v("0.4", "0.5", "0.6") + "\n";
  if (shape == "sphere") text += "center = " + v("0.5", "0.5", "0.5") + "\nradius = 0.25\n";
  if (shape == "cylinder" || shape == "capsule") {
    text += "from = " + v("0.2", "0.2", "0.2") + "\nto = " + v("0.8", "0.2", "0.2") + "\nradius = 0.1\n";
  }
  if (shape == "plane") text += "point = " + v("0", "0.5", "0") + "\nnormal = " + v("0", "1", "0") + "\n";
  if (shape == "polygon") text += "points = [[0.1, 0.1], [0.4, 0.1], [0.3, 0.5]]\n";
  if (shape == "mesh") text += "file = \"s.obj\"\n";
  if (shape == "height_map")
    text += "lower = " + v("0", "0.1", "0") + "\nupper = " + v("1", "0.5", "1") + "\nfile = \"s.png\"\nup = \"-y\"\n";
  if (shape == "level_set") text += "file = \"s.vdb\"\n";
  if (shape == "expression") text += "phi = \"sqrt(x*x+y*y)-0.3\"\n";
  return text;
}

std::string side_text(int dimension, const std::string& side) {
  if (side == "waves")
    return R"({ type = "waves", waves = { depth = 1, height = 0.05, period = 2, spectrum = "jonswap", level = 1 } })";
  if (side == "outflow") return R"({ type = "outflow", pressure = "10*t" })";
  if (side == "inflow" || side == "moving_wall") {
    return fmt::format("{{ type = \"{}\", velocity = {} }}", side, vector_text(dimension, {"\"y*(1-y)\"", "0", "0.5"}));
  }
  return '"' + side + '"';
}

const std::string tail = "until = 1.5\n[[liquid.sponge]]\nrate = \"1+x\"\nside = \"x_upper\"\nlength = 0.2\n";

// A drain that moves by `way` about a center, and a source.
std::string feed_text(const std::string& placed, const std::string& begin, const std::string& way,
                      const std::string& center, const std::string& velocity) {
  return "[[liquid.drain]]\n" + placed + begin +
         " = 0.5\nuntil = 1.5\nrate = \"0.1*t\"\nmotion = { translate = " + way +
         ", rotate = { axis = [0, 0, 1], center = " + center + ", degrees = \"90*t\" } }\n[[liquid.source]]\n" +
         placed + "velocity = " + velocity + "\n" + begin + " = 0.5\n" + tail;
}

// A contact pair and a force.
std::string force_text(const std::string& acceleration) {
  return "[[contact]]\nbetween = [\"still\", \"so?t\"]\nfriction = 0.2\nrestitution = 0\ncollide = true\n"
         "[[force]]\nname = \"pull\"\nkind = \"acceleration\"\nacts_on = \"all\"\nsolids = [\"s*\"]\nacceleration = " +
         acceleration + "\n";
}

}  // namespace

Scene parse(const std::string& text, const Overrides& overrides, const std::filesystem::path& folder) {
  return parse_scene(text, "scene.toml", folder, overrides);
}

std::string fault(const std::string& text, const Overrides& overrides, const std::filesystem::path& folder) {
  try {
    parse(text, overrides, folder);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  FAIL_CHECK("the scene was accepted");
  return "";
}

void check_refused(const std::string& text, const std::string& expected) {
  INFO(text);
  const std::string message = fault(text);
  CHECK_THAT(message, Catch::Matchers::StartsWith("scene.toml:"));
  CHECK_THAT(message, Catch::Matchers::Contains(expected));
}

const std::string liquid_text =
    "[liquid]\ndensity = 998.2\nseparates = true\nviscosity = \"1+x\"\nsurface_tension = 0.07\n"
    "surface_tension_scheme = \"semi_implicit\"\ncontact_angle = 60\nvelocity = ";

const std::string solver_text =
    "[solver]\ntolerance = 1e-9\npreconditioner = \"boomeramg\"\nviscosity = \"coupled\"\nrheology_tolerance = "
    "1e-3\nrheology_iterations = 7\n";

// "line" and "plane": of pressures.
static std::string probe_text(int dimension, const std::string& probe) {
  const auto v = [&](const char* x, const char* y, const char* z) { return vector_text(dimension, {x, y, z}); };
  const bool many = probe == "line" || probe == "plane", box = probe == "flux" || probe == "volume",
             loads = probe == "force" || probe == "torque";
  std::string text = "[[probe]]\nname = \"p\"\nkind = \"" + (many ? "pressure" : probe) + "\"\nevery = 0.01\n";
  if (probe == "displacement") text += "solid = \"soft\"\n";
  if (probe == "line")
    text += "from = " + v("0.1", "0.5", "0.5") + "\nto = " + v("0.7", "0.5", "0.5") + "\ncount = 4\n";
  if (probe == "plane")
    text += "corner = " + v("0.1", "0.5", "0.5") + "\nedge_a = " + v("0.5", "0", "0") +
            "\nedge_b = " + v("0", "0.5", "0") + "\ncounts = [3, 2]\n";
  if (box)
    text += "lower = " + v("0.5", "0.1", "0.2") + "\nupper = " + v(probe == "flux" ? "0.5" : "0.7", "1", "1") + "\n";
  if (loads) text += "solids = [\"so?t\", \"*ill\"]\n";
  if (probe == "torque") text += "about = " + v("0.5", "0.1", "0.2") + "\n";
  if (!many && !box && !loads && probe != "front" && probe != "joint")
    text += "position = " + v("0.5", "0.5", "0.5") + "\n";
  return text;
}

// A solid on a spring.
static std::string bob(const std::string& center) {
  return "[[solid]]\nname = \"bob\"\nkind = \"sprung\"\nshape = \"sphere\"\ncenter = " + center +
         "\nradius = 0.05\ndensity = 700\nspring_stiffness = 50\nspring_damping = 0.5\n";
}

// Joints of the rigid solid: with forces, driven, of two axes, a rope, and a gear of the first two.
static std::string joints(int dimension, const std::string& at, const std::string& to) {
  const std::string between = "between = [\"solid3\", \"world\"]\nat = " + at + "\n";
  const std::string along_z = dimension == 3 ? "axis = [0, 0, 1]\n" : "";
  return "[[joint]]\nname = \"door\"\nkind = \"hinge\"\n" + between + along_z +
         "limits = [-30, 40]\nspring = { stiffness = 2, damping = 0.1, rest = 5 }\nmotor = { target = \"10*t\", "
         "stiffness = 3, damping = 0.2, torque = 4 }\nbreaks_at = { force = 500, torque = 50 }\nfriction = "
         "0.1\nradius = 0.01\ncollide = true\n[[joint]]\nname = \"slide\"\nkind = \"slider\"\n" +
         between + "axis = [1, 0, 0]\ndrive = { translate = \"0.1*t\" }\n[[joint]]\nkind = " +
         (dimension == 3 ? "\"universal\"\naxis = [1, 0, 0]\nsecond_axis = [0, 1, 0]\n" : "\"weld\"\n") + between +
         "[[joint]]\nkind = \"rope\"\n" + between + "to = " + to +
         "\nlength = 3\n[[joint]]\nkind = \"gear\"\nbetween = [\"door\", \"slide\"]\nratio = -2\n";
}

std::string rich_scene(int dimension, const std::string& shape, const std::string& side, const std::string& probe) {
  const auto v = [&](const char* x, const char* y, const char* z) { return vector_text(dimension, {x, y, z}); };
  const std::string form = geometry(dimension, shape);
  const std::string placed =
      form +
      "invert = false\nscale = 1.5\nrotate = { axis = [0, 0, 1], degrees = 10 }\ntranslate = " + v("0.1", "0", "0") +
      "\n";
  std::string text = fmt::format("title = \"rich \\\"scene\\\"\"\ndimension = {}\ngravity = {}\n", dimension,
                                 v("0", "-9.81", side == "waves" ? "0" : "1"));
  text += fmt::format("[domain]\nlower = {}\nupper = {}\ncell_size = 0.125\n", v("0", "0", "0"), v("1", "2", "1"));
  text += fmt::format("[domain.boundary]\nx_lower = {}\nx_upper = {}\ny_lower = \"no_slip\"\n",
                      side_text(dimension, side), side == "periodic" ? "\"periodic\"" : "{ type = \"outflow\" }");
  text += "[time]\nend = 2\nframe_rate = 30\ncfl = 2\nmax_step = 0.01\nfixed_step = 0.005\nscheme = \"first_order\"\n";
  text += liquid_text + v("\"sin(x)\"", "0", "0") + "\n";
  text += "[[liquid.region]]\n" + placed + "velocity = " + v("1", "2", "3") + "\n[[liquid.region]]\n" + form;
  const std::string begin = shape == "cylinder" || shape == "capsule" ? "start" : "from";
  text += feed_text(placed, begin, v("\"0.1*t\"", "0", "0"), v("0.5", "0.5", "0"), v("1", "0", "0"));
  text += "[[solid]]\nname = \"still\"\n" + placed +
          "slip = \"no_slip\"\ncontact_angle = 120\n[[solid]]\nkind = \"kinematic\"\n" + form +
          "motion = { translate = " + v("\"0.1*sin(6.28*t)\"", "0", "0") +
          ", rotate = { axis = [0, 0, 1], center = " + v("0.5", "0.5", "0") + ", degrees = \"90*t\" } }\n";
  text += "[[solid]]\nkind = \"rigid\"\nshape = \"sphere\"\ncenter = " + v("0.5", "0.5", "0.5") +
          "\nradius = 0.1\ndensity = 400\nvelocity = " + v("0", "0.5", "0") +
          "\nangular_velocity = " + (dimension == 2 ? "2.5" : "[0, 2.5, 0]") +
          "\nfixed = " + (dimension == 2 ? "[\"x\"]" : "[\"x\", \"rotation_x\", \"rotation_z\"]") +
          "\nfriction = 0.3\n";
  text += "[[solid]]\nname = \"soft\"\nkind = \"elastic\"\nshape = \"sphere\"\ncenter = " + v("0.5", "0.5", "0.5") +
          "\nradius = 0.1\ndensity = 1100\nelement_size = 0.05\nelement_order = 2\nbody_force = " +
          v("\"10*sin(x+t)\"", "0", "0") +
          "\nmaterial = { model = \"corotated\", youngs_modulus = 1e6, poisson_ratio = 0.4, damping = 1e-3, "
          "mass_damping = 0.1 }\n[solid.pinned]\n" +
          placed + "motion = { translate = " + v("0", "\"0.01*t\"", "0") + " }\n[solid.traction]\n" + placed +
          "stress = " + v("\"1e3*x*t\"", "0", "0") + "\n";
  if (side != "periodic") text += bob(v("0.2", "0.2", "0.2"));
  text += joints(dimension, v("0.5", "0.5", "0.5"), v("0.5", "1.5", "0.5")) + probe_text(dimension, probe);
  text += force_text(v("\"sin(t)\"", "0", "0")) + "[tracking]\nmethod = \"level_set\"\n" + solver_text;
  return text + "[output]\nframes = [\"surface\", \"viscosity\"]\nformats = [\"vdb\", \"vtk\"]\ncheckpoint_every = 5\n";
}

std::size_t count_lines(const std::string& text) {
  return std::size_t(std::count(text.begin(), text.end(), '\n')) + 1;
}

}  // namespace seiche::testing
