#pragma once
// A loop over a range of integers on all threads, for work that is not a grid's (rows of a picture, bodies).
#include <tbb/parallel_for.h>

namespace seiche {

// body(i) for begin <= i < end, in any order and at the same time; the calls must not touch what others write.
template <class Body>
void parallel_range(int begin, int end, const Body& body) {
  tbb::parallel_for(begin, end, body);
}

}  // namespace seiche
