// Keys of [liquid] and [solver] for viscous liquid.
#include <fmt/format.h>

#include "base/fluid_spec.h"
#include "base/solver_spec.h"
#include "fluid/rheology/rheology.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

std::vector<std::string> viscosity_models() {
  std::vector<std::string> names;
  for (const RheologyModel& model : rheology_models()) names.emplace_back(model.name);
  return names;
}

// Binds a key to the models that have it in the table; all keys but the regularisation are required.
template <class Member>
Key<RheologySpec> parameter(Option option, Member member) {
  option.only_for.key = "model";
  if (option.unset.empty()) option.presence = Presence::required;
  for (const RheologyModel& model : rheology_models())
    if (model.has(option.key)) option.only_for.values.emplace_back(model.name);
  return value_key<RheologySpec>(option, member);
}

// Keys of models with a yield stress and a power law of the shear rate.
std::vector<Key<RheologySpec>> keys_of_stress() {
  using S = RheologySpec;
  return {
      parameter({.key = "viscosity",
                 .unit = "Pa s",
                 .range = positive(),
                 .doc = "plastic viscosity mu: stress = yield_stress + mu r"},
                &S::viscosity),
      parameter({.key = "consistency",
                 .unit = "Pa s^exponent",
                 .range = positive(),
                 .doc = "K: stress = yield_stress + K r^exponent"},
                &S::consistency),
      parameter({.key = "exponent",
                 .range = positive(10),
                 .doc = "below 1 the liquid thins where it is sheared, above 1 it thickens"},
                &S::exponent),
      parameter({.key = "yield_stress",
                 .unit = "Pa",
                 .range = between(0, number_limit),
                 .doc = "shear stress below which the liquid does not flow"},
                &S::yield_stress),
      parameter({.key = "regularisation",
                 .unit = "1/s",
                 .range = positive(),
                 .unset = "0.001 sqrt(g / largest extent), or 0.001 / end where that is larger",
                 .doc = "shear rate m below which stiffness is bounded: yield_stress (1 - exp(-r / m)) for the yield "
                        "stress, sqrt(r^2 + m^2) for r in powers; liquid that should not flow creeps at rates of m"},
                &S::regularisation),
  };
}

std::vector<Key<RheologySpec>> keys_of_viscosity() {
  using S = RheologySpec;
  return {
      parameter({.key = "viscosity_zero", .unit = "Pa s", .range = positive(), .doc = "viscosity at rest"},
                &S::viscosity_zero),
      parameter({.key = "viscosity_infinity",
                 .unit = "Pa s",
                 .range = between(0, number_limit),
                 .doc = "viscosity that fast shear approaches"},
                &S::viscosity_infinity),
      parameter({.key = "time",
                 .unit = "s",
                 .range = positive(),
                 .doc = "time of relaxation: viscosity changes at shear rates of 1 / time"},
                &S::time),
  };
}

Section<RheologySpec> rheology_section() {
  Section<RheologySpec> s;
  s.keys = {value_key<RheologySpec>({.key = "model",
                                     .type = T::choice,
                                     .choices = viscosity_models(),
                                     .presence = Presence::required,
                                     .doc = "how viscosity depends on the shear rate r = sqrt(2 D:D)"},
                                    &RheologySpec::model)};
  for (Key<RheologySpec>& key : keys_of_viscosity()) s.keys.push_back(std::move(key));
  for (Key<RheologySpec>& key : keys_of_stress()) s.keys.push_back(std::move(key));
  return s;
}

}  // namespace

Key<LiquidSpec> viscosity_key() {
  Key<LiquidSpec> key = value_key<LiquidSpec>({.key = "viscosity",
                                               .type = T::formula,
                                               .unit = "Pa s",
                                               .range = between(0, number_limit),
                                               .variables = "xyzt",
                                               .doc = "0: inviscid; a formula must be >= 0 in the whole domain"},
                                              &LiquidSpec::viscosity);
  const auto write = key.write;
  key.write = [write](const LiquidSpec& s, int dimension, const std::string& path, SceneLines& lines) {
    if (s.rheology.model.empty()) write(s, dimension, path, lines);
  };
  return key;
}

Key<LiquidSpec> rheology_key() {
  Key<LiquidSpec> key = inline_key<LiquidSpec>({.key = "rheology",
                                                .unset = "the same viscosity at any shear rate",
                                                .doc = "model and its numbers; replaces viscosity"},
                                               &LiquidSpec::rheology, rheology_section());
  const auto write = key.write;
  key.write = [write](const LiquidSpec& s, int dimension, const std::string& path, SceneLines& lines) {
    if (!s.rheology.model.empty()) write(s, dimension, path, lines);
  };
  return key;
}

void check_one_viscosity(SceneContext& c, const Place& p) {
  const TomlEntry *viscosity = p.node->find("viscosity"), *rheology = p.node->find("rheology");
  if (!viscosity || !rheology) return;
  c.report(
      join_path(p.path, "viscosity"), viscosity->line,
      fmt::format("{0}.viscosity and {0}.rheology exclude each other: the model's viscosity replaces the other, so "
                  "leave out one of them",
                  p.path));
}

std::vector<Key<SolverSpec>> viscous_solver_keys() {
  using S = SolverSpec;
  return {
      choice_key<S, ViscousSolve S::*, ViscousSolve>(
          {.key = "viscosity",
           .doc = "how viscosity is solved for: \"coupled\" in one system with the pressure, \"split\" before it, "
                  "\"auto\" by viscosity times step over density and cell size squared, \"coupled\" beside elastic "
                  "solids and no-slip ones that the liquid moves"},
          &S::viscosity,
          {{"auto", ViscousSolve::automatic}, {"split", ViscousSolve::split}, {"coupled", ViscousSolve::coupled}}),
      value_key<S>({.key = "rheology_tolerance",
                    .range = positive(0.1),
                    .doc = "a step of a liquid with rheology solves again, with the viscosities of the last solution, "
                           "until velocity changes less than this, relative to the largest"},
                   &S::rheology_tolerance),
      value_key<S>({.key = "rheology_iterations",
                    .type = T::integer,
                    .range = between(1, 1000),
                    .doc = "solves of a step of a liquid with rheology, at most"},
                   &S::rheology_iterations),
  };
}

}  // namespace seiche
