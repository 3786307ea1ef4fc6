#pragma once
// The finest level of multigrid from the rows of a matrix.
#include <string>

#include "linalg/precond/multigrid_level.h"

namespace seiche {

template <int Dim>
struct StencilRows {
  SplitRows<Dim> rows;                       // this rank's part of the box
  std::vector<int> place;                    // of each matrix row, -1 for rows that are on no cell
  std::array<std::vector<float>, Dim> face;  // as in MultigridLevel
  std::vector<float> excess;
};

// Returns why there is none, or an empty text. Collective.
template <int Dim>
std::string assemble_stencil(const LinearSystem& system, const CellBox& box, StencilRows<Dim>& stencil);

}  // namespace seiche
