#pragma once
// Graph of the cells at both ends of links that the surface crosses, with edges between neighbouring ones.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "linalg/core/vector_ops.h"

namespace seiche {

// `crossed`: nonzero on faces whose link the surface crosses, halo filled. Keeps a reference to `domain`. Collective.
template <int Dim>
class SurfaceGraph {
 public:
  SurfaceGraph(const Domain<Dim>& domain, const FaceField<Dim, char>& crossed)
      : domain_(domain), member_(domain.layout), value_(domain.layout) {
    for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) {
      for (int a = 0; a < Dim; ++a)
        if (crossed.at(a, c) || crossed.at(a, c + domain.layout.stride(a))) member_[c] = 1;
      if (member_[c]) cells_.push_back(c);
    });
    domain.halo.fill_ghosts({member_.data()});
  }

  const std::vector<Site>& cells() const { return cells_; }

  // y = K x, (K x)_i = sum over neighbours j of x_i - x_j. Collective.
  void laplacian(const Vector& x, Vector& y) const {
    spread(x);
    for (std::size_t n = 0; n < cells_.size(); ++n) {
      y[n] = 0;
      for_each_neighbour(cells_[n], [&](Site across) { y[n] += x[n] - value_[across]; });
    }
  }
  int degree(std::size_t n) const {
    int count = 0;
    for_each_neighbour(cells_[n], [&](Site) { ++count; });
    return count;
  }
  // x on the grid, halo filled; valid until the next call. Collective.
  const CellField<Dim>& spread(const Vector& x) const {
    for (std::size_t n = 0; n < cells_.size(); ++n) value_[cells_[n]] = x[n];
    domain_.halo.fill_ghosts(value_);
    return value_;
  }

  // visit(cell) for the neighbours of c in the graph, owned or not.
  template <class Visit>
  void for_each_neighbour(Site c, const Visit& visit) const {
    for (int a = 0; a < Dim; ++a)
      for (Site d : {-domain_.layout.stride(a), domain_.layout.stride(a)})
        if (member_[c + d]) visit(c + d);
  }

 private:
  const Domain<Dim>& domain_;
  CellField<Dim, char> member_;
  std::vector<Site> cells_;
  mutable CellField<Dim> value_;
};

}  // namespace seiche
