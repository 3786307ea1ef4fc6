#pragma once
// The coarse level under a level of multigrid.
#include <memory>

#include "linalg/precond/multigrid_level.h"

namespace seiche {

// The blocks of 2^Dim cells of `fine` become cells, with coefficients for the doubled distance. `excess` is e of the
// fine level before, of the coarse one after. Notes in `fine` which cells stay without a coarse one. Collective.
template <int Dim>
std::unique_ptr<MultigridLevel<Dim>> coarsen(MultigridLevel<Dim>& fine, std::vector<float>& excess);

}  // namespace seiche
