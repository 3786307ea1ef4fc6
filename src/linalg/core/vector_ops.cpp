#include "linalg/core/vector_ops.h"

#include <cassert>

#include "base/parallel_range.h"

namespace seiche {
namespace {

// Four partial sums allow vector instructions; the compiler may not reorder a single sum.
double dot_of_piece(const Vector& x, const Vector& y, std::size_t i, std::size_t end) {
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  for (; i + 4 <= end; i += 4) {
    s0 += x[i] * y[i];
    s1 += x[i + 1] * y[i + 1];
    s2 += x[i + 2] * y[i + 2];
    s3 += x[i + 3] * y[i + 3];
  }
  for (; i < end; ++i) s0 += x[i] * y[i];
  return (s0 + s1) + (s2 + s3);
}

}  // namespace

double local_dot(const Vector& x, const Vector& y) {
  assert(x.size() == y.size());
  return sum_of_pieces(x.size(), entries_a_task,
                       [&](std::size_t begin, std::size_t end) { return dot_of_piece(x, y, begin, end); });
}

double dot(const Vector& x, const Vector& y, const Communicator& ranks) {
  return ranks.global_sum(local_dot(x, y));
}

double norm(const Vector& x, const Communicator& ranks) {
  return std::sqrt(dot(x, x, ranks));
}

void add_scaled(Vector& y, double a, const Vector& x) {
  assert(x.size() == y.size());
  parallel_pieces(y.size(), entries_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) y[i] += a * x[i];
  });
}

void scale_and_add(Vector& y, double a, const Vector& x) {
  assert(x.size() == y.size());
  parallel_pieces(y.size(), entries_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) y[i] = x[i] + a * y[i];
  });
}

bool all_finite(std::span<const double> x, const Communicator& ranks) {
  double poison = 0;  // v * 0 is 0 for finite v and NaN otherwise
  for (const double v : x) poison += v * 0;
  return !ranks.any(poison != 0 || std::isnan(poison));
}

}  // namespace seiche
