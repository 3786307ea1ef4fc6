#include "linalg/core/sparse_vector.h"

#include <algorithm>

#include "base/parallel_range.h"

namespace seiche {

SparseVector nonzeros(const Vector& x) {
  SparseVector s;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] != 0) s.row.push_back(int(i)), s.value.push_back(x[i]);
  return s;
}

double local_dot(const SparseVector& x, const Vector& y) {
  double sum = 0;
  for (std::size_t n = 0; n < x.row.size(); ++n) sum += x.value[n] * y[std::size_t(x.row[n])];
  return sum;
}

void add_scaled(Vector& y, double a, const SparseVector& x) {
  for (std::size_t n = 0; n < x.row.size(); ++n) y[std::size_t(x.row[n])] += a * x.value[n];
}

void subtract_combination(const std::vector<SparseVector>& columns, std::span<const double> q, Vector& y) {
  parallel_pieces(y.size(), entries_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const SparseVector& x = columns[c];
      const auto first = std::lower_bound(x.row.begin(), x.row.end(), int(begin));
      for (auto n = std::size_t(first - x.row.begin()); n < x.row.size() && x.row[n] < int(end); ++n)
        y[std::size_t(x.row[n])] -= q[c] * x.value[n];
    }
  });
}

}  // namespace seiche
