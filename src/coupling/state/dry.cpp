#include "coupling/state/dry.h"

#include <algorithm>

namespace seiche {
template <int Dim>
bool is_dry(const Setup<Dim>& s) {
  if (s.may_have_fluid() || s.fluids.has_prescribed_flow() || s.tracks_volume()) return false;
  return std::none_of(s.solids.bodies.begin(), s.solids.bodies.end(), [](const Body<Dim>& b) { return b.deforms(); });
}

template bool is_dry<2>(const Setup<2>&);
template bool is_dry<3>(const Setup<3>&);

}  // namespace seiche
