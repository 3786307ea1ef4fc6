#pragma once
// The place of solids at the end of a leapfrog step, which the velocities of its solve have to fit.
#include <memory>

#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "fluid/pressure/pressure.h"

namespace seiche {

// A leapfrog step finds the pressure with its solids half-way, X(t + dt/2), so that forces are those of its middle. Its
// velocities are those of the end, and no liquid passes through solids at X(t + dt). There the net flux of a cell is
//   sum_f +- (w' u + s' v'),   w' and s' the open and closed shares of faces at X(t + dt), v' the solid's velocity,
// in place of sum_f +- (w u + s v) half-way. `flux` is the difference, with w + s = 1,
//   s' (v' - u) - s (v - u),
// per face area, of the flow that is known: the liquid's velocity relative to the solid moves along with it, so u at x
// is read at x - dt v and turned with the solid (docs/decisions/0055-constraint-at-the-end.md).
template <int Dim>
struct EndOfStep {
  StepGeometry<Dim> geometry;  // at X(t + dt), as far as the known velocities lead
  PagedFaceField<Dim> flux;    // m/s
};

// True if velocities fit the solids' places at the end of leapfrog steps: those of solids that move freely in ideal
// liquid. Prescribed ones are given the mean velocity of the step, which fits its middle. Viscous stress acts half-way,
// and velocities that stick to solids there must not pass through them elsewhere.
template <int Dim>
bool fits_end_of_step(const Fluids& fluids, const Solids<Dim>& solids);

// `next`: solids half-way, `half`: their geometry. `known`: the state before, or that after a trial of the step. dt:
// the step, s. Null if no such solid moves. Collective.
template <int Dim>
std::shared_ptr<const EndOfStep<Dim>> end_of_step(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                                  const State<Dim>& known, const State<Dim>& next,
                                                  const StepGeometry<Dim>& half, double dt);

// Adds `flux` to the net fluxes of cells with a row. In a closed component, whose fluxes must balance, what is left of
// their sum is taken off in proportion to their sizes. Collective.
template <int Dim>
void add_flux_of_end(const Domain<Dim>& domain, const PressureRows<Dim>& rows, const NullSpace& closed,
                     const PagedFaceField<Dim>& flux, FaceGeometry<Dim>& faces);

// Puts distances and poses of a geometry half-way to the end; shares and velocities stay.
template <int Dim>
void place_at(const StepGeometry<Dim>& end, StepGeometry<Dim>& geometry);

}  // namespace seiche
