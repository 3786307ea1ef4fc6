#pragma once
// Waiting that spins before it yields or sleeps; the program's sched_yield() is made of it.

#include <chrono>

namespace seiche {

// True while the present wait of this thread is shorter than 200 us. Calls less than 5 us apart belong to one wait.
// Always false after spin_before_yields(false).
bool is_patient();

// Marks the return from a yield, which belongs to the wait however long it took.
void end_yield();

// Takes note of how long a yield took. One of 1 ms or more went to another process.
void note_yield(std::chrono::microseconds took);

// True for 10 ms after a slow yield, twice as long after each further one, up to 1 s. Quick yields halve that again.
bool is_crowded();

// Yields, or sleeps for some 70 us where it is crowded.
void give_way();

// Makes Open MPI call sched_yield() while it waits, unless the environment has its own choice. Before MPI_Init.
void wait_patiently();

// Waits begin with spinning, or not. Not where ranks outnumber the processors of their machine: one that spins there
// keeps the rank that it waits for from its work.
void spin_before_yields(bool spin);

}  // namespace seiche
