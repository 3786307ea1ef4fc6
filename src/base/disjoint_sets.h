#pragma once
// Disjoint sets of the integers 0 ... n - 1 (union-find).
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace seiche {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The smaller index becomes the root, so that roots do not depend on the order of joining.
  void join(int i, int j) {
    i = root(i), j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace seiche
