#include "validate/measure/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "validate/measure/kinds.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

using T = OptionType;

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const MeasureKind& kind : measure_kinds()) names.emplace_back(kind.name);
  return names;
}

// Binds a key to the kinds that use it.
template <class Member>
Key<MeasureSpec> parameter(Option option, Member member) {
  option.only_for.key = "kind";
  option.presence = Presence::required;
  for (const MeasureKind& kind : measure_kinds()) {
    if (uses(kind, option.key)) option.only_for.values.emplace_back(kind.name);
  }
  return value_key<MeasureSpec>(option, member);
}

}  // namespace

const std::vector<MeasureKind>& measure_kinds() {
  static const std::vector<MeasureKind> table = [] {
    std::vector<MeasureKind> rows;
    const auto add = [&](MeasureSource source, const std::vector<MeasureKind>& some) {
      for (const MeasureKind& kind : some) {
        rows.push_back(kind);
        rows.back().source = source;
      }
    };
    add(MeasureSource::frames, measures_of_frames());
    add(MeasureSource::probes, measures_of_probes());
    add(MeasureSource::stats, measures_of_columns());
    add(MeasureSource::solids, measures_of_solids());
    return rows;
  }();
  return table;
}

const MeasureKind& kind_of(const MeasureSpec& spec) {
  const auto& kinds = measure_kinds();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const MeasureKind& row) { return row.name == spec.kind; });
  if (kind == kinds.end()) throw Error(ExitCode::bug, fmt::format("no measure is named '{}'", spec.kind));
  return *kind;
}

bool uses(const MeasureKind& kind, const std::string& key) {
  return std::any_of(kind.keys.begin(), kind.keys.end(), [&](const char* one) { return key == one; });
}

Points measured_series(const MeasureSpec& spec, const RunPaths& run) {
  const MeasureKind& kind = kind_of(spec);
  return kind.series ? kind.series(spec, run) : Points();
}

Section<MeasureSpec> measure_section() {
  using S = MeasureSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "kind", .type = T::choice, .choices = kind_names(), .presence = Presence::required},
                   &S::kind),
      parameter({.key = "velocity", .type = T::formula_vector, .unit = "m/s", .variables = "xyzt"}, &S::velocity),
      parameter({.key = "region", .type = T::formula, .variables = "xyzt"}, &S::region),
      parameter({.key = "surface", .type = T::formula, .unit = "m", .variables = "xyzt"}, &S::surface),
      parameter({.key = "probe", .type = T::text}, &S::probe),
      parameter({.key = "minus", .type = T::text}, &S::minus),
      parameter({.key = "column", .type = T::text}, &S::column),
      parameter({.key = "solid", .type = T::text}, &S::solid),
      parameter({.key = "level", .type = T::formula}, &S::level),
      parameter({.key = "reference", .type = T::formula}, &S::reference),
      parameter({.key = "time_unit", .type = T::formula, .unit = "s", .range = positive()}, &S::time_unit),
      parameter({.key = "length_unit", .type = T::formula, .unit = "m", .range = positive()}, &S::length_unit),
      parameter({.key = "unit", .type = T::formula}, &S::unit),
      parameter({.key = "from"}, &S::from),
      parameter({.key = "to"}, &S::to),
      parameter({.key = "data", .type = T::file}, &S::data),
  };
  return s;
}

double constant(const Formula& formula) {
  return Expression(formula)(Vec3(0, 0, 0), 0);
}

Measurement measure(const MeasureSpec& spec, const RunPaths& run) {
  try {
    const Measurement result = kind_of(spec).measure(spec, run);
    const bool finite = std::isfinite(result.value) && std::isfinite(result.reference.value_or(0));
    if (finite && std::isfinite(result.error) && result.error >= 0) return result;
  } catch (const Error& error) {  // missing or unreadable output: the run is not measured
    throw Error(ExitCode::cannot_continue, error.what());
  } catch (const fs::filesystem_error& error) {
    throw Error(ExitCode::cannot_continue, error.what());
  }
  throw Error(ExitCode::cannot_continue, fmt::format("{} is not a number, or an error below zero", spec.kind));
}

}  // namespace seiche
