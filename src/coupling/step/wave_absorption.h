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

// Gives gas at sides with waves the velocity that takes back what liquid brings: the same at all faces of gas in an
// upright column, so that no volume passes the column. phi is the level of the solve. Faces within half a cell of the
// surface move with the liquid; those from there to a cell further do so in part. Columns without gas stay as they
// are. Collective.
template <int Dim>
void balance_gas_beside_waves(const Domain<Dim>& domain, const CellField<Dim>& phi, StepGeometry<Dim>& geometry);

}  // namespace seiche
