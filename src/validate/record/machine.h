#pragma once
#include <string>

namespace seiche {

// Processor, cores and memory of this machine and the program's compiler, such as "AMD EPYC; 2 cores; 23.4 GiB; g++
// 12.2.0".
std::string describe_machine();

}  // namespace seiche
