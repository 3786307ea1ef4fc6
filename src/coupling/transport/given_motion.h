#pragma once
// Velocities that a scene gives and that act in the coming step before the flow shows them.
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct TimeSpec;

// Longest step up to dt (s) from time t in which given velocities cross at most cfl cells: inflow through sides,
// sources, walls that drag liquid. Collective.
template <int Dim>
double limit_of_given_flow(const Domain<Dim>& domain, const TimeSpec& time, const std::vector<Source<Dim>>& sources,
                           double t, double dt);

// Largest velocity component given by sides and sources from t to t + dt, m/s, sampled at four times. Collective.
template <int Dim>
double fastest_given_flow(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources, double t, double dt);

// Longest first step up to dt (s) after which the initial velocities have given elastic bodies an elastic energy of at
// most 1e-3 of their kinetic energy.
template <int Dim>
double limit_of_given_velocity(const State<Dim>& start, double dt);

}  // namespace seiche
