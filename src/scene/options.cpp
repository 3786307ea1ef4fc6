#include "scene/options.h"

#include <algorithm>

#include "base/scene.h"
#include "scene/waves.h"

namespace seiche {
namespace {

using T = OptionType;
using DomainBoundary = std::array<std::array<SideSpec, 2>, 3>;

Section<SideSpec> side_section() {
  using S = SideSpec;
  Section<S> s;
  s.keys = {
      choice_key<S, SideType S::*, SideType>(
          {.key = "type", .presence = Presence::required, .doc = "what the side does"}, &S::type,
          {{"free_slip", SideType::free_slip},
           {"no_slip", SideType::no_slip},
           {"periodic", SideType::periodic},
           {"inflow", SideType::inflow},
           {"outflow", SideType::outflow},
           {"moving_wall", SideType::moving_wall},
           {"waves", SideType::waves}}),
      value_key<S>({.key = "velocity",
                    .type = T::formula_vector,
                    .unit = "m/s",
                    .variables = "xyzt",
                    .only_for = {"type", {"inflow", "moving_wall"}},
                    .presence = Presence::required,
                    .doc = "velocity of the liquid or the wall"},
                   &S::velocity),
      value_key<S>({.key = "pressure",
                    .type = T::formula,
                    .unit = "Pa",
                    .variables = "xyzt",
                    .only_for = {"type", {"outflow"}},
                    .unset = "0.0",
                    .doc = "pressure outside; what comes in has been at rest there"},
                   &S::pressure),
      inline_key<S>({.key = "waves",
                     .only_for = {"type", {"waves"}},
                     .presence = Presence::required,
                     .doc = "waves that enter here, and whether waves may leave; see waves.md"},
                    &S::waves, side_waves_section()),
  };
  return s;
}

// A string stands for a table with only a type.
TomlNode side_table(const TomlNode& node) {
  if (!is_text(node)) return node;
  TomlNode table;
  table.line = node.line;
  table.entries.push_back({"type", node.line, node});
  return table;
}

Key<DomainBoundary> side_key(int axis, int end) {
  const std::string name = std::string(1, "xyz"[axis]) + (end == 0 ? "_lower" : "_upper");
  const Section<SideSpec> section = side_section();
  const std::vector<Option> options = own_options(section);
  const Option option{
      .key = name, .type = T::table, .fallback = "\"free_slip\"", .doc = "a type in quotes, or a table as below"};
  Key<DomainBoundary> key{option, {}, {}, [section] { return all_options(section); }};
  key.read = [=](SceneContext& c, const Place& p, DomainBoundary& sides) {
    const TomlNode table = side_table(*p.node);
    const Place place{&table, p.path};
    if (check_is_table(c, place, option)) read_section(c, place, section, options, sides[axis][end]);
  };
  key.write = [=](const DomainBoundary& sides, int dimension, const std::string& path, SceneLines& lines) {
    if (axis >= dimension) return;
    const SceneLines inner = write_section(section, sides[axis][end], dimension, join_path(path, name));
    lines.push_back({join_path(path, name), name, inner.size() == 1 ? inner[0].text : inline_table(inner)});
  };
  return key;
}

Section<DomainBoundary> boundary_section() {
  Section<DomainBoundary> s;
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) s.keys.push_back(side_key(axis, end));
  }
  s.finish = [](SceneContext& c, const Place& p, DomainBoundary&) {
    for (const TomlEntry& entry : p.node->entries) {
      const bool beyond = c.dimension == 2 && (entry.key == "z_lower" || entry.key == "z_upper");
      if (beyond)
        c.report(join_path(p.path, entry.key), entry.line, entry.key + " is for 3D; this scene has dimension = 2");
    }
  };
  return s;
}

Section<DomainSpec> domain_section() {
  using S = DomainSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "lower", .type = T::vector, .unit = "m", .unset = "the origin", .doc = "low corner"},
                   &S::lower),
      value_key<S>(
          {.key = "upper", .type = T::vector, .unit = "m", .presence = Presence::required, .doc = "high corner"},
          &S::upper),
      value_key<S>({.key = "cell_size",
                    .unit = "m",
                    .range = positive(),
                    .presence = Presence::required,
                    .doc = "edge of a cell; each extent must be a whole number of cells"},
                   &S::cell_size),
      block_key<S>({.key = "boundary", .unset = "free_slip on all sides", .doc = "what each side of the domain does"},
                   &S::sides, boundary_section()),
  };
  return s;
}

Section<TimeSpec> time_section() {
  using S = TimeSpec;
  Section<S> s;
  const Range period{shortest_time, number_limit};
  s.keys = {
      value_key<S>(
          {.key = "end", .unit = "s", .presence = Presence::required, .doc = "end of the run; 0 or less: no steps"},
          &S::end),
      value_key<S>({.key = "frame_rate",
                    .unit = "1/s",
                    .range = between(1e-9, 1e6),
                    .doc = "frames written a second of simulated time"},
                   &S::frame_rate),
      value_key<S>({.key = "cfl", .range = positive(8), .doc = "cells the fastest flow may cross in a step"}, &S::cfl),
      value_key<S>({.key = "max_step", .unit = "s", .range = period, .unset = "no limit", .doc = "longest step"},
                   &S::max_step),
      value_key<S>({.key = "fixed_step",
                    .unit = "s",
                    .range = period,
                    .unset = "steps follow cfl",
                    .doc = "pins the step, but for the last one before a frame; a step that would carry the flow "
                           "beyond cfl cells, rounded up, or a solid beyond one is not taken: the run ends"},
                   &S::fixed_step),
      choice_key<S, TimeScheme S::*, TimeScheme>(
          {.key = "scheme", .doc = "order of the time stepping"}, &S::scheme,
          {{"first_order", TimeScheme::first_order}, {"second_order", TimeScheme::second_order}}),
  };
  return s;
}

Section<Scene> tracking_section() {
  const std::string reason = "particles are not in this version";
  Section<Scene> s;
  s.keys = {value_key<Scene>({.key = "method",
                              .type = T::choice,
                              .choices = {"level_set"},
                              .refused = {{"particle_level_set", reason}, {"apic", reason}},
                              .doc = "how the liquid surface is followed"},
                             &Scene::tracking)};
  return s;
}

Section<SolverSpec> solver_section() {
  using S = SolverSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "tolerance",
                    .range = positive(1e-2),
                    .doc = "relative residual of the pressure solve; at most 1e-7 beside elastic solids"},
                   &S::tolerance),
      value_key<S>({.key = "preconditioner",
                    .type = T::choice,
                    .choices = {"auto", "boomeramg", "geometric", "multigrid", "none"},
                    .doc = "preconditioner of the pressure solve"},
                   &S::preconditioner),
      value_key<S>({.key = "elastic",
                    .type = T::choice,
                    .choices = {"auto", "factor", "iterate"},
                    .doc = "elastic solids in liquid: by Cholesky factors, or by multigrid together with the pressure "
                           "(for solids whose factors would not fit into memory; auto: beyond 4 GB)"},
                   &S::elastic),
  };
  for (Key<S>& key : viscous_solver_keys()) s.keys.push_back(std::move(key));
  return s;
}

Section<OutputSpec> output_section() {
  using S = OutputSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "frames",
                    .type = T::choice_list,
                    .choices = {"surface", "velocity", "pressure", "viscosity", "vorticity", "solids"},
                    .doc = "fields of a frame"},
                   &S::frames),
      value_key<S>(
          {.key = "formats", .type = T::choice_list, .choices = {"vdb", "vtk"}, .doc = "file formats of the frames"},
          &S::formats),
      value_key<S>({.key = "surface",
                    .type = T::choice,
                    .choices = {"closed", "free"},
                    .doc = "level set of the frames: closed at walls and solids, so that it encloses the liquid "
                           "alone, with free_surface beside it as the solver has it; free: the latter alone"},
                   &S::surface),
      value_key<S>({.key = "velocity_name",
                    .type = T::choice,
                    .choices = {"vel", "velocity"},
                    .doc = "name of the velocity's grid in .vdb files: \"velocity\" is that which Blender looks for"},
                   &S::velocity_name),
      value_key<S>(
          {.key = "up",
           .type = T::choice,
           .choices = {"scene", "y", "z"},
           .doc = "axis that points up in files of `seiche export`, unless --up tells another; frames keep the "
                  "scene's axes"},
          &S::up),
      value_key<S>({.key = "checkpoint_every",
                    .type = T::integer,
                    .unit = "frames",
                    .range = between(1, 1e9),
                    .doc = "frames between checkpoints"},
                   &S::checkpoint_every),
  };
  return s;
}

// All keys that depend on the number of dimensions come after this one.
Key<Scene> dimension_key() {
  Key<Scene> key = value_key<Scene>({.key = "dimension", .type = T::integer, .range = between(2, 3), .doc = "2 or 3"},
                                    &Scene::dimension);
  const auto read = key.read;
  key.read = [read](SceneContext& c, const Place& p, Scene& scene) {
    read(c, p, scene);
    c.dimension = c.clean(p.path) ? scene.dimension : 0;
  };
  return key;
}

bool has_files(const Scene& scene) {
  const auto named = [](const auto& s) { return !s.shape.file.empty(); };
  const auto any = [&](const auto& list) { return std::any_of(list.begin(), list.end(), named); };
  const auto has_pin = [&](const SolidSpec& s) { return any(s.elastic.pinned); };
  return any(scene.liquid.regions) || any(scene.liquid.sources) || any(scene.liquid.drains) || any(scene.solids) ||
         std::any_of(scene.solids.begin(), scene.solids.end(), has_pin);
}

// A normalised scene has absolute paths, so it must permit outside files if it names any.
Key<Scene> access_key() {
  const Option option{.key = "allow_outside_files",
                      .type = T::boolean,
                      .fallback = "false",
                      .doc = "true: files may lie outside the scene's folder"};
  Key<Scene> key{option, {}, {}};
  key.read = [option](SceneContext& c, const Place& p, Scene&) {
    bool allowed = false;
    read_value(c, p, option, allowed);
    if (allowed) c.access = FileAccess::anywhere;
  };
  key.write = [option](const Scene& s, int dimension, const std::string&, SceneLines& lines) {
    lines.push_back({option.key, option.key, to_toml(has_files(s), option, dimension)});
  };
  return key;
}

Key<Scene> gravity_key() {
  return value_key<Scene>(
      {.key = "gravity",
       .type = T::formula_vector,
       .unit = "m/s^2",
       .variables = "t",
       .doc = "acceleration, the same everywhere; a step takes that at its middle"},
      [](auto& s) -> auto& { return s.gravity.formula; });
}

Key<Scene> robot_key() {
  return list_key<Scene, RobotSpec>(
      {.key = "robot",
       .unset = "none",
       .doc = "links and joints of a robot's file (URDF), which become rigid solids and joints; see "
              "joints.md",
       .most = most_entries},
      &Scene::robots, robot_section());
}

// Keys of solids and of what acts between them and on them.
std::vector<Key<Scene>> solid_keys_of_scene() {
  using S = Scene;
  return {
      list_key<S, SolidSpec>({.key = "solid", .unset = "none", .doc = "solids in the liquid", .most = most_entries},
                             &S::solids, solid_section()),
      list_key<S, JointSpec>({.key = "joint",
                              .unset = "none",
                              .doc = "joints between solids, which then move as one mechanism; see joints.md",
                              .most = most_entries},
                             &S::joints, joint_section()),
      robot_key(),
      list_key<S, ContactSpec>({.key = "contact",
                                .unset = "all solids touch, with friction by their own coefficients",
                                .doc = "friction of pairs of solids, and pairs that pass through each other",
                                .most = most_entries},
                               &S::contacts, contact_section()),
      list_key<S, ForceSpec>({.key = "force",
                              .unset = "gravity alone",
                              .doc = "forces on liquid and solids: fields, wind, loads; see forces.md",
                              .most = 100},
                             &S::forces, force_section()),
  };
}

Section<Scene> build_scene_section() {
  using S = Scene;
  const auto itself = [](auto& s) -> auto& {
    return s;
  };
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "title", .type = T::text, .doc = "for people"}, &S::title),
      dimension_key(),
      access_key(),
      gravity_key(),
      block_key<S>({.key = "domain", .presence = Presence::required, .doc = "the box of cells (upper, cell_size)"},
                   &S::domain, domain_section()),
      block_key<S>({.key = "time", .presence = Presence::required, .doc = "how long (end) and in which steps"},
                   &S::time, time_section()),
      block_key<S>({.key = "liquid", .unset = "no liquid", .doc = "the liquid and where it is"}, &S::liquid,
                   liquid_section()),
      gas_key(),
      list_key<S, ProbeSpec>({.key = "probe",
                              .unset = "none",
                              .doc = "measurements for probes.csv; a row without values where there is nothing to "
                                     "measure, such as pressure or velocity in the air",
                              .most = most_entries},
                             &S::probes, probe_section()),
      block_key<S>({.key = "tracking", .doc = "the liquid surface"}, itself, tracking_section()),
      block_key<S>({.key = "solver", .doc = "the solves for pressure and viscosity"}, &S::solver, solver_section()),
      block_key<S>({.key = "output", .doc = "what is written"}, &S::output, output_section()),
  };
  const std::vector<Key<S>> naming = naming_keys(), solids = solid_keys_of_scene();
  s.keys.insert(s.keys.begin() + 8, solids.begin(), solids.end());
  s.keys.insert(s.keys.begin() + 4, naming.begin(), naming.end());  // before the first table, as TOML wants values
  return s;
}

}  // namespace

const Section<Scene>& scene_section() {
  static const Section<Scene> section = build_scene_section();  // the table is constant
  return section;
}

std::vector<Option> scene_options() {
  return all_options(scene_section());
}

}  // namespace seiche
