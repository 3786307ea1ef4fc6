#pragma once
// Units in numbers of a scene: "2 cm", "0.5 g/cm^3", "30 deg".
#include <array>
#include <optional>
#include <string>

namespace seiche {

// A unit as a factor times m^a kg^b s^c rad^d.
struct Unit {
  double factor = 1;
  std::array<int, 4> powers{};
};

// Products of the known units with integer powers, "kg/m^3" or "N m/rad": a stroke divides by the next factor alone.
// None if a name is unknown.
std::optional<Unit> parse_unit(const std::string& text);

// Factor from a unit to that of a key, whose text may list several ("N m/rad or N/m"). None: none of these fits.
std::optional<double> factor_between(const Unit& from, const std::string& wanted);

// A text split into a number, or expression, and the longest unit behind it, after a space or a digit. None: no unit.
struct WithUnit {
  std::string number, name;
  Unit unit;
};
std::optional<WithUnit> split_unit(const std::string& text);

}  // namespace seiche
