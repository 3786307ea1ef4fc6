#pragma once
// Serial execution of library code whose result depends on TBB's splitting.
#include <tbb/task_arena.h>

namespace seiche {

// Calls work() so that parallel loops within it run on this thread alone.
template <class Work>
void run_serially(Work&& work) {
  tbb::task_arena arena(1);
  arena.execute(work);
}

}  // namespace seiche
