#include "grid/partition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "grid/loops.h"

namespace seiche {
namespace {

// Area between the blocks of a split, in cells: a measure of the halo exchange.
template <int Dim>
double split_cost(const IVec<Dim>& cells, const IVec<Dim>& split) {
  double cost = 0;
  for (int a = 0; a < Dim; ++a) {
    double area = 1;
    for (int b = 0; b < Dim; ++b)
      if (b != a) area *= cells[b];
    cost += area * (split[a] - 1);
  }
  return cost;
}

template <int Dim>
void search_split(const IVec<Dim>& cells, int axis, int remaining, IVec<Dim>& split, IVec<Dim>& best,
                  double& best_cost) {
  if (axis == Dim - 1) {
    split[axis] = remaining;
    if (remaining > cells[axis]) return;
    const double cost = split_cost<Dim>(cells, split);
    if (cost < best_cost) best_cost = cost, best = split;
    return;
  }
  for (int n = 1; n <= remaining && n <= cells[axis]; ++n) {
    if (remaining % n != 0) continue;
    split[axis] = n;
    search_split<Dim>(cells, axis + 1, remaining / n, split, best, best_cost);
  }
}

// The cheapest split into the largest number of blocks, at most `ranks`, that the cell counts allow.
template <int Dim>
IVec<Dim> choose_split(const IVec<Dim>& cells, int ranks) {
  for (int n = ranks; n >= 1; --n) {
    IVec<Dim> split, best;
    double cost = std::numeric_limits<double>::infinity();
    search_split<Dim>(cells, 0, n, split, best, cost);
    if (cost < std::numeric_limits<double>::infinity()) return best;
  }
  return IVec<Dim>::Ones();
}

// Part of the grid that the ranks first ... first + count - 1 share.
template <int Dim>
struct Part {
  Box<Dim> box;
  int first = 0, count = 1;

  std::size_t layers() const { return box.empty() ? 0 : std::size_t((box.upper - box.lower).sum()); }
};

// Calls body(index, work) for this rank's cells in the box.
template <int Dim, class Body>
void for_each_work(const Layout<Dim>& layout, const CellField<Dim, char>& active, const Box<Dim>& box,
                   const Body& body) {
  const Box<Dim> common = box.cut(layout.cells());
  if (common.empty()) return;
  for_each_index_in_order(layout, common, [&](Site s, const IVec<Dim>& i) { body(i, active[s] ? 1.0 : idle_work); });
}

// Work in each layer of the parts that are still shared, across one axis after the other, over all ranks.
template <int Dim>
std::vector<double> work_of_layers(const Layout<Dim>& layout, const CellField<Dim, char>& active,
                                   const std::vector<Part<Dim>>& parts, const Communicator& ranks) {
  std::size_t size = 0;
  for (const Part<Dim>& part : parts) size += part.layers();
  std::vector<double> layers(size);
  std::size_t first = 0;
  for (const Part<Dim>& part : parts) {
    IVec<Dim> start = IVec<Dim>::Zero();
    for (int a = 1; a < Dim; ++a) start[a] = start[a - 1] + part.box.upper[a - 1] - part.box.lower[a - 1];
    for_each_work(layout, active, part.box, [&](const IVec<Dim>& i, double work) {
      for (int a = 0; a < Dim; ++a) layers[first + std::size_t(start[a] + i[a] - part.box.lower[a])] += work;
    });
    first += part.layers();
  }
  ranks.global_sum(layers);
  return layers;
}

struct Cut {
  int axis = -1, at = 0;  // -1: no cut is possible
  double cost = std::numeric_limits<double>::infinity();
};

// Cut across an axis whose lower part has the share of the work nearest to `share`. Its cost: the work in a layer at
// the cut, a measure of the exchange, and what the parts lack to their shares.
Cut cut_across(int axis, int lower, std::span<const double> layers, double share) {
  const double total = std::accumulate(layers.begin(), layers.end(), 0.0);
  Cut best;
  double least = std::numeric_limits<double>::infinity(), below = 0;
  for (std::size_t k = 1; k < layers.size(); ++k) {
    below += layers[k - 1];
    const double error = std::abs(below / total - share);
    if (error >= least) continue;
    least = error;
    best = {axis, lower + int(k), std::max(layers[k - 1], layers[k]) / total + 4 * error};
  }
  return best;
}

template <int Dim>
Cut best_cut(const Part<Dim>& part, std::span<const double> layers) {
  Cut best;
  for (int a = 0; a < Dim; ++a) {
    const auto extent = std::size_t(part.box.upper[a] - part.box.lower[a]);
    const Cut cut = cut_across(a, part.box.lower[a], layers.subspan(0, extent), double(part.count / 2) / part.count);
    if (cut.cost < best.cost) best = cut;
    layers = layers.subspan(extent);
  }
  return best;
}

// Both halves of a part. One without a cut stays whole on its first rank.
template <int Dim>
std::array<Part<Dim>, 2> halves(const Part<Dim>& part, const Cut& cut) {
  Part<Dim> low = part, high = part;
  low.count = part.count / 2;
  high.first += low.count, high.count -= low.count;
  if (cut.axis < 0)
    high.box = {};
  else
    low.box.upper[cut.axis] = high.box.lower[cut.axis] = cut.at;
  return {low, high};
}

}  // namespace

template <int Dim>
std::vector<Box<Dim>> partition(const Geometry<Dim>& geometry, int ranks) {
  const IVec<Dim> split = choose_split<Dim>(geometry.cells, ranks);
  std::vector<Box<Dim>> boxes(ranks);
  for (int r = 0; r < split.prod(); ++r) {
    int rest = r;
    for (int a = 0; a < Dim; ++a) {
      const std::int64_t block = rest % split[a], n = geometry.cells[a];
      rest /= split[a];
      boxes[r].lower[a] = int(block * n / split[a]);
      boxes[r].upper[a] = int((block + 1) * n / split[a]);
    }
  }
  return boxes;
}

template <int Dim>
std::vector<double> work_of_blocks(const Layout<Dim>& layout, const CellField<Dim, char>& active,
                                   const std::vector<Box<Dim>>& blocks, const Communicator& ranks) {
  std::vector<double> work(blocks.size());
  for (std::size_t r = 0; r < blocks.size(); ++r)
    for_each_work(layout, active, blocks[r], [&](const IVec<Dim>&, double w) { work[r] += w; });
  ranks.global_sum(work);
  return work;
}

double imbalance(const std::vector<double>& work) {
  const double total = std::accumulate(work.begin(), work.end(), 0.0);
  return total > 0 ? *std::max_element(work.begin(), work.end()) * double(work.size()) / total : 1;
}

template <int Dim>
std::vector<Box<Dim>> partition_by_work(const Layout<Dim>& layout, const CellField<Dim, char>& active, int count,
                                        const Communicator& ranks) {
  std::vector<Box<Dim>> blocks(std::size_t(count), Box<Dim>{});
  std::vector<Part<Dim>> parts{{layout.geometry().box(), 0, count}};
  while (!parts.empty()) {
    std::vector<Part<Dim>> shared, next;
    for (const Part<Dim>& part : parts)
      if (part.count == 1)
        blocks[std::size_t(part.first)] = part.box;
      else
        shared.push_back(part);
    const std::vector<double> layers = work_of_layers(layout, active, shared, ranks);
    std::span<const double> left = layers;
    for (const Part<Dim>& part : shared) {
      for (const Part<Dim>& half : halves(part, best_cut(part, left))) next.push_back(half);
      left = left.subspan(part.layers());
    }
    parts = std::move(next);
  }
  return blocks;
}

#define SEICHE_INSTANTIATE(D)                                                                         \
  template std::vector<Box<D>> partition<D>(const Geometry<D>&, int);                                 \
  template std::vector<double> work_of_blocks<D>(const Layout<D>&, const CellField<D, char>&,         \
                                                 const std::vector<Box<D>>&, const Communicator&);    \
  template std::vector<Box<D>> partition_by_work<D>(const Layout<D>&, const CellField<D, char>&, int, \
                                                    const Communicator&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
