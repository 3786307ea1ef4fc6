#include "fluid/rheology.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/gravity.h"
#include "fluid/rheology_rows.h"
#include "grid/ghosts.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// The faces that (d_a u_b + d_b u_a) of an edge is made of: u_a on both sides along b, u_b on both sides along a.
struct Edge {
  int a, b;
  Site site;  // of the cell above it along both axes
};

template <int Dim>
bool lies_in_side(const Layout<Dim>& layout, const Edge& e, const IVec<Dim>& index) {
  const Geometry<Dim>& g = layout.geometry();
  for (const int axis : {e.a, e.b})
    if (!g.periodic[axis] && (index[axis] <= 0 || index[axis] >= g.cells[axis])) return true;
  return false;
}

template <int Dim>
bool is_valid(const Layout<Dim>& layout, const FaceField<Dim, char>& valid, const Edge& e) {
  return valid.at(e.a, e.site) && valid.at(e.a, e.site - layout.stride(e.b)) && valid.at(e.b, e.site) &&
         valid.at(e.b, e.site - layout.stride(e.a));
}

// d_a u_b + d_b u_a at an edge, 1/s.
template <int Dim>
double edge_shear(const Layout<Dim>& layout, const FaceField<Dim>& u, const Edge& e) {
  const double along_b = u.at(e.a, e.site) - u.at(e.a, e.site - layout.stride(e.b));
  const double along_a = u.at(e.b, e.site) - u.at(e.b, e.site - layout.stride(e.a));
  return (along_b + along_a) / layout.h();
}

// Mean of the squared shear over the edges of a cell in the plane (a, b) that `takes` accepts; 0 where it takes none.
template <int Dim, class Takes>
double mean_squared_shear(const Layout<Dim>& layout, const FaceField<Dim>& u, int a, int b, Site c,
                          const IVec<Dim>& index, const Takes& takes) {
  double sum = 0;
  int count = 0;
  for (int corner = 0; corner < 4; ++corner) {
    Edge e{a, b, c};
    IVec<Dim> i = index;
    if (corner & 1) e.site += layout.stride(a), ++i[a];
    if (corner & 2) e.site += layout.stride(b), ++i[b];
    if (lies_in_side(layout, e, i) || !takes(e)) continue;
    const double shear = edge_shear(layout, u, e);
    sum += shear * shear;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

template <int Dim, class Takes>
double shear_rate(const Layout<Dim>& layout, const FaceField<Dim>& u, Site c, const IVec<Dim>& i, const Takes& takes) {
  double squared = 0;
  for (int a = 0; a < Dim; ++a) {
    const double stretch = (u.at(a, c + layout.stride(a)) - u.at(a, c)) / layout.h();
    squared += 2 * stretch * stretch;
    for (int b = a + 1; b < Dim; ++b) squared += mean_squared_shear(layout, u, a, b, c, i, takes);
  }
  return std::sqrt(squared);
}

template <int Dim, class Takes>
void fill_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec, const FaceField<Dim>& u,
                    const Takes& takes, CellField<Dim>& mu) {
  const RheologyModel& model = rheology_model(spec.model);
  for_each_index(layout, layout.cells(), [&](Site c, const IVec<Dim>& i) {
    mu[c] = model.viscosity(spec, shear_rate(layout, u, c, i, takes));
  });
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
  fill_viscosity(
      layout, halo, spec, u, [&](const Edge& e) { return is_valid(layout, valid, e); }, mu);
}

template <int Dim>
void set_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec, const FaceField<Dim>& u,
                   CellField<Dim>& mu) {
  fill_viscosity(
      layout, halo, spec, u, [](const Edge&) { return true; }, mu);
}

#define SEICHE_INSTANTIATE(D)                                                                                \
  template void set_viscosity<D>(const Layout<D>&, const Halo<D>&, const RheologySpec&, const FaceField<D>&, \
                                 const FaceField<D, char>&, CellField<D>&);                                  \
  template void set_viscosity<D>(const Layout<D>&, const Halo<D>&, const RheologySpec&, const FaceField<D>&, \
                                 CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
