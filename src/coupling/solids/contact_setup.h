#pragma once
// The solids and the walls of the domain as the contact solve sees them.
#include "base/domain_spec.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// All solids of the scene, and every closed side of the domain as a wall.
template <int Dim>
ContactScene<Dim> make_contact_scene(const Scene& scene, const Participants<Dim>& solids,
                                     const OperatorPerturbation& perturbation);

// Refuses bodies with unknowns that touch or overlap something at the start, and elastic ones that reach beyond a
// periodic side: Error(bad_input) naming the pairs and depths.
template <int Dim>
void refuse_overlaps(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                     const State<Dim>& state);

// From where the solids stand to where the prescribed ones stand after the horizon.
template <int Dim>
std::vector<ContactMotion> contact_motions(const State<Dim>& state, double horizon);

// Reach, stiffness and speeds of contact on this grid.
template <int Dim>
ContactOptions contact_options(const Setup<Dim>& setup);

// Names of the solids with unknowns that reach a periodic side, for messages.
template <int Dim>
std::string solids_at_periodic_sides(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& state);

// Names of the solids that all but touch each other or a side, for messages.
template <int Dim>
std::string nearest_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                           const State<Dim>& state);

// The largest share of dt that the solids can move without touching, those with unknowns as the last solve left
// them.
template <int Dim>
double safe_share(const Solids<Dim>& solids, const State<Dim>& state, double dt);

}  // namespace seiche
