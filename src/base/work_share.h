#pragma once
// Work that several processes share, for code that does not know how they talk.
#include <span>

#include "base/index_range.h"

namespace seiche {

class WorkShare {
 public:
  virtual ~WorkShare() = default;
  virtual int processes() const = 0;
  // This process's share of the indices 0 <= i < n.
  virtual IndexRange of(int n) const = 0;
  // Sums element by element, in place, and the least value: the same bits on all processes. Collective.
  virtual void add_up(std::span<double> values) const = 0;
  virtual double least(double value) const = 0;
};

}  // namespace seiche
