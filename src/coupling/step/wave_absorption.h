#pragma once
// Sides that let out the waves that come to them.
#include "coupling/geometry/step_geometry.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// A level set (m) at a time (s).
template <int Dim>
struct LevelAt {
  const CellField<Dim>& phi;
  double time;
};

// Adds to the velocities prescribed at sides with waves what lets out the excess e of the level there over that of the
// waves that enter: outward, WaveSide::outlet() e. The velocities are those of time t (s); the levels before and at the
// solve lead to e there by a straight line. Collective.
template <int Dim>
void absorb_waves(const Domain<Dim>& domain, const LevelAt<Dim>& before, const LevelAt<Dim>& solved, double t,
                  StepGeometry<Dim>& geometry);

}  // namespace seiche
