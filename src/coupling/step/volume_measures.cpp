#include "coupling/step/volume_measures.h"

#include "coupling/step/side_flow.h"
#include "coupling/transport/feeds.h"
#include "coupling/transport/placed_sources.h"
#include "coupling/transport/tracked_volume.h"

namespace seiche {
namespace {

// Volume that sides and feeds brought since the time of the volumes, m^Dim. Collective.
template <int Dim>
double brought_since_volumes(const Setup<Dim>& s, const StepGeometry<Dim>& geometry, const State<Dim>& state) {
  const double span = state.volume_lag;
  if (!s.volume_lags() || span == 0) return 0;
  const double brought = span * net_inflow(s.domain, geometry, state.phi, state.now->u);
  if (s.feeds.empty()) return brought;
  const PlacedSources<Dim> placed(s, state, state.time - span);
  return brought + sum_of_cells(s.domain, brought_by_feeds(s.domain, placed.feeds(), FedLiquid<Dim>(state),
                                                           state.time - span, state.time));
}

}  // namespace

template <int Dim>
void measure_volumes(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, const State<Dim>& state,
                     StepStats& stats) {
  measure_tracked(setup.domain, setup.fluids, state, stats);
  stats.volume_since_solve = brought_since_volumes(setup, geometry, state);
  stats.liquid_volume += stats.volume_since_solve;
}

template <int Dim>
std::string describe_volume(const Setup<Dim>& setup) {
  if (setup.tracks_volume()) return "volume  carried by cells (liquid.volume)";
  const std::string why = setup.shift_because.empty() ? "" : ", since " + setup.shift_because;
  return "volume  kept by a shift of the liquid's surface" + why + " (liquid.volume)";
}

template std::string describe_volume<2>(const Setup<2>&);
template std::string describe_volume<3>(const Setup<3>&);
template void measure_volumes<2>(const Setup<2>&, const StepGeometry<2>&, const State<2>&, StepStats&);
template void measure_volumes<3>(const Setup<3>&, const StepGeometry<3>&, const State<3>&, StepStats&);

}  // namespace seiche
