#pragma once
// Compares a scene's memory estimate with the machine, before anything large is allocated.
#include <cstdint>
#include <string>

#include "coupling/state/simulation.h"

namespace seiche {

// All in bytes.
struct MachineMemory {
  double total = 0;          // of the machine
  double available = 0;      // now, without swapping
  double address_limit = 0;  // RLIMIT_AS of this process minus its present use; infinity if unlimited
};

MachineMemory machine_memory();
double peak_resident_bytes();  // of this process

// "12.3 GiB"
std::string readable_bytes(double bytes);

// Compares this rank's share of the estimate, times the ranks on this machine, with the memory. Throws Error(bad_input)
// if it can never fit the machine, Error(machine) if it does not fit the free memory or this process's limit. `ranks`
// is the number of ranks.
void check_memory(const Cost& cost, int ranks, int ranks_here, const MachineMemory& memory);

}  // namespace seiche
