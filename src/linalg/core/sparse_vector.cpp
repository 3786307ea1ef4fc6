#include "linalg/core/sparse_vector.h"

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

}  // namespace seiche
