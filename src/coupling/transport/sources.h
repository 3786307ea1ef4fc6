#pragma once
// Liquid sources: a shape that is kept full while its source is open, and the velocity its liquid comes with.
#include <optional>

#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The part of a step from t0 to t1 that a source is open for, s. `oldest` and `youngest` are the ages at t1 of what it
// brings in the step: liquid from before t0 is in the flow already, so a source open before has one age only.
struct OpenTime {
  double begin = 0, end = 0, youngest = 0, oldest = 0;
};
std::optional<OpenTime> open_in_step(const LiquidSourceSpec& source, double t0, double t1);

// Joins phi at t1 with what the sources bring from t0 to t1. Returns the volume added, solids as in the state.
// Collective.
template <int Dim>
double add_sources(const Domain<Dim>& domain, const Solids<Dim>& solids, const std::vector<Source<Dim>>& sources,
                   const State<Dim>& before, double t0, double t1, CellField<Dim>& phi);

// Gives the liquid that sources bring their velocity.
template <int Dim>
void set_source_velocity(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources, double t0, double t1,
                         FaceField<Dim>& u);

// Empty, or where a source's velocity is not finite at time t within its shape, on this rank.
template <int Dim>
std::string fault_of_source(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources, std::size_t index,
                            double t);

}  // namespace seiche
