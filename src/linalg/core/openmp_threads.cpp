#include "linalg/core/openmp_threads.h"

#include <dlfcn.h>

namespace seiche {

// With no active level a region has one thread. The limit belongs to the calling thread. The OpenMP library comes with
// CHOLMOD, so its function is looked up: a build without it has none.
void keep_openmp_to_this_thread() {
  using SetLevels = void (*)(int);
  static const auto set_levels = reinterpret_cast<SetLevels>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
  thread_local bool is_set = false;
  if (set_levels && !is_set) set_levels(0);
  is_set = true;
}

}  // namespace seiche
