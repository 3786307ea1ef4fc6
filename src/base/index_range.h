#pragma once
// A range of indices.
#include <cstddef>

namespace seiche {

// The indices begin <= i < end.
struct IndexRange {
  int begin = 0, end = 0;
  int size() const { return end - begin; }
  bool holds(std::ptrdiff_t i) const { return begin <= i && i < end; }
};

}  // namespace seiche
