#pragma once
// Half-open boxes of grid indices.
#include <cstdint>

#include "base/vec.h"

namespace seiche {

template <int Dim>
struct Box {
  IVec<Dim> lower = IVec<Dim>::Zero(), upper = IVec<Dim>::Zero();

  bool empty() const { return (upper.array() <= lower.array()).any(); }
  bool contains(const IVec<Dim>& i) const {
    return (i.array() >= lower.array()).all() && (i.array() < upper.array()).all();
  }
  std::int64_t size() const { return empty() ? 0 : (upper - lower).template cast<std::int64_t>().prod(); }
  Box grown(int n) const { return {lower.array() - n, upper.array() + n}; }
  Box shifted(const IVec<Dim>& s) const { return {lower + s, upper + s}; }
  Box cut(const Box& b) const { return {lower.cwiseMax(b.lower), upper.cwiseMin(b.upper)}; }
};

}  // namespace seiche
