#include "base/thread_limit.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>

namespace seiche {

struct ThreadLimit::Impl {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(new Impl{{tbb::global_control::max_allowed_parallelism, std::size_t(std::max(1, threads))}}) {}

ThreadLimit::~ThreadLimit() = default;

}  // namespace seiche
