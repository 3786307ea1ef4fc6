#include "scene/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

#include "base/gravity.h"
#include "base/options.h"
#include "base/scene.h"
#include "base/suggest.h"
#include "fluid/rheology/rheology.h"
#include "scene/copies.h"
#include "scene/probes.h"
#include "scene/robots.h"
#include "scene/waves.h"

namespace seiche {
namespace {

constexpr double whole_cells = 1e-6;  // relative tolerance for extents that the scene's decimals round

struct Checker {
  SceneContext& context;
  const TomlNode& root;
  void report(const std::string& path, const std::string& text) const {
    context.report(path, line_of(root, path), text);
  }
};

// True if the extent along the axis is valid; sets cells[axis].
void check_extent(const Checker& c, DomainSpec& d, int axis) {
  const char name = "xyz"[axis];
  const double extent = d.upper[axis] - d.lower[axis], cells = extent / d.cell_size, whole = std::round(cells);
  if (!(extent > 0)) {
    return c.report("domain.upper", fmt::format("the domain must have lower < upper; along {} they are {} and {}", name,
                                                d.lower[axis], d.upper[axis]));
  }
  if (cells > INT32_MAX)
    return c.report("domain.cell_size", fmt::format("{} cells along {}; raise cell_size", cells, name));
  if (std::abs(cells - whole) > whole_cells * cells) {
    return c.report(
        "domain.cell_size",
        fmt::format("the domain is {} m long along {}: {} cells of {} m; it must be a whole "
                    "number of cells (upper {} = {} would be)",
                    extent, name, cells, d.cell_size, name, d.lower[axis] + std::max(1.0, whole) * d.cell_size));
  }
  d.cells[axis] = int(whole);
}

void check_cell_count(const Checker& c, const DomainSpec& d, int dimension) {
  double cells = 1;
  std::string product;
  for (int axis = 0; axis < dimension; ++axis) {
    cells *= d.cells[axis];
    product += fmt::format("{}{}", axis ? " x " : "", d.cells[axis]);
  }
  if (cells == 1) c.report("domain.cell_size", "the domain is a single cell; lower cell_size");
  if (cells <= INT32_MAX) return;
  c.report("domain.cell_size",
           fmt::format("{} = {:.3g} cells; the linear solvers (hypre) number rows with 32-bit integers, so "
                       "at most {} cells are possible; raise cell_size",
                       product, cells, INT32_MAX));
}

void check_periodic(const Checker& c, const DomainSpec& d) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto is_periodic = [&](int end) { return d.sides[axis][end].type == SideType::periodic; };
    if (is_periodic(0) == is_periodic(1)) continue;
    const auto name = [&](int end) { return fmt::format("{}_{}", "xyz"[axis], end == 0 ? "lower" : "upper"); };
    const int given = is_periodic(0) ? 0 : 1;
    c.report("domain.boundary." + name(given),
             fmt::format("{} is periodic, so {} must be too", name(given), name(1 - given)));
  }
}

void check_domain(const Checker& c, DomainSpec& d, int dimension) {
  if (c.context.clean("domain.boundary")) check_periodic(c, d);
  if (dimension == 2) d.lower[2] = d.upper[2] = 0;
  const auto clean = [&](const char* key) { return c.context.clean(key); };
  if (!clean("domain.lower") || !clean("domain.upper") || !clean("domain.cell_size") || !c.root.find("domain")) return;
  const std::size_t before = c.context.problem_count();
  for (int axis = 0; axis < dimension; ++axis) check_extent(c, d, axis);
  if (c.context.problem_count() == before) check_cell_count(c, d, dimension);
}

void check_time(const Checker& c, TimeSpec& t) {
  constexpr double most_frames = 1e7;
  if (t.fixed_step && t.max_step && *t.fixed_step > *t.max_step) {
    c.report("time.fixed_step",
             fmt::format("time.fixed_step = {} is longer than time.max_step = {}", *t.fixed_step, *t.max_step));
  }
  if (t.end * t.frame_rate > most_frames) {
    c.report("time.frame_rate",
             fmt::format("{:.3g} frames in all; at most {:.0f} are possible; lower frame_rate or end",
                         t.end * t.frame_rate, most_frames));
  }
  t.end = std::max(t.end, 0.0);
}

// Names are written to CSV columns unchanged.
void check_name(const Checker& c, const std::string& path, const std::string& name, const TomlNode* given) {
  if (!given) return;
  const bool awkward = name.empty() || name.size() > 200 || name.find_first_of(",\"") != std::string::npos;
  if (awkward) c.report(path, path + " must have 1 to 200 characters, none of them a comma or a double quote");
}

template <class Item>
void check_names(const Checker& c, std::vector<Item>& items, const std::string& list) {
  std::set<std::string> taken;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string path = fmt::format("{}.{}.name", list, i);
    if (items[i].name.empty()) continue;
    if (!taken.insert(items[i].name).second)
      c.report(path, fmt::format("the name \"{}\" of [[{}]] is taken", items[i].name, list));
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    const TomlNode& table = c.root.find(list)->value.items[i];
    const TomlEntry* given = table.find("name");
    check_name(c, fmt::format("{}.{}.name", list, i), items[i].name, given ? &given->value : nullptr);
    if (given) continue;
    items[i].name = fmt::format("{}{}", list, i + 1);
    while (!taken.insert(items[i].name).second) items[i].name += '_';
  }
}

// Contact in liquid factors matrices of all rigid bodies together; dense ones of up to 6000 x 6000 in 3D take a GB or
// two. Tested with 1000 discs in 2D, at tens of seconds a step.
constexpr int most_rigid_solids = 1000;

bool has_dense_block(const SolidKind& kind) {
  return kind.is_free() && !kind.has_elements;
}

void check_rigid_count(const Checker& c, const Scene& scene) {
  int count = 0;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    if (!has_dense_block(scene.solids[i].kind)) continue;
    if (++count != most_rigid_solids + 1) continue;
    c.report(
        fmt::format("solid.{}.kind", i),
        fmt::format("more rigid solids than one contact solve can take: at most {} can be rigid (a few hundred are "
                    "practical, fewer where they pile up); use fewer, or kind = \"static\"",
                    most_rigid_solids));
  }
}

// Bodies cannot cross periodic sides.
void check_moving_solids(const Checker& c, const Scene& scene) {
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const SolidSpec& solid = scene.solids[i];
    const bool has_elements = solid.kind.has_elements;
    const bool is_pressure_free = solid.kind.is_free() && (!has_elements || solid.elastic.pinned.empty());
    for (int axis = 0; axis < scene.dimension && is_pressure_free; ++axis) {
      if (scene.domain.sides[axis][0].type != SideType::periodic || solid.rigid.fixed_position[axis]) continue;
      c.report(fmt::format("solid.{}.kind", i),
               fmt::format("{0} solid \"{1}\" may move along {2}, but solids cannot cross the periodic sides along "
                           "{2}; make these sides walls, or {3}",
                           solid.kind.name, solid.name, "xyz"[axis],
                           has_elements          ? "pin a part of it"
                           : solid.kind.may_turn ? fmt::format("give fixed = [\"{}\"]", "xyz"[axis])
                                                 : "make it static"));
    }
  }
}

// Resolves the regularisation. With it, the viscosity must be within the range of the solver.
void check_rheology(const Checker& c, Scene& scene) {
  RheologySpec& spec = scene.liquid.rheology;
  spec = resolve_rheology(scene);
  if (spec.model.empty() || viscosity(spec, 0) <= number_limit) return;
  const std::string remedy =
      spec.regularisation ? fmt::format("; raise regularisation, now {:g} 1/s", *spec.regularisation) : "";
  c.report("liquid.rheology",
           fmt::format("liquid.rheology: the viscosity at rest is {:g} Pa s; it must be at most {:g}{}",
                       viscosity(spec, 0), number_limit, remedy));
}

// Features that exclude gas.
void check_gas(const Checker& c, const Scene& scene) {
  if (!scene.gas.present || !scene.liquid.separates) return;
  c.report("liquid.separates",
           scene.gas.flows() ? "liquid.separates = true does not work with flowing gas, which already lets liquid "
                               "separate from solids; remove separates"
                             : "liquid.separates = true does not work with gas.bubbles = \"volume_conserving\": no air "
                               "would flow into the gap where liquid separates from a solid; remove separates");
}

// Drops are made in vacuum, of volumes in cells.
void check_spray(const Checker& c, const Scene& scene) {
  const LiquidSpec& liquid = scene.liquid;
  if (liquid.spray || (liquid.volume != VolumeKeeping::by_shift && !scene.gas.flows() && !liquid.prescribed_velocity))
    return;
  c.report("liquid.spray",
           "liquid.spray = false does not go with liquid.volume = \"shift\", gas that flows or "
           "liquid.prescribed_velocity: liquid flies as drops only without them; remove spray");
}

// Height maps without an axis of their own rise against gravity, to the axis nearest to that.
void set_axes_of_height_maps(Scene& scene) {
  Eigen::Index axis = 1;
  const Vec3 g = Gravity(scene.gravity).at(0);
  if (g.norm() > 0) g.cwiseAbs().maxCoeff(&axis);
  const std::string up = std::string(g[axis] > 0 ? "-" : "") + "xyz"[axis];
  const auto set = [&](ShapeSpec& shape) {
    if (shape.kind == "height_map" && !shape.up) shape.up = up;
  };
  for (LiquidRegionSpec& region : scene.liquid.regions) set(region.shape);
  for (LiquidSourceSpec& source : scene.liquid.sources) set(source.shape);
  for (LiquidSourceSpec& drain : scene.liquid.drains) set(drain.shape);
  for (SolidSpec& solid : scene.solids) {
    set(solid.shape);
    for (PinSpec& pin : solid.elastic.pinned) set(pin.shape);
    for (TractionSpec& traction : solid.elastic.tractions) set(traction.shape);
  }
}

}  // namespace

void check_scene(SceneContext& context, const TomlNode& root, Scene& scene) {
  const Checker c{context, root};
  if (context.dimension != 0) check_domain(c, scene.domain, context.dimension);
  if (context.clean("time")) check_time(c, scene.time);
  if (context.clean("solid")) check_names(c, scene.solids, "solid");
  if (context.clean("joint")) check_names(c, scene.joints, "joint");
  if (context.clean("probe")) check_names(c, scene.probes, "probe");
  if (context.clean("robot")) check_names(c, scene.robots, "robot");
  if (context.clean("force")) check_names(c, scene.forces, "force");
  if (context.clean("robot") && context.clean("solid") && context.clean("joint")) expand_robots(context, root, scene);
  if (context.clean("solid")) expand_copies(context, root, scene);
  if (context.clean("solid") && context.clean("gravity")) expand_waves(context, root, scene);
  if (context.clean("gravity")) set_axes_of_height_maps(scene);
  if (!context.clean("domain") || context.dimension == 0) return;
  if (context.clean("solid")) check_probes(context, root, scene);
  if (context.clean("solid")) check_moving_solids(c, scene);
  if (context.clean("solid")) check_rigid_count(c, scene);
  if (context.clean("solid") && context.clean("joint")) check_joints(context, root, scene);
  if (context.clean("solid") && context.clean("force")) check_forces(context, root, scene);
  if (context.clean("solid") && context.clean("contact")) check_contacts(context, root, scene);
  if (context.clean("solid") && context.clean("liquid")) check_attached(context, root, scene);
  if (context.clean("time")) check_motions(context, root, scene);
  if (context.clean("time") && context.clean("liquid") && context.clean("gravity")) check_rheology(c, scene);
  if (context.clean("gas") && context.clean("liquid")) check_gas(c, scene), check_spray(c, scene);
  if (context.clean("gas") && context.clean("liquid") && context.clean("solid")) {
    check_prescribed_flow(context, root, scene);
    if (context.clean("time")) check_rates(context, root, scene);
  }
  if (context.clean("gravity") && context.clean("gas") && context.clean("liquid"))
    check_side_waves(context, root, scene);
  if (context.clean("probe")) expand_probes(context, root, scene);
}

}  // namespace seiche
