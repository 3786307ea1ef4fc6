#pragma once
// The liquid's viscosity on the grid, by formula or by shear rate.
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Fills mu (Pa s) at cell centres, ghosts too, at time t: from the scene's formula, or from the shear rate of u, whose
// faces where `valid` is 0 do not count. Answers what is wrong with the formula and where (not finite, negative),
// empty where nothing is; mu is then of no use. The formula is asked in every cell of the domain. Collective; the
// answer is this rank's.
template <int Dim>
[[nodiscard]] std::string set_liquid_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const FaceField<Dim>& u,
                                               const FaceField<Dim, char>& valid, double t, CellField<Dim>& mu);

// What is wrong with the formula at time t in this rank's cells; empty where nothing is, or where it is a constant.
template <int Dim>
std::string fault_of_viscosity(const Domain<Dim>& domain, const Fluids& fluids, double t);

}  // namespace seiche
