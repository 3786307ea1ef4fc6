#pragma once
// Single values of a scene: reads them from TOML with all checks of their option, and writes them as TOML text.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/formula.h"
#include "base/options.h"
#include "base/vec.h"
#include "scene/context.h"

namespace seiche {

// Each reads place.node into `out`, or reports its fault and leaves `out` unchanged.
void read_value(SceneContext& context, const Place& place, const Option& option, double& out);
void read_value(SceneContext& context, const Place& place, const Option& option, int& out);
void read_value(SceneContext& context, const Place& place, const Option& option, bool& out);
void read_value(SceneContext& context, const Place& place, const Option& option, Vec3& out);
void read_value(SceneContext& context, const Place& place, const Option& option, VectorFormula& out);
// A text, a choice or a formula, by option.type.
void read_value(SceneContext& context, const Place& place, const Option& option, std::string& out);
void read_value(SceneContext& context, const Place& place, const Option& option, std::vector<std::string>& out);
void read_value(SceneContext& context, const Place& place, const Option& option, std::array<double, 2>& out);
void read_value(SceneContext& context, const Place& place, const Option& option, std::vector<Vec3>& out);
// An existing file, resolved against the scene's folder, and inside it unless the scene permits others.
void read_value(SceneContext& context, const Place& place, const Option& option, std::filesystem::path& out);

template <class T>
void read_value(SceneContext& context, const Place& place, const Option& option, std::optional<T>& out) {
  T value{};
  const std::size_t before = context.problem_count();
  read_value(context, place, option, value);
  if (context.problem_count() == before) out = value;
}

// Resolves a path of the scene against its folder. Returns why it cannot be read, or "".
std::string fault_of_path(const SceneContext& context, const std::filesystem::path& given, std::filesystem::path& out);

// TOML text; empty for an unset optional. Vectors have `dimension` components.
std::string to_toml(double value, const Option& option, int dimension);
std::string to_toml(int value, const Option& option, int dimension);
std::string to_toml(bool value, const Option& option, int dimension);
std::string to_toml(const Vec3& value, const Option& option, int dimension);
std::string to_toml(const VectorFormula& value, const Option& option, int dimension);
std::string to_toml(const std::string& value, const Option& option, int dimension);
std::string to_toml(const std::vector<std::string>& value, const Option& option, int dimension);
std::string to_toml(const std::array<double, 2>& value, const Option& option, int dimension);
std::string to_toml(const std::vector<Vec3>& value, const Option& option, int dimension);
std::string to_toml(const std::filesystem::path& value, const Option& option, int dimension);

template <class T>
std::string to_toml(const std::optional<T>& value, const Option& option, int dimension) {
  return value ? to_toml(*value, option, dimension) : std::string();
}

std::string quote_toml(const std::string& text);
bool is_text(const TomlNode& node);

// Reports a value that is not in option.choices and then returns false.
bool check_choice(SceneContext& context, const Place& place, const Option& option, const std::string& value);

}  // namespace seiche
