#pragma once
// Liquid too little for a pressure of its own: shares of cells away from the level set's liquid. Drops are made of it.
#include "coupling/state/state.h"

namespace seiche {

// Cells, the first beyond the owned ones too, with a share of liquid that have no cell of phi < 0 (m) within one of
// them.
template <int Dim>
std::vector<Site> drifting_cells(const Domain<Dim>& domain, const CellField<Dim>& phi, const CellField<Dim>& share);

// Velocity of a face in free fall, m/s: u(x - dt u) + dt g, with g the mean gravity of the step, m/s^2.
template <int Dim>
double falling_velocity(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec3& gravity, double dt, int axis,
                        Site face);

}  // namespace seiche
