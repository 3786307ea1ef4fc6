#include "coupling/transport/dry_sources.h"

#include <fmt/format.h>

#include "coupling/transport/feeds.h"
#include "coupling/transport/placed_sources.h"

namespace seiche {

template <int Dim>
void DrySources<Dim>::warn(const Setup<Dim>& s, const State<Dim>& state, const NodeField<Dim>& psi,
                           std::vector<std::string>& warnings) {
  if (s.feeds.empty()) return;
  const double from = state.time - state.dt_now;
  const PlacedSources<Dim> placed(s, state, state.time);
  const std::vector<char> dry =
      dry_sources(s.domain, placed.feeds(), FedLiquid<Dim>(s.domain.layout, state, psi), from, state.time);
  told_.resize(dry.size());
  for (std::size_t n = 0; n < dry.size(); ++n)
    if (dry[n] && !told_[n])
      warnings.push_back(
          fmt::format("step {}: {} brings nothing from t = {:.6g} s on: its shape holds no liquid, "
                      "which alone can swell by a rate; place it below the surface, or leave rate out "
                      "so that it fills its shape",
                      state.step, s.feeds[n].name, from));
  told_ = dry;
}

template class DrySources<2>;
template class DrySources<3>;

}  // namespace seiche
