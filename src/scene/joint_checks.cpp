// Checks joints against the solids that they join.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/expression.h"
#include "base/scene.h"
#include "base/suggest.h"
#include "scene/checks.h"
#include "scene/formula.h"
#include "solid/joint/joint.h"

namespace seiche {
namespace {

class JointChecker {
 public:
  JointChecker(SceneContext& context, const TomlNode& root, const Scene& scene, std::size_t index)
      : context_(context), root_(root), scene_(scene), joint_(scene.joints[index]), index_(index) {}

  void run() {
    if (joint_.kind == JointKind::gear) return check_gear();
    check_solids();
    check_dimension();
    check_axis_of_joint();
    check_ends();
    check_forces();
  }

 private:
  void report(const std::string& key, const std::string& text) const {
    const std::string path = fmt::format("joint.{}{}", index_, key.empty() ? "" : "." + key);
    context_.report(path, line_of(root_, path), fmt::format("joint \"{}\": {}", joint_.name, text));
  }

  const SolidSpec* find(const std::string& name) const {
    const auto found =
        std::find_if(scene_.solids.begin(), scene_.solids.end(), [&](auto& s) { return s.name == name; });
    return found == scene_.solids.end() ? nullptr : &*found;
  }

  void check_solids() const {
    std::vector<std::string> names{"world"};
    for (const SolidSpec& solid : scene_.solids) names.push_back(solid.name);
    bool moves = false, known = true;
    for (const std::string& name : joint_.between) {
      const SolidSpec* solid = find(name);
      moves = moves || (solid && solid->kind.is_free());
      if (!solid && name != "world") {
        known = false;
        const auto near = suggest(name, names);
        report("between", fmt::format("no solid is named \"{}\"; {}", name,
                                      near ? "did you mean \"" + *near + "\"?" : "there is " + quoted_list(names)));
      } else if (solid && !may_be_jointed(solid->kind)) {
        known = false;
        report("between", fmt::format("solid \"{}\" is {}; joints hold rigid, elastic, kinematic and static solids",
                                      name, solid->kind.name));
      }
    }
    check_regions();
    if (known && !moves)
      report("between",
             fmt::format("\"{}\" and \"{}\" do not move by forces, so a joint does nothing; make one of them "
                         "rigid",
                         joint_.between[0], joint_.between[1]));
  }

  static bool may_be_jointed(const SolidKind& kind) {
    return !kind.follows_meshes && (kind.has_elements || !kind.is_free() || kind.may_turn);
  }

  bool is_elastic(const std::string& name) const {
    const SolidSpec* solid = find(name);
    return solid && solid->kind.has_elements;
  }

  void check_regions() const {
    const bool first = is_elastic(joint_.between[0]), second = is_elastic(joint_.between[1]);
    if ((first || second) && !joint_.region)
      report("between", fmt::format("\"{}\" is elastic; give region, the shape whose nodes the joint holds, such as "
                                    "{{ shape = \"sphere\", center = [0, 0, 0], radius = 0.1 }}",
                                    joint_.between[first ? 0 : 1]));
    if (joint_.region && !first && !second)
      report("region", "neither of its solids is elastic, so it holds all of them; remove region");
    if (joint_.second_region && !second)
      report("second_region", fmt::format("\"{}\" is not elastic; remove second_region", joint_.between[1]));
  }

  void check_dimension() const {
    using K = JointKind;
    const bool only_3d = joint_.kind == K::ball || joint_.kind == K::cylindrical || joint_.kind == K::universal ||
                         joint_.kind == K::planar;
    if (scene_.dimension == 2 && only_3d)
      report("kind", fmt::format("a {} joint exists in 3D only{}", name_of(joint_.kind),
                                 joint_.kind == K::ball ? "; in 2D a hinge turns about a point" : ""));
  }

  void check_axis_of_joint() const {
    using K = JointKind;
    const bool flat_hinge = scene_.dimension == 2 && joint_.kind == K::hinge;
    const bool wants = joint_.kind == K::slider || joint_.kind == K::cylindrical || joint_.kind == K::universal ||
                       joint_.kind == K::planar || joint_.kind == K::hinge;
    const bool given = !joint_.axis.isZero(0);
    if (flat_hinge && given) report("axis", "a hinge in 2D turns about z; remove axis");
    if (wants && !flat_hinge && !given) report("axis", "it needs an axis that is not zero, such as [0, 0, 1]");
    if (scene_.dimension == 2 && joint_.kind == K::slider && joint_.axis[2] != 0)
      report("axis", "a slider in 2D slides in the plane; the third component of its axis must be 0");
    if (joint_.kind != K::universal || !given) return;
    constexpr double square = 1e-6;  // the axes' own decimals
    if (joint_.second.isZero(0) || std::abs(joint_.axis.normalized().dot(joint_.second.normalized())) > square)
      report("second_axis", "it must be perpendicular to axis");
  }

  void check_ends() const {
    if (coordinate_of(joint_.kind) != JointCoordinate::length) return;
    const double length = (joint_.at - joint_.to).norm();
    if (length == 0) report("to", "its ends coincide; give two points");
    if (joint_.length && *joint_.length < length)
      report("length", fmt::format("a rope of {} m does not reach from at to to, {:.6g} m", *joint_.length, length));
  }

  void check_forces() const {
    const bool turns = coordinate_of(joint_.kind) == JointCoordinate::turn;
    if (joint_.drive && joint_.motor) report("drive", "it has a motor, too; give one of them");
    if (joint_.drive) check_drive(turns);
    if (joint_.motor)
      for (const auto* formula : {&joint_.motor->speed, &joint_.motor->target})
        if (*formula && !signal_in(**formula)) check_finite("motor", Expression(**formula));
    if (joint_.motor && (turns ? joint_.motor->force : joint_.motor->torque))
      report("motor", turns ? "a hinge has a largest torque, not a force" : "it has a largest force, not a torque");
    if (joint_.friction > 0 && turns && !joint_.radius)
      report("friction", "friction of a hinge acts at the radius of its pin; give radius");
    if (joint_.limits) check_limits();
  }

  void check_drive(bool turns) const {
    if (turns != joint_.drive->degrees.has_value())
      return report("drive", turns ? "a hinge is driven by degrees" : "it is driven by translate, in m");
    const Formula& text = turns ? *joint_.drive->degrees : *joint_.drive->translate;
    if (const auto signal = signal_in(text))
      return report("drive", fmt::format("it uses the signal {}, which jumps; let a motor follow it", *signal));
    const Expression formula(text);
    const double start = formula(Vec3::Zero(), 0);
    constexpr double zero = 1e-9;
    if (!(std::abs(start) <= zero))
      report("drive", fmt::format("it must be 0 at t = 0, where the solids are as placed; it is {:g}", start));
    else if (check_finite("drive", formula))
      check_jumps(formula, turns);
  }

  double time_of(int sample) const { return scene_.time.end * sample / samples; }

  bool check_finite(const std::string& key, const Expression& formula) const {
    for (int i = 0; i <= samples; ++i)
      if (!std::isfinite(formula(Vec3::Zero(), time_of(i)))) {
        report(key, fmt::format("its formula is not finite at t = {:.6g} s", time_of(i)));
        return false;
      }
    return true;
  }

  // Halves intervals in which the drive goes far. Continuous ones go less and less in them.
  void check_jumps(const Expression& formula, bool turns) const {
    constexpr int halvings = 30;
    const double most = turns ? 1 : scene_.domain.cell_size;  // degrees; m
    const auto way = [&](double a, double b) { return std::abs(formula(Vec3::Zero(), b) - formula(Vec3::Zero(), a)); };
    for (int i = 0; i < samples; ++i) {
      double from = time_of(i), to = time_of(i + 1);
      for (int n = 0; n < halvings && way(from, to) > most; ++n) {
        const double middle = 0.5 * (from + to);
        (way(from, middle) > way(middle, to) ? to : from) = middle;
      }
      if (way(from, to) <= most) continue;
      return report("drive", fmt::format("it jumps by {:.4g} {} at t = {:.6g} s; make it continuous", way(from, to),
                                         turns ? "degrees" : "m", to));
    }
  }

  void check_limits() const {
    const auto [low, high] = *joint_.limits;
    const double start = coordinate_of(joint_.kind) == JointCoordinate::length ? (joint_.at - joint_.to).norm() : 0.0;
    if (!(low < high)) return report("limits", fmt::format("{} is not below {}", low, high));
    if (start <= low || start >= high)
      report("limits", fmt::format("it starts at {:g}, which is not between {} and {}", start, low, high));
  }

  void check_gear() const {
    std::vector<std::string> names;
    for (const JointSpec& other : scene_.joints)
      if (coordinate_of(other.kind) != JointCoordinate::none && other.kind != JointKind::rope)
        names.push_back(other.name);
    for (const std::string& name : joint_.between)
      if (std::find(names.begin(), names.end(), name) == names.end())
        report("between", fmt::format("a gear joins two joints that turn or slide, and \"{}\" is none; {}", name,
                                      names.empty() ? "there are none" : "there is " + quoted_list(names)));
    if (joint_.ratio == 0) report("ratio", "it must not be 0");
  }

  static constexpr int samples = 1000;  // of a formula over the run

  SceneContext& context_;
  const TomlNode& root_;
  const Scene& scene_;
  const JointSpec& joint_;
  std::size_t index_;
};

// A joint probe must name a joint, and one with a coordinate to measure that.
void check_probed_joints(SceneContext& context, const TomlNode& root, const Scene& scene) {
  std::vector<std::string> names;
  for (const JointSpec& joint : scene.joints) names.push_back(joint.name);
  const auto report = [&](const std::string& path, const std::string& text) {
    context.report(path, line_of(root, path), text);
  };
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    const ProbeSpec& probe = scene.probes[i];
    if (probe.kind != ProbeKind::joint || !context.clean(fmt::format("probe.{}", i))) continue;
    const auto found = std::ranges::find(scene.joints, probe.joint, &JointSpec::name);
    const auto near = suggest(probe.joint, names);
    if (found == scene.joints.end())
      report(fmt::format("probe.{}.joint", i),
             fmt::format("probe \"{}\": no joint is named \"{}\"; {}", probe.name, probe.joint,
                         near            ? "did you mean \"" + *near + "\"?"
                         : names.empty() ? "the scene has none"
                                         : "there is " + quoted_list(names)));
    else if (probe.quantity == JointQuantity::coordinate && coordinate_of(found->kind) == JointCoordinate::none)
      report(fmt::format("probe.{}.quantity", i),
             fmt::format("probe \"{}\": a {} joint has no coordinate", probe.name, name_of(found->kind)));
  }
}

}  // namespace

void check_joints(SceneContext& context, const TomlNode& root, const Scene& scene) {
  constexpr std::size_t most_joints = 2000;  // their rows are factored together
  if (scene.joints.size() > most_joints)
    context.report("joint", line_of(root, "joint"),
                   fmt::format("{} joints; at most {} are possible", scene.joints.size(), most_joints));
  if (!scene.joints.empty() && scene.solver.elastic == "iterate")
    context.report("solver.elastic", line_of(root, "solver.elastic"),
                   "solver.elastic = \"iterate\" does not work with [[joint]] yet; use \"factor\" or \"auto\"");
  for (std::size_t k = 0; k < scene.solids.size() && !scene.joints.empty(); ++k)
    if (scene.solids[k].name == "world")
      context.report(fmt::format("solid.{}.name", k), line_of(root, fmt::format("solid.{}.name", k)),
                     "the name \"world\" stands for what does not move in joints; rename the solid");
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    if (context.clean(fmt::format("joint.{}", j))) JointChecker(context, root, scene, j).run();
  check_probed_joints(context, root, scene);
}

}  // namespace seiche
