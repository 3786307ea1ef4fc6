#pragma once
// A loop over a range of integers on all threads, for work that is not a grid's (rows of a picture, bodies).
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace seiche {

// body(i) for begin <= i < end, in any order and at the same time; the calls must not touch what others write.
template <class Body>
void parallel_range(int begin, int end, const Body& body) {
  tbb::parallel_for(begin, end, body);
}

// The same for 0 <= i < count and quick bodies, of which a thread takes about `a_task` at a time.
template <class Body>
void parallel_range_in_tasks(std::size_t count, std::size_t a_task, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, a_task), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

}  // namespace seiche
