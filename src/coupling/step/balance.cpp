#include "coupling/step/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "grid/loops.h"
#include "grid/partition.h"

namespace seiche {
namespace {

// Cells that a step works on: liquid and the cells beside it; all where gas flows.
template <int Dim>
CellField<Dim, char> active_cells(const Domain<Dim>& domain, const State<Dim>& state) {
  CellField<Dim, char> active(domain.layout);
  const bool all = state.exterior->flows();
  for_each_site(domain.layout, domain.layout.cells(),
                [&](Site s) { active[s] = all || state.phi[s] < domain.layout.h(); });
  return active;
}

template <int Dim>
bool same_blocks(const std::vector<Box<Dim>>& a, const std::vector<Box<Dim>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Box<Dim>& p, const Box<Dim>& q) {
    return (p.empty() && q.empty()) || (p.lower == q.lower && p.upper == q.upper);
  });
}

// Blocks within the grid whose cells add up to its cells.
template <int Dim>
bool tile(const std::vector<Box<Dim>>& blocks, const Box<Dim>& grid) {
  std::int64_t cells = 0;
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    if (blocks[n].empty()) continue;
    if (blocks[n].cut(grid).size() != blocks[n].size()) return false;
    for (std::size_t m = 0; m < n; ++m)
      if (!blocks[n].cut(blocks[m]).empty()) return false;
    cells += blocks[n].size();
  }
  return cells == grid.size();
}

}  // namespace

template <int Dim>
std::vector<Box<Dim>> better_blocks(const Domain<Dim>& domain, const State<Dim>& state) {
  constexpr double tolerated = 1.15, worth_moving = 0.92;
  if (domain.ranks.size() == 1) return {};
  const CellField<Dim, char> active = active_cells(domain, state);
  const double present = imbalance(work_of_blocks(domain.layout, active, domain.blocks, domain.ranks));
  if (present <= tolerated) return {};
  std::vector<Box<Dim>> blocks = partition_by_work(domain.layout, active, domain.ranks.size(), domain.ranks);
  const double next = imbalance(work_of_blocks(domain.layout, active, blocks, domain.ranks));
  if (next > worth_moving * present) return {};
  return blocks;
}

template <int Dim>
std::string text_of_blocks(const Domain<Dim>& domain) {
  if (same_blocks(domain.blocks, partition(domain.layout.geometry(), domain.ranks.size()))) return {};
  std::string text;
  for (const Box<Dim>& block : domain.blocks)
    for (const IVec<Dim>* bound : {&block.lower, &block.upper})
      for (int a = 0; a < Dim; ++a) text += fmt::format("{} ", (*bound)[a]);
  return text;
}

template <int Dim>
std::vector<Box<Dim>> blocks_of_text(const std::string& text, const Domain<Dim>& domain) {
  std::vector<int> numbers;
  std::istringstream stream(text);
  for (int n; stream >> n;) numbers.push_back(n);
  if (numbers.size() != 2 * std::size_t(Dim) * std::size_t(domain.ranks.size())) return {};
  std::vector<Box<Dim>> blocks(std::size_t(domain.ranks.size()));
  auto next = numbers.begin();
  for (Box<Dim>& block : blocks)
    for (IVec<Dim>* bound : {&block.lower, &block.upper})
      for (int a = 0; a < Dim; ++a) (*bound)[a] = *next++;
  if (!tile(blocks, domain.layout.geometry().box()))
    throw Error(ExitCode::bad_checkpoint, "the blocks of the checkpoint's ranks do not tile the grid");
  return blocks;
}

#define SEICHE_INSTANTIATE(D)                                                       \
  template std::vector<Box<D>> better_blocks<D>(const Domain<D>&, const State<D>&); \
  template std::string text_of_blocks<D>(const Domain<D>&);                         \
  template std::vector<Box<D>> blocks_of_text<D>(const std::string&, const Domain<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
