#pragma once
// The cells at both ends of links that the surface crosses, and the links between any two of them.
#include "coupling/state/state.h"
#include "grid/loops.h"
#include "linalg/core/vector_ops.h"

namespace seiche {

// `crossed` marks the faces whose link the surface crosses, halo filled.
template <int Dim>
class SurfaceGraph {
 public:
  SurfaceGraph(const Setup<Dim>& s, const FaceField<Dim, char>& crossed) : s_(s), member_(s.layout), value_(s.layout) {
    for_each_index_in_order(s.layout, s.layout.cells(), [&](Site c, const IVec<Dim>&) {
      for (int a = 0; a < Dim; ++a)
        if (crossed.at(a, c) || crossed.at(a, c + s.layout.stride(a))) member_[c] = 1;
      if (member_[c]) cells_.push_back(c);
    });
    s.halo.fill_ghosts({member_.data()});
  }

  const std::vector<Site>& cells() const { return cells_; }

  // y = K x, K x = sum over linked cells of x_i - x_j.
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
  // x on the grid, halo filled.
  const CellField<Dim>& spread(const Vector& x) const {
    for (std::size_t n = 0; n < cells_.size(); ++n) value_[cells_[n]] = x[n];
    s_.halo.fill_ghosts(value_);
    return value_;
  }

  // visit(cell across), owned or not.
  template <class Visit>
  void for_each_neighbour(Site c, const Visit& visit) const {
    for (int a = 0; a < Dim; ++a)
      for (Site d : {-s_.layout.stride(a), s_.layout.stride(a)})
        if (member_[c + d]) visit(c + d);
  }

 private:
  const Setup<Dim>& s_;
  CellField<Dim, char> member_;
  std::vector<Site> cells_;
  mutable CellField<Dim> value_;
};

}  // namespace seiche
