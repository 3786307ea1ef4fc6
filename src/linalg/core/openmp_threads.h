#pragma once

namespace seiche {

// Parallel regions of OpenMP that libraries open from this thread run on this thread alone. CHOLMOD asks for four
// threads in every supernode, whatever OMP_NUM_THREADS says: on two cores they cost a third of a factor's time.
void keep_openmp_to_this_thread();

}  // namespace seiche
