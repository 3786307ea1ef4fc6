#pragma once
// Liquid that passes the domain's sides.
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Volume that flows in through the sides per time, m^Dim/s: through a side that feeds liquid all of it, elsewhere the
// share of the cell beside it that phi counts as liquid. Collective.
template <int Dim>
double net_inflow(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, const CellField<Dim>& phi,
                  const FaceField<Dim>& u);

// Sets FaceGeometry::entering to the speed with which u enters through outflow sides.
template <int Dim>
void find_entering(const Domain<Dim>& domain, const FaceField<Dim>& u, FaceGeometry<Dim>& faces);

// u* times ProjectionInput::entry_factor.
template <int Dim>
void brake_entering(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, double dt, FaceField<Dim>& u_star);

// Corrects what the first step, of length dt, has booked at the sides while the surface moved ahead of its solve. The
// velocity u(0) of the scene may have divergence, as beside an inflow into liquid at rest. The pressure then sets the
// liquid in motion at once, to u(0+), which a step of dt/1000 finds. Over a lead of s dt the mean is
//   (1 - s/2) u(0+) + s/2 u(dt);  u(0) was booked.
// Changes nothing if no side lets liquid pass. Collective.
template <int Dim>
void book_first_flow(const Setup<Dim>& setup, const State<Dim>& start, const StepGeometry<Dim>& geometry, double dt,
                     Phases& phases, State<Dim>& end);

}  // namespace seiche
