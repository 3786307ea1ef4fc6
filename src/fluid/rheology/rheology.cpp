#include "fluid/rheology/rheology.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/gravity.h"
#include "base/scene.h"
#include "fluid/rheology/rows.h"
#include "fluid/rheology/shear_rates.h"
#include "grid/ghosts.h"
#include "grid/loops.h"

namespace seiche {
namespace {

template <int Dim>
void fill_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec,
                    const ShearRates<Dim>& rates, CellField<Dim>& mu) {
  const RheologyModel& model = rheology_model(spec.model);
  for_each_index(layout, layout.cells(),
                 [&](Site c, const IVec<Dim>& i) { mu[c] = model.viscosity(spec, rates.of_cell(c, i)); });
  halo.fill_ghosts(mu);
  extend_beyond_sides<Dim>(layout, mu.data(), cell_offset<Dim>(), all_sides<Dim>(Extension::constant));
}

}  // namespace

bool RheologyModel::has(std::string_view key) const {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::span<const RheologyModel> rheology_models() {
  static const std::array rows{rheology::bingham(), rheology::herschel_bulkley(), rheology::carreau(),
                               rheology::power_law()};
  return rows;
}

const RheologyModel& rheology_model(std::string_view name) {
  std::string names;
  for (const RheologyModel& row : rheology_models()) {
    if (row.name == name) return row;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  throw Error(ExitCode::bad_input, "no rheology \"" + std::string(name) + "\"; there are " + names);
}

double viscosity(const RheologySpec& spec, double rate) {
  return rheology_model(spec.model).viscosity(spec, rate);
}

RheologySpec resolve_rheology(const Scene& scene) {
  constexpr double small = 1e-3;
  RheologySpec spec = scene.liquid.rheology;
  if (spec.model.empty() || spec.regularisation || !rheology_model(spec.model).has("regularisation")) return spec;
  const double length = (scene.domain.upper - scene.domain.lower).head(scene.dimension).maxCoeff();
  const double end = std::max(scene.time.end, 1 / scene.time.frame_rate);
  const double fall = std::sqrt(Gravity(scene.gravity).largest(0, end) / length);
  spec.regularisation = small * std::max(fall, 1 / end);
  return spec;
}

std::string describe_rheology(const RheologySpec& spec) {
  if (spec.model.empty()) return {};
  const double at_rest = viscosity(spec, 0);
  if (!spec.regularisation) return fmt::format("liquid: {}, {:.3g} Pa s at rest", spec.model, at_rest);
  return fmt::format("liquid: {}, regularised below a shear rate of {:.3g} 1/s to {:.3g} Pa s at rest", spec.model,
                     *spec.regularisation, at_rest);
}

template <int Dim>
void set_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec, const FaceField<Dim>& u,
                   const FaceField<Dim, char>& valid, CellField<Dim>& mu) {
  fill_viscosity(layout, halo, spec, ShearRates<Dim>(layout, u, &valid), mu);
}

template <int Dim>
void set_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec, const FaceField<Dim>& u,
                   CellField<Dim>& mu) {
  fill_viscosity(layout, halo, spec, ShearRates<Dim>(layout, u, nullptr), mu);
}

template <int Dim>
void set_edge_viscosity(const Layout<Dim>& layout, const RheologySpec& spec, const FaceField<Dim>& u,
                        const FaceField<Dim, char>& valid, EdgeField<Dim>& mu) {
  const RheologyModel& model = rheology_model(spec.model);
  const ShearRates<Dim> rates(layout, u, &valid);
  for (int plane = 0; plane < EdgeField<Dim>::count; ++plane)
    for_each_index(layout, layout.grown(1), [&](Site e, const IVec<Dim>& i) {
      mu[plane][std::size_t(e)] = model.viscosity(spec, rates.of_edge(plane, e, i));
    });
}

#define SEICHE_INSTANTIATE(D)                                                                                \
  template void set_viscosity<D>(const Layout<D>&, const Halo<D>&, const RheologySpec&, const FaceField<D>&, \
                                 const FaceField<D, char>&, CellField<D>&);                                  \
  template void set_viscosity<D>(const Layout<D>&, const Halo<D>&, const RheologySpec&, const FaceField<D>&, \
                                 CellField<D>&);                                                             \
  template void set_edge_viscosity<D>(const Layout<D>&, const RheologySpec&, const FaceField<D>&,            \
                                      const FaceField<D, char>&, EdgeField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
