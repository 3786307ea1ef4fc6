#include "coupling/state/tampering.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "base/error.h"

namespace seiche {
namespace {

const std::map<std::string, double Tampering::*>& operators() {
  static const std::map<std::string, double Tampering::*> table{
      {"pressure_gradient", &Tampering::pressure_gradient},
      {"divergence", &Tampering::divergence},
      {"gravity", &Tampering::gravity},
      {"gas_density", &Tampering::gas_density},
      {"surface_tension", &Tampering::surface_tension},
      {"solid_flux", &Tampering::solid_flux},
      {"rigid_mass", &Tampering::rigid_mass},
      {"viscosity", &Tampering::viscosity},
      {"yield_stress", &Tampering::yield_stress},
      {"velocity_advection", &Tampering::velocity_advection},
      {"surface_advection", &Tampering::surface_advection},
      {"contact", &Tampering::contact},
      {"friction", &Tampering::friction},
      {"elastic_forces", &Tampering::elastic_forces},
  };
  return table;
}

}  // namespace

Tampering parse_tampering(const std::string& text) {
  Tampering tampering;
  if (text.empty()) return tampering;
  const std::size_t colon = text.find(':');
  const auto one = operators().find(text.substr(0, colon));
  const std::string number = colon == std::string::npos ? "" : text.substr(colon + 1);
  char* end = nullptr;
  const double factor = std::strtod(number.c_str(), &end);
  if (one != operators().end() && !number.empty() && *end == '\0' && std::isfinite(factor)) {
    tampering.*(one->second) = factor;
    return tampering;
  }
  std::string names;
  for (const auto& [name, member] : operators()) names += (names.empty() ? "" : ", ") + name;
  throw Error(ExitCode::bad_input,
              fmt::format("--break {}: expected operator:factor, operator one of {}", text, names));
}

}  // namespace seiche
