#pragma once
// Flows that a scene prescribes for all times (`liquid.prescribed_velocity`): nothing is solved, only the surface
// moves.
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct TimeSpec;

// Mean velocity (m/s) at time t on the faces, ghosts included, that transport of the state's liquid over a step can
// read; 0 on others. Throws Error (bad_input at t = 0, else cannot_continue) if a formula is not finite. Collective.
template <int Dim>
FaceField<Dim> prescribed_flow(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, double t);

// The same in the liquid and in the band around it, as a time level without pressure. Collective.
template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> prescribed_level(const Domain<Dim>& domain, const Fluids& fluids,
                                                       const State<Dim>& state, double t);

// Largest |u_a| around the state's surface and in cells full in part, m/s, at time t. Collective.
template <int Dim>
double fastest_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, double t);

// Longest step (s) from the state's time in which the flow crosses at most cfl cells, sampled at its start, end and
// between. At most `remaining` and twice the last step. Collective.
template <int Dim>
double limit_of_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                           const State<Dim>& state, double remaining);

// Empty, or a text if the flow crosses more than ceil(cfl) cells in a step of dt (s). Collective.
template <int Dim>
std::string fault_of_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                                const State<Dim>& state, double dt);

// The largest |sum_a du_a/dx_a| of a cell with liquid (phi < 0), 1/s. Collective.
template <int Dim>
double largest_divergence(const Domain<Dim>& domain, const CellField<Dim>& phi, const FaceField<Dim>& u);

}  // namespace seiche
