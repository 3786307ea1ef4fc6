#include "coupling/step/look_ahead.h"

#include <algorithm>

namespace seiche {
namespace {

// True if liquid lies in a cell beside a face that the solid cuts or closes. Local.
template <int Dim>
bool is_wet(const Layout<Dim>& layout, const CellField<Dim>& phi, const FaceShares& shares) {
  return std::any_of(shares.begin(), shares.end(), [&](const FaceShare& share) {
    return phi[share.face] < 0 || phi[share.face - layout.stride(share.axis)] < 0;
  });
}

}  // namespace

template <int Dim>
bool can_look_ahead(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& start,
                    const StepGeometry<Dim>& geometry) {
  if (!solids.plans_steps() || start.exterior->flows()) return false;
  double wet = 0;
  for (std::size_t k = 0; k < start.solids.size(); ++k)
    if (start.solids[k].plans_steps() && is_wet(domain.layout, start.phi, *geometry.shares[k])) wet = 1;
  return domain.ranks.global_max(wet) == 0;
}

template <int Dim>
void set_off(const State<Dim>& found, State<Dim>& start) {
  start.horizon = found.horizon;
  for (std::size_t k = 0; k < found.solids.size(); ++k) start.solids[k].inform(found.solids[k]);
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template bool can_look_ahead<D>(const Domain<D>&, const Solids<D>&, const State<D>&, const StepGeometry<D>&); \
  template void set_off<D>(const State<D>&, State<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
