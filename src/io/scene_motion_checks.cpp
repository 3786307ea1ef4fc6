// Prescribed motions looked at over the whole run, before it starts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "io/scene_checks.h"

namespace seiche {
namespace {

// The fewest samples see a leap that lasts; the most bound the time it takes to look.
constexpr int most_samples = 2000, fewest_samples = 50;
constexpr int sample_budget = 2'000'000;  // of all solids together

struct Sampling {
  double end = 0, reach = 0;  // s; the longest displacement between two samples, m
  int count = most_samples;
};

// What is wrong with the motion, or an empty text.
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

}  // namespace

void check_motions(SceneContext& context, const TomlNode& root, const Scene& scene) {
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const SolidSpec& solid = scene.solids[i];
    const bool readable = solid.kind == SolidKind::kinematic && context.clean(fmt::format("solid.{}", i));
    if (readable && !at_rest(solid.motion)) moving.push_back(i);
  }
  Sampling sampling{scene.time.end, (scene.domain.upper - scene.domain.lower).norm(), most_samples};
  if (!moving.empty()) sampling.count = std::clamp(sample_budget / int(moving.size()), fewest_samples, most_samples);
  for (const std::size_t i : moving) {
    const std::string fault = fault_of_motion(scene.solids[i].motion, sampling);
    if (fault.empty()) continue;
    const std::string path = fmt::format("solid.{}.motion", i);
    context.report(path, line_of(root, path), fmt::format("solid \"{}\": {}", scene.solids[i].name, fault));
  }
}

}  // namespace seiche
