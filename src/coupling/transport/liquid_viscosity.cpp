#include "coupling/transport/liquid_viscosity.h"

#include <fmt/format.h>

#include "coupling/state/fluids.h"
#include "coupling/transport/formula_checks.h"
#include "fluid/boundary/domain.h"
#include "fluid/rheology/rheology.h"
#include "grid/loops.h"

namespace seiche {
namespace {

template <int Dim>
std::string bad_value_text(const Formula& formula, double value, const Vec<Dim>& x, double t) {
  if (!std::isfinite(value)) return not_finite_text<Dim>("liquid.viscosity", formula, value, x, t);
  return fmt::format("liquid.viscosity = \"{}\" is {:g} Pa s at {}, t = {:g} s; it must be >= 0 there", formula, value,
                     place_text<Dim>(x), t);
}

// visit(site, value) with the formula's value in each of this rank's cells. Returns a text on the first value that is
// not finite or is negative.
template <int Dim, class Visit>
std::string evaluate(const Domain<Dim>& domain, const Formula& formula, double t, const Visit& visit) {
  const Expression value_of(formula);
  std::string fault;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    const Vec<Dim> x = domain.layout.position(i, cell_offset<Dim>());
    const double value = value_of(extend<Dim>(x), t);
    if (fault.empty() && !(std::isfinite(value) && value >= 0)) fault = bad_value_text<Dim>(formula, value, x, t);
    visit(c, value);
  });
  return fault;
}

}  // namespace

template <int Dim>
std::string set_liquid_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const FaceField<Dim>& u,
                                 const FaceField<Dim, char>& valid, double t, CellField<Dim>& mu) {
  const LiquidSpec& liquid = fluids.liquid;
  if (!liquid.rheology.model.empty()) {
    set_viscosity(domain.layout, domain.halo, fluids.rheology, u, valid, mu);
    return {};
  }
  const std::string fault = evaluate(domain, liquid.viscosity, t, [&](Site c, double value) { mu[c] = value; });
  domain.halo.fill_ghosts(mu);
  extend_beyond_sides<Dim>(domain.layout, mu.data(), cell_offset<Dim>(), all_sides<Dim>(Extension::constant));
  return fault;
}

template <int Dim>
std::string fault_of_viscosity(const Domain<Dim>& domain, const Fluids& fluids, double t) {
  const LiquidSpec& liquid = fluids.liquid;
  const bool by_formula = liquid.rheology.model.empty() && !fluids.constant_viscosity();
  return by_formula ? evaluate(domain, liquid.viscosity, t, [](Site, double) {}) : std::string();
}

#define SEICHE_INSTANTIATE(D)                                                                        \
  template std::string set_liquid_viscosity<D>(const Domain<D>&, const Fluids&, const FaceField<D>&, \
                                               const FaceField<D, char>&, double, CellField<D>&);    \
  template std::string fault_of_viscosity<D>(const Domain<D>&, const Fluids&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
