#pragma once
// Waiting that spins before it yields; the program's sched_yield() is made of it.

namespace seiche {

// True while the present wait of this thread is shorter than 200 us. Calls less than 5 us apart belong to one wait.
// Always false where ranks outnumber the processors.
bool is_patient();

// Marks the return from a yield, which belongs to the wait however long it took.
void end_yield();

// Makes Open MPI call sched_yield() while it waits, unless the environment has its own choice. Waits begin with
// spinning only if each rank on this machine has a processor. Before MPI_Init.
void wait_patiently();

}  // namespace seiche
