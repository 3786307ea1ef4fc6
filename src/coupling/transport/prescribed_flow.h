#pragma once
// Flows that a scene gives for all times (`liquid.prescribed_velocity`): nothing is solved, the surface alone moves.
#include "base/time_spec.h"
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The velocity at time t on the faces that carrying the surface `phi` over a step can read, ghosts too; 0 on the
// others. Throws Error (bad_input at t = 0, else cannot_continue) where a formula is not finite. Collective.
template <int Dim>
FaceField<Dim> prescribed_flow(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, double t);

// The same where liquid is and within the band around it, as a time level; no pressure.
template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> prescribed_level(const Domain<Dim>& domain, const Fluids& fluids,
                                                       const CellField<Dim>& phi, double t);

// Largest |u_a| around the surface `phi` at time t, m/s. Collective.
template <int Dim>
double fastest_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, double t);

// The longest step from the state's time that crosses at most cfl cells with the flow at its begin and end and at times
// between, s; at most `remaining`. Collective.
template <int Dim>
double limit_of_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                           const State<Dim>& state, double remaining);

// Empty, or that a step of dt crosses more cells than the halo holds. Collective.
template <int Dim>
std::string fault_of_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                                const State<Dim>& state, double dt);

// The largest |sum_a du_a/dx_a| of a cell with liquid (phi < 0), 1/s. Collective.
template <int Dim>
double largest_divergence(const Domain<Dim>& domain, const CellField<Dim>& phi, const FaceField<Dim>& u);

}  // namespace seiche
