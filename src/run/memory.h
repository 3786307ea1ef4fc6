#pragma once
// Does the machine have what a scene needs? Said before anything large is allocated.
#include <cstdint>
#include <string>

#include "coupling/state/simulation.h"

namespace seiche {

// All in bytes.
struct MachineMemory {
  double total = 0;          // of the machine
  double available = 0;      // without swapping, now
  double address_limit = 0;  // RLIMIT_AS of this process less what it has; infinity when unlimited
};

MachineMemory machine_memory();
double peak_resident_bytes();  // of this process

// "12.3 GiB"
std::string readable_bytes(double bytes);

// Throws Error(bad_input) when this rank's share of the estimate, times the ranks on this machine, cannot ever fit the
// machine, Error(machine) when it does not fit what is free now or this process's limit. `ranks` is the number of
// ranks.
void check_memory(const Cost& cost, int ranks, int ranks_here, const MachineMemory& memory);

}  // namespace seiche
