#pragma once
// Splits of the grid into one block per rank. Ranks for which there is no block get empty boxes.
#include <vector>

#include "grid/fields.h"

namespace seiche {

// Blocks of equal size with the smallest area between them.
template <int Dim>
std::vector<Box<Dim>> partition(const Geometry<Dim>& geometry, int ranks);

// Work of a cell that is not active, in active cells: loops skip empty space, but look at it.
inline constexpr double idle_work = 1.0 / 64;

// Work in each of the blocks: its active cells, and idle_work for each other cell. Collective; the same on all ranks.
template <int Dim>
std::vector<double> work_of_blocks(const Layout<Dim>& layout, const CellField<Dim, char>& active,
                                   const std::vector<Box<Dim>>& blocks, const Communicator& ranks);

// Largest work over the mean; 1: balanced.
double imbalance(const std::vector<double>& work);

// Blocks of equal work by recursive bisection (Berger, Bokhari 1987): the grid is cut in two between layers of cells,
// where work divides as the numbers of ranks do and little work lies at the cut, then each part likewise. `layout`: of
// the present blocks, one a rank. `blocks`: how many are wanted. Collective; the same on all ranks.
template <int Dim>
std::vector<Box<Dim>> partition_by_work(const Layout<Dim>& layout, const CellField<Dim, char>& active, int blocks,
                                        const Communicator& ranks);

}  // namespace seiche
