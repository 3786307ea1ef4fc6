#pragma once
// The options registry: the values that a key of the scene file may hold. One row per key feeds the reader, its error
// messages, the normalised scene and the reference page.
#include <cstddef>
#include <string>
#include <vector>

namespace seiche {

enum class OptionType {
  number,
  integer,
  boolean,
  text,
  choice,          // one of `choices`
  choice_list,     // any of `choices`, each at most once
  pair,            // two names
  names,           // any number of names, at least one
  interval,        // two numbers
  vector,          // as many numbers as the scene has dimensions
  points,          // vectors, any number of them
  axis,            // three numbers in 2D and 3D
  quaternion,      // four numbers
  spin,            // angular velocity: three numbers; in 2D one, about z
  formula,         // a number or an expression
  formula_vector,  // as many formulas as the scene has dimensions
  file,            // a path, relative to the scene's folder
  table,
  table_list
};

enum class Presence { required, optional };
enum class Availability { present, later };  // later: documented, but not in this version

// Largest magnitude of any number in a scene, so that squares and volumes cannot overflow.
inline constexpr double number_limit = 1e15;

enum class Bound { included, excluded };

struct Range {
  double low = -number_limit, high = number_limit;
  Bound low_bound = Bound::included, high_bound = Bound::included;
};

Range any_number();
Range positive(double high = number_limit);  // 0 < value <= high
Range between(double low, double high);      // low <= value <= high
bool contains(const Range& range, double value);
std::string describe(const Range& range);  // "> 0 and <= 8"; empty if only number_limit bounds it

// The key is valid only if another key of the same table holds one of these values.
struct Condition {
  std::string key;
  std::vector<std::string> values;
};

// A documented value that this version does not have.
struct Refusal {
  std::string value, reason;
};

struct Option {
  std::string key;  // "radius"
  OptionType type = OptionType::number;
  std::string unit{};  // "m/s"; empty: none
  Range range{};       // of the number, or of each component
  std::vector<std::string> choices{};
  std::vector<Refusal> refused{};
  std::string variables{};  // of a formula: the variables that it may use, e.g. "xyzt"
  Condition only_for{};     // empty key: always
  Presence presence = Presence::optional;
  Availability availability = Availability::present;
  std::string fallback{};  // default as TOML text; empty: none
  std::string unset{};     // the behaviour if the key is not given and has no default value
  std::string doc{};       // one line
  std::size_t most = 0;    // largest number of entries of a table_list
  std::string path{};      // "solid[].rotate.degrees"; filled when options are listed
};

std::string type_name(OptionType type);                          // "a number"
std::string quoted_list(const std::vector<std::string>& names);  // "a", "b" or "c", in quotes

}  // namespace seiche
