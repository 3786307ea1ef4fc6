#pragma once
// The liquid's volume as a field of its own beside the level set, State::liquid: carried through faces, conserved to
// rounding but for the divergence of a prescribed flow. Where Setup::tracks_volume() is false, a shift of the level set
// keeps the volume.
#include "coupling/state/fluids.h"
#include "coupling/state/simulation.h"
#include "coupling/state/state.h"
#include "fluid/volume/volume_transport.h"

namespace seiche {

// Sets State::liquid to the shares of the level set. Collective.
template <int Dim>
void start_volume(const Domain<Dim>& domain, const NodeField<Dim>& psi, State<Dim>& state);

// Carries State::liquid from the time it belongs to over `span` (s) along the flow u (m/s) that carries the level set.
// `solved`: of the same flow, on faces that are hardly open. `ledger`: room of cells at both times, and of faces that u
// fits. `brought`: what feeds bring into owned cells over the span, m^Dim. `before`: the state as it was. Books what
// passes the sides, and what the flow's divergence adds. Empty, or a text if paths leave the halo. Collective.
template <int Dim>
std::string carry_liquid(const Domain<Dim>& domain, const FaceField<Dim>& u, const GapFlow<Dim>& solved, double span,
                         const Ledger<Dim>& ledger, const CellValues& brought, const State<Dim>& before,
                         State<Dim>& state);

// Brings level set and volume together after both were carried. Collective.
template <int Dim>
void couple_liquid(const Domain<Dim>& domain, const NodeField<Dim>& psi, const Ledger<Dim>& ledger, State<Dim>& state);

// Empty, or a text if State::liquid changed from `before` to `next` by other than what passed the sides, to 1e-11 of
// it: a hundred times the rounding of a sum over 1e6 cells. Collective.
template <int Dim>
std::string fault_of_volume(const Domain<Dim>& domain, const State<Dim>& before, const State<Dim>& next);

// Volume of State::liquid and of drops, m^Dim. Collective.
template <int Dim>
double tracked_volume(const Domain<Dim>& domain, const State<Dim>& state);
// Sets the columns of volume from State::liquid; `stats` has those of the level set. Collective.
template <int Dim>
void measure_tracked(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, StepStats& stats);

}  // namespace seiche
