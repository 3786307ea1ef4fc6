#pragma once
// State of reading a scene: location, options and the problems found.
#include <filesystem>
#include <string>
#include <vector>

#include "scene/parameters.h"
#include "scene/toml.h"

namespace seiche {

enum class FileAccess { scene_folder, anywhere };

// A value of the scene: its node and its path ("solid.0.radius").
struct Place {
  const TomlNode* node = nullptr;
  std::string path;
};

class SceneContext {
 public:
  SceneContext(std::string name, std::filesystem::path folder) : name_(std::move(name)), folder_(std::move(folder)) {}

  int dimension = 0;  // 0 until known; vectors may then have 2 or 3 components
  FileAccess access = FileAccess::scene_folder;
  Parameters parameters;              // of the table [parameters]
  std::vector<std::string> included;  // files; lines of number n, from 1, are behind n times lines_a_file
  static constexpr int lines_a_file = 20'000'000;
  std::vector<std::string> override_paths;  // line -n - 1 refers to override number n

  const std::string& name() const { return name_; }
  const std::filesystem::path& folder() const { return folder_; }
  std::string where(int line) const;  // "scene.toml:14" or "--set time.end"

  void report(const Place& place, const std::string& text) { report(place.path, place.node->line, text); }
  void report(const std::string& path, int line, const std::string& text);
  std::size_t problem_count() const { return count_; }
  // True if nothing was reported for this path or below it.
  bool clean(const std::string& path) const;
  // Throws Error(bad_input) with a line for each problem, in the order of the file. Returns if there are none.
  void throw_problems() const;

 private:
  struct Problem {
    std::string path, text;
    int line = 0;
  };
  std::string name_;
  std::filesystem::path folder_;
  std::vector<Problem> problems_;  // the first thousand
  std::size_t count_ = 0;
};

std::string join_path(const std::string& path, const std::string& key);
// A path's table as written in the file: "liquid.region.0" is [[liquid.region]], "" is the top level.
std::string section_title(const std::string& path);
// Line of a path, or of the nearest enclosing table in the file.
int line_of(const TomlNode& root, const std::string& path);

}  // namespace seiche
