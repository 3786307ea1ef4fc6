#pragma once
// Loops over ranges of integers on all threads, for work other than grids (rows of a picture, bodies).
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

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

}  // namespace seiche
