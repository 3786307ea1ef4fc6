#pragma once
// Force and torque of a pressure on the faces that solids close.
#include <vector>

#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// F_k = sum_f s_k A (p_low - p_high) e_f (N) on each solid k, and its torque (N m): the transpose of the flux that the
// solid displaces. Torques are about pivots, and about the reference points of deforming solids. p: Pa, ghosts filled.
// Collective.
template <int Dim>
std::vector<SolidLoad> pressure_loads(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
                                      const CellField<Dim>& p);

}  // namespace seiche
