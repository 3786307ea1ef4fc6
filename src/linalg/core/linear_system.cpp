#include "linalg/core/linear_system.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel_range.h"

namespace seiche {
namespace {

constexpr std::size_t rows_a_task = 1024;

// An isolated cell without an open face has no equation, so it adds no constant to the null space.
NullSpace without_rows(NullSpace null_space, const DistributedMatrix& A) {
  for (int i = 0; i < A.rows() && !null_space.component.empty(); ++i) {
    if (A.value[A.row_start[i]] == 0) null_space.component[i] = -1;
  }
  return null_space;
}

}  // namespace

LinearSystem::LinearSystem(const DistributedMatrix& A, const RowGrid& grid, const NullSpace& null_space,
                           const Communicator& ranks)
    : pattern_(A),
      grid_(grid),
      null_space_(without_rows(null_space, A)),
      ranks_(ranks),
      halo_(A, ranks),
      values_(A.value),
      columns_(A.column.size()),
      means_(null_space_, ranks) {
  std::transform(A.column.begin(), A.column.end(), columns_.begin(), [&](Row c) { return halo_.local_index(c); });
  replace_zero_diagonals();
}

void LinearSystem::replace_zero_diagonals() {
  for (int i = 0; i < rows(); ++i) {
    if (diagonal(i) == 0) identity_.push_back(i);
  }
  identity_rows_ = ranks_.global_sum(std::int64_t(identity_.size()));
  if (identity_rows_ == 0) return;
  Vector keep(rows() + halo_.ghosts(), 1.0);
  for (const int i : identity_) keep[i] = 0;
  halo_.fill_ghosts(keep);
  for (int i = 0; i < rows(); ++i) {
    for (int k = pattern_.row_start[i]; k < pattern_.row_start[i + 1]; ++k) values_[k] *= keep[i] * keep[columns_[k]];
  }
  for (const int i : identity_) values_[pattern_.row_start[i]] = 1;
}

double LinearSystem::row_times(std::size_t i, const double* x) const {
  double sum = 0;
  for (int k = pattern_.row_start[i]; k < pattern_.row_start[i + 1]; ++k)
    sum += values_[std::size_t(k)] * x[columns_[std::size_t(k)]];
  return sum;
}

const double* LinearSystem::with_ghosts(const Vector& x) const {
  assert(int(x.size()) == rows());
  if (ranks_.size() == 1) return x.data();
  extended_.resize(rows() + halo_.ghosts());
  std::copy(x.begin(), x.end(), extended_.begin());
  halo_.fill_ghosts(extended_);
  return extended_.data();
}

void LinearSystem::multiply(const Vector& x, Vector& y) const {
  const double* all = with_ghosts(x);
  parallel_pieces(std::size_t(rows()), rows_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) y[i] = row_times(i, all);
  });
}

void LinearSystem::residual(const Vector& b, const Vector& x, Vector& r) const {
  const double* all = with_ghosts(x);
  parallel_pieces(std::size_t(rows()), rows_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) r[i] = b[i] - row_times(i, all);
  });
}

void LinearSystem::multiply_magnitudes(const Vector& x, Vector& y) const {
  const double* all = with_ghosts(x);
  parallel_pieces(std::size_t(rows()), rows_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      y[i] = 0;
      for (int k = pattern_.row_start[i]; k < pattern_.row_start[i + 1]; ++k)
        y[i] += std::abs(values_[std::size_t(k)] * all[columns_[std::size_t(k)]]);
    }
  });
}

void LinearSystem::project(Vector& v) const {
  for (const int i : identity_) v[i] = 0;
  means_.apply(v);
}

}  // namespace seiche
