#include "linalg/core/vector_ops.h"

#include <cassert>

namespace seiche {
namespace {

// Four partial sums allow vector instructions; the compiler may not reorder a single sum.
double local_dot(const Vector& x, const Vector& y) {
  assert(x.size() == y.size());
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  std::size_t i = 0;
  for (; i + 4 <= x.size(); i += 4) {
    s0 += x[i] * y[i];
    s1 += x[i + 1] * y[i + 1];
    s2 += x[i + 2] * y[i + 2];
    s3 += x[i + 3] * y[i + 3];
  }
  for (; i < x.size(); ++i) s0 += x[i] * y[i];
  return (s0 + s1) + (s2 + s3);
}

}  // namespace

double dot(const Vector& x, const Vector& y, const Communicator& ranks) {
  return ranks.global_sum(local_dot(x, y));
}

double norm(const Vector& x, const Communicator& ranks) {
  return std::sqrt(dot(x, x, ranks));
}

void add_scaled(Vector& y, double a, const Vector& x) {
  assert(x.size() == y.size());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += a * x[i];
}

void scale_and_add(Vector& y, double a, const Vector& x) {
  assert(x.size() == y.size());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = x[i] + a * y[i];
}

bool all_finite(std::span<const double> x, const Communicator& ranks) {
  double poison = 0;  // v * 0 is 0 for finite v and NaN otherwise
  for (const double v : x) poison += v * 0;
  return !ranks.any(poison != 0 || std::isnan(poison));
}

}  // namespace seiche
