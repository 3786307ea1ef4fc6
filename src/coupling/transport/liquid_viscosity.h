#pragma once
// The liquid's viscosity on the grid, by formula or by shear rate.
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Fills mu (Pa s) at cell centres and ghosts, at time t (s): from the scene's formula, or from the shear rate of u on
// the faces with `valid` set. The formula is evaluated in every cell of the domain. Returns a text on a value that is
// not finite or negative, or an empty one. After a fault mu must not be used. Collective; the text is this rank's.
template <int Dim>
[[nodiscard]] std::string set_liquid_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const FaceField<Dim>& u,
                                               const FaceField<Dim, char>& valid, double t, CellField<Dim>& mu);

// The same check of the formula at time t in this rank's cells. Empty if there is no fault, or no formula that varies.
template <int Dim>
std::string fault_of_viscosity(const Domain<Dim>& domain, const Fluids& fluids, double t);

}  // namespace seiche
