#include "linalg/core/null_space.h"

#include <cassert>

namespace seiche {

MeanRemover::MeanRemover(const NullSpace& null_space, const Communicator& ranks)
    : ranks_(ranks), component_(null_space.component), rows_(null_space.count, 0.0), mean_(null_space.count) {
  for (const int c : component_) {
    assert(c < null_space.count);
    if (c >= 0) rows_[c] += 1;
  }
  if (!rows_.empty()) ranks_.global_sum(rows_);
}

void MeanRemover::apply(Vector& v) const {
  if (rows_.empty()) return;
  mean_.assign(rows_.size(), 0.0);
  for (std::size_t i = 0; i < component_.size(); ++i) {
    if (component_[i] >= 0) mean_[component_[i]] += v[i];
  }
  ranks_.global_sum(mean_);
  for (std::size_t c = 0; c < rows_.size(); ++c) mean_[c] /= rows_[c] > 0 ? rows_[c] : 1;
  for (std::size_t i = 0; i < component_.size(); ++i) {
    if (component_[i] >= 0) v[i] -= mean_[component_[i]];
  }
}

}  // namespace seiche
