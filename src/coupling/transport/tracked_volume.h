#pragma once
// The liquid's volume as a field of its own beside the level set, State::liquid: carried through faces, conserved to
// rounding but for the divergence of a prescribed flow. Where Setup::tracks_volume() is false, a shift of the level set
// keeps the volume.
#include <optional>

#include "coupling/state/fluids.h"
#include "coupling/state/simulation.h"
#include "coupling/state/state.h"
#include "fluid/volume/volume_transport.h"

namespace seiche {

// Sets State::liquid to the shares of the level set. Collective.
template <int Dim>
void start_volume(const Domain<Dim>& domain, const NodeField<Dim>& psi, State<Dim>& state);

// u (m/s), with what the solve gave the faces that are hardly open. Empty where there are no solids. Collective.
template <int Dim>
std::optional<FaceField<Dim>> flow_through_faces(const Domain<Dim>& domain, const Room<Dim>& room,
                                                 const GapFlow<Dim>& solved, const FaceField<Dim>& u);

// Share of a trial in the flow that carries volumes in the first `span` s. The rest is the initial flow, as in all
// later steps, where the surface moves with the velocity at their start. Their difference is an impulse where the
// initial velocity does not fit. `initial`, `trial`: through faces, m/s. `share`: of the liquid. `ledger` and `brought`
// as for carry_liquid(). Collective.
template <int Dim>
double share_of_trial(const Domain<Dim>& domain, const Ledger<Dim>& ledger, const CellField<Dim>& share,
                      const CellValues& brought, double span, const FaceField<Dim>& initial,
                      const FaceField<Dim>& trial);

// Span, room and level set of volumes that are carried along a velocity.
template <int Dim>
struct VolumeCarriage {
  double span;                      // s
  const CellField<Dim>& level_set;  // at its start, m
  const State<Dim>& leading;        // whose flow it is
  const LedgerRules<Dim>& ledger;   // room of cells at both times, and of faces that the flow fits
  const CellValues& brought;        // by feeds into owned cells, m^Dim
};

// Carries State::liquid along u (m/s), `through` faces. Books what passes the sides, and what the flow's divergence
// adds. Empty, or a text if paths leave the halo. Collective.
template <int Dim>
std::string carry_liquid(const Domain<Dim>& domain, const FaceField<Dim>& u, const FaceField<Dim>& through,
                         const VolumeCarriage<Dim>& carriage, State<Dim>& state);

// Brings level set and volume together after both were carried. Collective.
template <int Dim>
void couple_liquid(const Domain<Dim>& domain, const NodeField<Dim>& psi, const Ledger<Dim>& ledger, State<Dim>& state);

// Keeps the level set at the time of the volumes, and what they have beyond it if this is measured. psi: distance to
// the solids then, m.
template <int Dim>
void keep_level_of_volumes(const Domain<Dim>& domain, const NodeField<Dim>& psi, Divergence divergence,
                           State<Dim>& state);

// Empty, or a text if State::liquid changed from `before` to `next` by other than what passed the sides, to 1e-11 of
// it: a hundred times the rounding of a sum over 1e6 cells. Collective.
template <int Dim>
std::string fault_of_volume(const Domain<Dim>& domain, const State<Dim>& before, const State<Dim>& next);

// Volume of State::liquid and of drops, m^Dim. Collective.
template <int Dim>
double tracked_volume(const Domain<Dim>& domain, const State<Dim>& state);
// Sets the columns of volume from State::liquid, and without gas adds energies and momentum of what it has beyond
// the level set; `stats` has those of the level set. Collective.
template <int Dim>
void measure_tracked(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, StepStats& stats);

}  // namespace seiche
