#include "scene/units.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

namespace seiche {
namespace {

constexpr double turn = 2 * std::numbers::pi;

struct KnownUnit {
  std::string_view name;
  Unit unit;
};

// Names of SI, some of everyday: factor, powers of m, kg, s and rad.
// clang-format off
constexpr KnownUnit known_units[] = {
    {"m", {1, {1, 0, 0, 0}}}, {"km", {1e3, {1, 0, 0, 0}}}, {"cm", {1e-2, {1, 0, 0, 0}}}, {"mm", {1e-3, {1, 0, 0, 0}}},
    {"um", {1e-6, {1, 0, 0, 0}}}, {"in", {0.0254, {1, 0, 0, 0}}}, {"ft", {0.3048, {1, 0, 0, 0}}},
    {"l", {1e-3, {3, 0, 0, 0}}}, {"ml", {1e-6, {3, 0, 0, 0}}}, {"kg", {1, {0, 1, 0, 0}}}, {"g", {1e-3, {0, 1, 0, 0}}},
    {"mg", {1e-6, {0, 1, 0, 0}}}, {"t", {1e3, {0, 1, 0, 0}}}, {"lb", {0.45359237, {0, 1, 0, 0}}},
    {"s", {1, {0, 0, 1, 0}}}, {"ms", {1e-3, {0, 0, 1, 0}}}, {"min", {60, {0, 0, 1, 0}}}, {"h", {3600, {0, 0, 1, 0}}},
    {"Hz", {1, {0, 0, -1, 0}}}, {"N", {1, {1, 1, -2, 0}}}, {"mN", {1e-3, {1, 1, -2, 0}}},
    {"kN", {1e3, {1, 1, -2, 0}}}, {"Pa", {1, {-1, 1, -2, 0}}}, {"kPa", {1e3, {-1, 1, -2, 0}}},
    {"MPa", {1e6, {-1, 1, -2, 0}}}, {"GPa", {1e9, {-1, 1, -2, 0}}}, {"bar", {1e5, {-1, 1, -2, 0}}},
    {"mbar", {1e2, {-1, 1, -2, 0}}}, {"mPa", {1e-3, {-1, 1, -2, 0}}}, {"J", {1, {2, 1, -2, 0}}},
    {"W", {1, {2, 1, -3, 0}}}, {"kW", {1e3, {2, 1, -3, 0}}}, {"rad", {1, {0, 0, 0, 1}}},
    {"deg", {turn / 360, {0, 0, 0, 1}}}, {"degree", {turn / 360, {0, 0, 0, 1}}},
    {"degrees", {turn / 360, {0, 0, 0, 1}}}, {"rev", {turn, {0, 0, 0, 1}}}, {"rpm", {turn / 60, {0, 0, -1, 1}}},
    {"1", {1, {0, 0, 0, 0}}},
};
// clang-format on

// Reads names with powers one by one.
class UnitReader {
 public:
  explicit UnitReader(const std::string& text) : text_(text) {}

  std::optional<Unit> read() {
    Unit product;
    for (int sign = 1;; sign = next_sign()) {
      if (!take_factor(sign, product)) return std::nullopt;
      skip_spaces();
      if (at_ == text_.size()) return product;
    }
  }

 private:
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  // -1 behind a stroke.
  int next_sign() {
    if (text_[at_] == '*') return ++at_, 1;
    if (text_[at_] == '/') return ++at_, -1;
    return 1;
  }

  bool take_factor(int sign, Unit& product) {
    skip_spaces();
    std::string name;
    while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) name += text_[at_++];
    if (name.empty() && at_ < text_.size() && text_[at_] == '1') name = text_[at_++];
    const auto* found = std::ranges::find(known_units, name, &KnownUnit::name);
    if (found == std::end(known_units)) return false;
    int power = 1;
    if (at_ < text_.size() && text_[at_] == '^') {
      const char* from = text_.data() + at_ + 1;
      const auto [stopped, error] = std::from_chars(from, text_.data() + text_.size(), power);
      constexpr int most = 9;
      if (error != std::errc() || std::abs(power) > most) return false;
      at_ = std::size_t(stopped - text_.data());
    }
    power *= sign;
    product.factor *= std::pow(found->unit.factor, power);
    for (std::size_t k = 0; k < product.powers.size(); ++k) product.powers[k] += power * found->unit.powers[k];
    return true;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<Unit> parse_unit(const std::string& text) {
  return UnitReader(text).read();
}

std::optional<double> factor_between(const Unit& from, const std::string& wanted) {
  const std::string between = " or ";
  for (std::size_t at = 0; at <= wanted.size();) {
    const std::size_t end = std::min(wanted.find(between, at), wanted.size());
    const auto unit = parse_unit(wanted.substr(at, end - at));
    if (unit && unit->powers == from.powers) return from.factor / unit->factor;
    at = end + between.size();
  }
  return std::nullopt;
}

std::optional<WithUnit> split_unit(const std::string& text) {
  for (std::size_t at = 1; at < text.size(); ++at) {
    const char before = text[at - 1];
    const bool may_start = before == ' ' || before == ')' || std::isdigit(static_cast<unsigned char>(before));
    if (!may_start || !std::isalpha(static_cast<unsigned char>(text[at]))) continue;
    const std::string name = text.substr(at);
    if (const auto unit = parse_unit(name)) return WithUnit{text.substr(0, at), name, *unit};
  }
  return std::nullopt;
}

}  // namespace seiche
