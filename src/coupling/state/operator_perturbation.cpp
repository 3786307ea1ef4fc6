#include "coupling/state/operator_perturbation.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "base/error.h"

namespace seiche {
namespace {

const std::map<std::string, double OperatorPerturbation::*>& operators() {
  static const std::map<std::string, double OperatorPerturbation::*> table{
      {"pressure_gradient", &OperatorPerturbation::pressure_gradient},
      {"divergence", &OperatorPerturbation::divergence},
      {"gravity", &OperatorPerturbation::gravity},
      {"gas_density", &OperatorPerturbation::gas_density},
      {"surface_tension", &OperatorPerturbation::surface_tension},
      {"solid_flux", &OperatorPerturbation::solid_flux},
      {"rigid_mass", &OperatorPerturbation::rigid_mass},
      {"viscosity", &OperatorPerturbation::viscosity},
      {"yield_stress", &OperatorPerturbation::yield_stress},
      {"velocity_advection", &OperatorPerturbation::velocity_advection},
      {"surface_advection", &OperatorPerturbation::surface_advection},
      {"contact", &OperatorPerturbation::contact},
      {"friction", &OperatorPerturbation::friction},
      {"elastic_forces", &OperatorPerturbation::elastic_forces},
  };
  return table;
}

}  // namespace

OperatorPerturbation parse_perturbation(const std::string& text) {
  OperatorPerturbation perturbation;
  if (text.empty()) return perturbation;
  const std::size_t colon = text.find(':');
  const auto one = operators().find(text.substr(0, colon));
  const std::string number = colon == std::string::npos ? "" : text.substr(colon + 1);
  char* end = nullptr;
  const double factor = std::strtod(number.c_str(), &end);
  if (one != operators().end() && !number.empty() && *end == '\0' && std::isfinite(factor)) {
    perturbation.*(one->second) = factor;
    return perturbation;
  }
  std::string names;
  for (const auto& [name, member] : operators()) names += (names.empty() ? "" : ", ") + name;
  throw Error(ExitCode::bad_input,
              fmt::format("--break {}: expected operator:factor, operator one of {}", text, names));
}

}  // namespace seiche
