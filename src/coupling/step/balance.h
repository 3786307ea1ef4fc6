#pragma once
// Blocks of the ranks that follow the liquid.
#include <string>
#include <vector>

#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Blocks of about equal work for the state's fluids. Empty: the present ones stay, since the busiest rank has little
// more than the mean, or others would gain little. Collective; the same on all ranks.
template <int Dim>
std::vector<Box<Dim>> better_blocks(const Domain<Dim>& domain, const State<Dim>& state);

// Blocks as a text and back. No blocks: of equal size, or for another number of ranks. Throws Error(bad_checkpoint) if
// they do not tile the grid.
template <int Dim>
std::string text_of_blocks(const Domain<Dim>& domain);
template <int Dim>
std::vector<Box<Dim>> blocks_of_text(const std::string& text, const Domain<Dim>& domain);

}  // namespace seiche
