#pragma once
// The solids and the walls of the domain as the contact solve sees them.
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct DomainSpec;
struct TimeSpec;

// All solids of the scene, of which the pairs `apart` never touch, with the friction that pairs have of their own.
// Every side of the domain is a wall, except periodic and outflow sides.
template <int Dim>
ContactScene<Dim> make_contact_scene(const DomainSpec& extent, const Participants<Dim>& solids,
                                     std::vector<std::array<int, 2>> apart, PairCoefficients friction,
                                     const OperatorPerturbation& perturbation);

// Throws Error(bad_input), naming the pairs and depths: a body with unknowns touches or overlaps something at the
// start, or an elastic body crosses a periodic side.
template <int Dim>
void refuse_overlaps(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                     const State<Dim>& state);

// Motion of each solid over the horizon: from its place at the state's time; prescribed solids to their end poses.
template <int Dim>
std::vector<ContactMotion> contact_motions(const State<Dim>& state, double horizon);

// Reach, stiffness and speeds of contact on this grid.
template <int Dim>
ContactOptions contact_options(const Domain<Dim>& domain, const DomainSpec& extent, const TimeSpec& time,
                               const Gravity& gravity, const OperatorPerturbation& perturbation);

// Names of the solids with unknowns that reach a periodic side, for messages.
template <int Dim>
std::string solids_at_periodic_sides(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& state);

// Sentence on a solid that formulas move across a periodic side; empty if there is none. `placed`: of the last step.
template <int Dim>
std::string prescribed_across_periodic_sides(const Domain<Dim>& domain, const State<Dim>& state,
                                             const std::vector<Placement>& placed);

// Names of the solids that almost touch each other or a side, for messages.
template <int Dim>
std::string nearest_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                           const State<Dim>& state);

// Largest share of dt (0 to 1) that the solids can move without touching. Those with unknowns move as the last solve
// found.
template <int Dim>
double safe_share(const Solids<Dim>& solids, const State<Dim>& state, double dt);

}  // namespace seiche
