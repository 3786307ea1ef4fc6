#pragma once
// The share of the pressure that moves with solids, which a solve on a fixed grid leaves behind them.
#include "coupling/solids/solid_coupling.h"
#include "coupling/transport/transport.h"

namespace seiche {

// Pressure (Pa) to add to that of the solve where it acts on solids that move, and its load on each solid. Solids that
// are thinner than a cell or deform do not carry it.
//
// A step from u_n, which fits the solids' places X_n at the last solve, to u_(n+1), which fits X_(n+1), has the mean
//   p = (p_n + p_(n+1))/2
// of the pressures that fit both places (trapezoid along paths). On a solid at X_(n+1) that has moved by S, p_n acts as
// p_n(x - S) would: its place in the flow is that of the time before. The difference, with the pressure gradient of the
// flow -rho A, is
//   (p_n(x - S) - p_n(x))/2 = rho S.A/2.
// Without it a disc that glides at speed V through ideal liquid feels the drag pi rho V^3 dt. Hydrostatic pressure is
// not part of A and does not move along. Leapfrog steps of solids that move freely in ideal liquid need none: p acts
// half-way between the places that p_n and p_(n+1) fit (end_of_step.h).
template <int Dim>
struct ConvectedPressure {
  CellField<Dim> value;          // beside solids that carry it, else 0; ghosts filled; empty if there are none
  std::vector<SolidLoad> loads;  // one a solid, the same on all ranks; empty if none carries it

  bool any() const { return !loads.empty(); }
};

// `since`: time between the last solve's geometry and this one's, s. `participants`: with the velocities of the last
// solve. Collective.
template <int Dim>
ConvectedPressure<Dim> convected_pressure(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                          const Participants<Dim>& participants, const StepGeometry<Dim>& geometry,
                                          const CellField<Dim>& phi, const Transported<Dim>& transported, double since);

// Adds its impulse on the unknowns of rigid blocks over a step of dt (s) to coupling.push. Collective.
template <int Dim>
void push_by(const ConvectedPressure<Dim>& convected, const Domain<Dim>& domain, const PressureRows<Dim>& rows,
             double dt, SolidCoupling<Dim>& coupling);

}  // namespace seiche
