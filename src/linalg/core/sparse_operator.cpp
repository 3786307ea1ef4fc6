#include "linalg/core/sparse_operator.h"

#include <algorithm>
#include <cassert>

namespace seiche {

SparseOperator::SparseOperator(const DistributedMatrix& A, Row first, int owned, const Communicator& ranks)
    : A_(A), halo_(A, first, owned, ranks), columns_(A.column.size()) {
  std::transform(A.column.begin(), A.column.end(), columns_.begin(), [&](Row c) { return halo_.local_index(c); });
  extended_.resize(std::size_t(halo_.owned() + halo_.ghosts()));
}

void SparseOperator::add_multiplied(std::span<const double> x, std::span<double> y) const {
  assert(int(x.size()) == halo_.owned() && int(y.size()) >= rows());
  std::copy(x.begin(), x.end(), extended_.begin());
  halo_.fill_ghosts(extended_);
  for (int i = 0; i < rows(); ++i) {
    double sum = 0;
    for (int k = A_.row_start[i]; k < A_.row_start[i + 1]; ++k) sum += A_.value[k] * extended_[columns_[k]];
    y[i] += sum;
  }
}

}  // namespace seiche
