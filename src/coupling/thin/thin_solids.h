#pragma once
// Liquid beside solids that are thinner than a cell: the level set knows one surface, not on which side of them it is.
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Cells beside a thin solid change between wet and dry only where something can have come from their own side since
// `before`: looked at are the place where the centre was as the solid moves it, and the cells around that which the
// solid does not part from it. And where there is liquid on one side alone, the level set there does not tell how near
// the solid is: liquid goes on towards it as behind. Collective.
template <int Dim>
void keep_sides_apart(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& before,
                      const StepGeometry<Dim>& geometry, CellField<Dim>& phi);

}  // namespace seiche
