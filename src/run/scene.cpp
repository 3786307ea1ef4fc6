#include "run/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/scene.h"
#include "scene/reader.h"

namespace seiche {
namespace {

// FNV-1a, 64 bits.
std::uint64_t fingerprint(const std::string& text) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const char c : text) h = (h ^ std::uint8_t(c)) * 0x100000001b3u;
  return h;
}

// Keys that only affect how a step is solved. They may differ from step to step.
bool is_numerical(const std::string& key) {
  static constexpr std::array<const char*, 4> steps{"time.cfl", "time.max_step", "time.fixed_step", "liquid.volume"};
  return key.starts_with("solver.") || std::find(steps.begin(), steps.end(), key) != steps.end();
}

bool always_free(const std::string& key) {
  return key == "time.end" || key == "output.checkpoint_every" || is_numerical(key);
}

bool may_be_forced(const std::string& key) {
  static constexpr std::array<const char*, 2> tables{"output", "probe"};
  return key == "title" || std::any_of(tables.begin(), tables.end(), [&](const char* t) { return key.starts_with(t); });
}

}  // namespace

std::string scene_hash(const Scene& scene) {
  Scene kept = scene;
  kept.time.end = 0;
  kept.output.checkpoint_every = 1;
  return fmt::format("{:016x}", fingerprint(write_scene(kept)));
}

std::vector<std::string> forbidden_changes(const std::vector<std::string>& changed, EditPolicy policy) {
  std::vector<std::string> forbidden;
  for (const std::string& key : changed) {
    const bool allowed = always_free(key) || (policy == EditPolicy::force && may_be_forced(key));
    if (!allowed) forbidden.push_back(key);
  }
  return forbidden;
}

}  // namespace seiche
