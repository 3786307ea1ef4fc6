#include "scene/writer.h"

#include <algorithm>
#include <map>

#include "base/scene.h"
#include "scene/options.h"

namespace seiche {
namespace {

SceneLines lines_of(const Scene& scene) {
  return write_section(scene_section(), scene, scene.dimension, "");
}

std::map<std::string, std::string> by_path(const SceneLines& lines) {
  std::map<std::string, std::string> texts;
  for (const SceneLine& line : lines) texts[line.path] = line.text;
  return texts;
}

// Appends the paths of lines that are missing in `other` or differ there. For a missing table, only the table's path.
void compare(const SceneLines& lines, const std::map<std::string, std::string>& other,
             std::vector<std::string>& changed) {
  std::string missing_table;
  for (const SceneLine& line : lines) {
    const bool below = !missing_table.empty() && line.path.compare(0, missing_table.size(), missing_table) == 0;
    if (below) continue;
    const auto found = other.find(line.path);
    if (found == other.end() && line.key.empty()) missing_table = line.path + '.';
    const bool differs = found == other.end() || found->second != line.text;
    const bool known = std::find(changed.begin(), changed.end(), line.path) != changed.end();
    if (differs && !known) changed.push_back(line.path);
  }
}

}  // namespace

std::string write_scene(const Scene& scene) {
  std::string text;
  for (const SceneLine& line : lines_of(scene)) {
    text += line.key.empty() ? "\n" + line.text + "\n" : line.key + " = " + line.text + "\n";
  }
  return text;
}

std::vector<std::string> changed_keys(const Scene& a, const Scene& b) {
  const SceneLines in_a = lines_of(a), in_b = lines_of(b);
  std::vector<std::string> changed;
  compare(in_a, by_path(in_b), changed);
  compare(in_b, by_path(in_a), changed);
  return changed;
}

}  // namespace seiche
