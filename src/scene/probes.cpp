#include "scene/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/gravity.h"
#include "base/name_pattern.h"
#include "base/options.h"
#include "base/scene.h"
#include "base/suggest.h"

namespace seiche {
namespace {

// Probes of one scene.
constexpr std::size_t most_probes = 100000;

// One [[probe]] and where to report.
class ProbeChecker {
 public:
  ProbeChecker(SceneContext& context, const TomlNode& root, const Scene& scene, std::size_t index)
      : context_(context), root_(root), scene_(scene), probe_(scene.probes[index]), index_(index) {}

  void check() const {
    if (!context_.clean(fmt::format("probe.{}", index_))) return;
    if (probe_.has_position())
      for (const auto& [key, x] : corners()) check_point(key, x);
    if (probe_.has_box()) {
      check_point("lower", probe_.lower);
      check_point("upper", probe_.upper);
    }
    if (probe_.kind == ProbeKind::displacement) check_followed();
    if (probe_.sums_loads()) check_group();
  }

 private:
  void report(const std::string& key, const std::string& text) const {
    const std::string path = fmt::format("probe.{}.{}", index_, key);
    context_.report(path, line_of(root_, path), fmt::format("probe \"{}\" {}", probe_.name, text));
  }

  // Points whose convex hull holds all that are measured.
  std::vector<std::pair<std::string, Vec3>> corners() const {
    const ProbeArraySpec& a = probe_.array;
    if (a.from) return {{"from", *a.from}, {"to", *a.to}};
    if (!a.corner) return {{"position", probe_.position}};
    const Vec3 opposite = *a.corner + *a.edge_a + *a.edge_b;
    return {{"corner", *a.corner},
            {"edge_a", *a.corner + *a.edge_a},
            {"edge_b", *a.corner + *a.edge_b},
            {"corner", opposite}};
  }

  void check_point(const std::string& key, const Vec3& x) const {
    Eigen::Index down = 0;
    Gravity(scene_.gravity).at(0).cwiseAbs().maxCoeff(&down);
    for (int axis = 0; axis < scene_.dimension; ++axis) {
      const bool along_column = probe_.kind == ProbeKind::surface_height && axis == down;
      const double low = scene_.domain.lower[axis], high = scene_.domain.upper[axis];
      if (along_column || (x[axis] >= low && x[axis] <= high)) continue;
      report(key,
             fmt::format("lies outside the domain: {} = {} is not within {} and {}", "xyz"[axis], x[axis], low, high));
    }
  }

  static std::string remedy(const std::string& name, const std::vector<std::string>& names) {
    const auto near = suggest(name, names);
    return near            ? "did you mean \"" + *near + "\"?"
           : names.empty() ? "the scene has none"
                           : "there is " + quoted_list(names);
  }

  void check_followed() const {
    std::vector<std::string> names;
    for (const SolidSpec& solid : scene_.solids)
      if (solid.kind.has_elements) names.push_back(solid.name);
    if (std::ranges::find(names, probe_.solid) != names.end()) return;
    report("solid",
           fmt::format("needs an elastic solid, and \"{}\" is none; {}", probe_.solid, remedy(probe_.solid, names)));
  }

  void check_group() const {
    constexpr std::size_t most_listed = 12;
    std::vector<std::string> names;
    for (const SolidSpec& solid : scene_.solids) names.push_back(solid.name);
    for (const std::string& wanted : probe_.solids) {
      if (std::ranges::any_of(names, [&](const std::string& name) { return fits(name, wanted); })) continue;
      std::vector<std::string> listed = names;
      if (listed.size() > most_listed) listed.resize(most_listed);
      report("solids", fmt::format("sums loads of \"{}\", but no solid is named {}; {}", wanted,
                                   is_pattern(wanted) ? "like that" : "so", remedy(wanted, listed)));
    }
  }

  SceneContext& context_;
  const TomlNode& root_;
  const Scene& scene_;
  const ProbeSpec& probe_;
  std::size_t index_;
};

ProbeSpec probe_at(const ProbeSpec& whole, const Vec3& x, const std::string& number) {
  ProbeSpec one = whole;
  one.array = {};
  one.position = x;
  one.name = whole.name + "-" + number;
  return one;
}

// Share i of the way between the ends, which are met exactly.
double share_of_way(int i, int count) {
  return double(i) / (count - 1);
}

void append_points(const ProbeSpec& probe, std::vector<ProbeSpec>& all) {
  const ProbeArraySpec& a = probe.array;
  if (!a.any()) return all.push_back(probe);
  if (a.from) {
    for (int i = 0; i < *a.count; ++i) {
      const double t = share_of_way(i, *a.count);
      all.push_back(probe_at(probe, (1 - t) * *a.from + t * *a.to, std::to_string(i + 1)));
    }
    return;
  }
  const int along_a = int((*a.counts)[0]), along_b = int((*a.counts)[1]);
  for (int j = 0; j < along_b; ++j)
    for (int i = 0; i < along_a; ++i)
      all.push_back(probe_at(probe,
                             *a.corner + share_of_way(i, along_a) * *a.edge_a + share_of_way(j, along_b) * *a.edge_b,
                             fmt::format("{}-{}", i + 1, j + 1)));
}

}  // namespace

void check_probes(SceneContext& context, const TomlNode& root, const Scene& scene) {
  for (std::size_t i = 0; i < scene.probes.size(); ++i) ProbeChecker(context, root, scene, i).check();
}

void expand_probes(SceneContext& context, const TomlNode& root, Scene& scene) {
  const auto report = [&](const std::string& text) { context.report("probe", line_of(root, "probe"), text); };
  std::vector<ProbeSpec> all;
  for (const ProbeSpec& probe : scene.probes) {
    append_points(probe, all);
    if (all.size() > most_probes) return report(fmt::format("more than {} points of probes; use fewer", most_probes));
  }
  std::set<std::string> names;
  for (const ProbeSpec& probe : all)
    if (!names.insert(probe.name).second)
      report(fmt::format("there are two probes \"{}\", one of them a point of an array; rename one", probe.name));
  scene.probes = std::move(all);
}

}  // namespace seiche
