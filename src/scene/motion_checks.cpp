// Checks prescribed motions over the whole run before it starts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "base/scene.h"
#include "scene/checks.h"
#include "scene/formula.h"

namespace seiche {
namespace {

// fewest_samples detects jumps that last; most_samples bounds the time of the check.
constexpr int most_samples = 2000, fewest_samples = 50;
// Shares of the domain's diagonal, and degrees: round-off of formulas that are zero at t = 0.
constexpr double start_tolerance = 1e-9;
constexpr int sample_budget = 2'000'000;  // of all solids together

struct Sampling {
  double end = 0, reach = 0;  // end: s; reach: longest displacement between two samples, m
  int count = most_samples;
};

// Fault of the motion, or "".
std::string fault_of_motion(const MotionSpec& motion, const Sampling& sampling) {
  const VectorExpression translate(motion.translate);
  const Expression degrees(motion.degrees);
  Vec3 last = Vec3::Zero();
  for (int i = 0; i <= sampling.count; ++i) {
    const double t = sampling.end * i / sampling.count;
    const Vec3 now = translate(Vec3::Zero(), t);
    if (!now.allFinite() || !std::isfinite(degrees(Vec3::Zero(), t)))
      return fmt::format("the motion is not finite at t = {} s", t);
    if (i > 0 && (now - last).norm() > sampling.reach) {
      return fmt::format(
          "the motion jumps by {:.4g} m at t = {:.6g} s, further than the domain is long ({:.4g} m); make it "
          "continuous",
          (now - last).norm(), t, sampling.reach);
    }
    last = now;
  }
  return "";
}

bool at_rest(const MotionSpec& motion) {
  const auto& t = motion.translate;
  return Expression(motion.degrees).is_constant() &&
         std::all_of(t.begin(), t.end(), [](const Formula& part) { return Expression(part).is_constant(); });
}

enum class Start { anywhere, at_rest_pose };

struct Moving {
  std::string path, subject;
  const MotionSpec* motion;
  Start start;
};

// An elastic solid starts undeformed, so its pins must start at rest positions. `size`: the domain's diagonal, m.
std::string fault_of_start(const Moving& moving, double size) {
  for (const Formula& formula :
       {moving.motion->translate[0], moving.motion->translate[1], moving.motion->translate[2], moving.motion->degrees})
    if (const auto signal = signal_in(formula))
      return fmt::format("the motion uses the signal {}, which jumps; let a joint's motor follow it", *signal);
  if (moving.start == Start::anywhere) return "";
  const Vec3 moved = VectorExpression(moving.motion->translate)(Vec3::Zero(), 0);
  const double turned = Expression(moving.motion->degrees)(Vec3::Zero(), 0);
  if (moved.norm() <= start_tolerance * size && std::abs(turned) <= start_tolerance) return "";
  return fmt::format(
      "the motion must begin at the rest pose; at t = 0 it moves by {:.4g} m and turns by {:.4g} degrees", moved.norm(),
      turned);
}

// Motions of a kinematic solid or of an elastic solid's pins.
std::vector<Moving> motions_of(const SolidSpec& solid, const std::string& path) {
  std::vector<Moving> all;
  const std::string subject = fmt::format("solid \"{}\"", solid.name);
  if (solid.kind.is_prescribed()) all.push_back({path + ".motion", subject, &solid.motion, Start::anywhere});
  const auto& pins = solid.elastic.pinned;
  for (std::size_t n = 0; n < pins.size(); ++n) {
    const std::string entry = pins.size() > 1 ? fmt::format(".{}", n) : "";
    all.push_back(
        {fmt::format("{}.pinned{}.motion", path, entry), subject + ", pinned", &pins[n].motion, Start::at_rest_pose});
  }
  return all;
}

// Motions of sources or drains of their own.
void append_motions(const std::vector<LiquidSourceSpec>& list, const std::string& name, std::vector<Moving>& all) {
  for (std::size_t n = 0; n < list.size(); ++n)
    if (list[n].motion)
      all.push_back({fmt::format("liquid.{}.{}.motion", name, n), fmt::format("liquid.{}.{}", name, n),
                     &*list[n].motion, Start::anywhere});
}

}  // namespace

void check_motions(SceneContext& context, const TomlNode& root, const Scene& scene) {
  const double size = (scene.domain.upper - scene.domain.lower).norm();
  std::vector<Moving> moving;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const std::string path = fmt::format("solid.{}", i);
    if (!context.clean(path)) continue;
    for (Moving& m : motions_of(scene.solids[i], path)) {
      const std::string fault = fault_of_start(m, size);
      if (!fault.empty()) {
        context.report(m.path, line_of(root, m.path), m.subject + ": " + fault);
      } else if (!at_rest(*m.motion)) {
        moving.push_back(std::move(m));
      }
    }
  }
  if (context.clean("liquid")) {
    append_motions(scene.liquid.sources, "source", moving);
    append_motions(scene.liquid.drains, "drain", moving);
  }
  Sampling sampling{scene.time.end, size, most_samples};
  if (!moving.empty()) sampling.count = std::clamp(sample_budget / int(moving.size()), fewest_samples, most_samples);
  for (const Moving& m : moving) {
    const std::string fault = fault_of_motion(*m.motion, sampling);
    if (!fault.empty()) context.report(m.path, line_of(root, m.path), m.subject + ": " + fault);
  }
}

}  // namespace seiche
