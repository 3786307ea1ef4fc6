#include "grid/layout.h"

#include <limits>

namespace seiche {

template <int Dim>
Layout<Dim>::Layout(const Geometry<Dim>& geometry, const Box<Dim>& owned, int halo)
    : geometry_(geometry), owned_(owned), padded_(owned), authority_(owned), halo_(halo) {
  if (owned.empty()) return;
  padded_ = owned.grown(halo);
  for (int a = 0; a < Dim; ++a) {
    if (at_lower(a)) authority_.lower[a] = padded_.lower[a];
    if (at_upper(a)) authority_.upper[a] = padded_.upper[a];
  }
  size_ = 1;
  for (int a = 0; a < Dim; ++a) {
    stride_[a] = size_;
    size_ *= padded_.upper[a] - padded_.lower[a];
  }
}

template <int Dim>
Box<Dim> Layout<Dim>::faces(int axis) const {
  Box<Dim> b = owned_;
  if (!b.empty() && at_upper(axis)) b.upper[axis] += 1;
  return b;
}

template <int Dim>
Box<Dim> Layout<Dim>::nodes() const {
  Box<Dim> b = owned_;
  for (int a = 0; a < Dim && !owned_.empty(); ++a)
    if (at_upper(a)) b.upper[a] += 1;
  return b;
}

template <int Dim>
IVec<Dim> Layout<Dim>::index(Site site) const {
  IVec<Dim> i;
  for (int a = Dim - 1; a >= 0; --a) {
    i[a] = int(site / stride_[a]) + padded_.lower[a];
    site %= stride_[a];
  }
  return i;
}

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

template class Layout<2>;
template class Layout<3>;
template std::vector<Box<2>> partition<2>(const Geometry<2>&, int);
template std::vector<Box<3>> partition<3>(const Geometry<3>&, int);

}  // namespace seiche
