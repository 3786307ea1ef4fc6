#include "coupling/state/dry.h"

#include <algorithm>

namespace seiche {
namespace {

// True if liquid or gas is there at the start, or sides and sources may bring it.
template <int Dim>
bool may_have_fluid(const Setup<Dim>& s) {
  const LiquidSpec& liquid = s.fluids.liquid;
  return !liquid.regions.empty() || !s.sources.empty() || !s.feeds.empty() || s.domain.sides.any_passes() ||
         s.fluids.gas.present;
}

}  // namespace

template <int Dim>
bool is_dry(const Setup<Dim>& s) {
  if (may_have_fluid(s) || s.fluids.has_prescribed_flow() || s.tracks_volume()) return false;
  return std::none_of(s.solids.bodies.begin(), s.solids.bodies.end(), [](const Body<Dim>& b) { return b.deforms(); });
}

template bool is_dry<2>(const Setup<2>&);
template bool is_dry<3>(const Setup<3>&);

}  // namespace seiche
