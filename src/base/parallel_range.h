#pragma once
// Loops over ranges of integers on all threads: rows of a matrix or a picture, bodies, entries of a field.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace seiche {

// Calls body(i) for begin <= i < end, in any order and concurrently. No call may access data that another one writes.
template <class Body>
void parallel_range(int begin, int end, const Body& body) {
  tbb::parallel_for(begin, end, body);
}

// The same for 0 <= i < count and quick bodies: a thread takes about `a_task` of them at a time.
template <class Body>
void parallel_range_in_tasks(std::size_t count, std::size_t a_task, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, a_task), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

// Splits 0 <= i < count into pieces of `piece` each and calls body(begin, end) for them: concurrently, unless there is
// only one.
template <class Body>
void parallel_pieces(std::size_t count, std::size_t piece, const Body& body) {
  if (count <= piece) return body(std::size_t(0), count);
  const std::size_t pieces = (count + piece - 1) / piece;
  tbb::parallel_for(std::size_t(0), pieces, [&](std::size_t n) { body(n * piece, std::min(count, (n + 1) * piece)); });
}

// Sum of body(begin, end) over the same pieces, added up in their order: the bits do not depend on the threads.
template <class Body>
double sum_of_pieces(std::size_t count, std::size_t piece, const Body& body) {
  if (count <= piece) return body(std::size_t(0), count);
  std::vector<double> sums((count + piece - 1) / piece);
  parallel_pieces(count, piece, [&](std::size_t begin, std::size_t end) { sums[begin / piece] = body(begin, end); });
  double total = 0;
  for (const double sum : sums) total += sum;
  return total;
}

}  // namespace seiche
