#pragma once
// Velocities that a scene gives, as far as the coming step meets them before the flow does.
#include "base/time_spec.h"
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The longest step up to dt in which nothing that the scene gives crosses more than cfl cells: liquid that sides and
// sources bring, walls that drag it. Collective.
template <int Dim>
double limit_of_given_flow(const Domain<Dim>& domain, const TimeSpec& time, const std::vector<Source<Dim>>& sources,
                           double t, double dt);

// The largest component of the velocities that sides and sources give from t to t + dt, m/s. Collective.
template <int Dim>
double fastest_given_flow(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources, double t, double dt);

// The longest first step up to dt in which the velocities that elastic bodies begin with strain them by no more than
// 1e-3 of their kinetic energy.
template <int Dim>
double limit_of_given_velocity(const State<Dim>& start, double dt);

}  // namespace seiche
