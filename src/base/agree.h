#pragma once
// Work that may fail on some ranks only, and whose failure all ranks must learn of.
#include <functional>
#include <string>

#include "base/communicator.h"

namespace seiche {

// Runs `work`, which must not communicate, on every rank and then agrees on the outcome: if it threw anywhere, the
// exception of the lowest failing rank is thrown on all of them as the same Error. A rank above 0 is named in the
// message. Running out of memory becomes Error(machine, "out of memory while <doing>"). Collective.
void agree(const Communicator& ranks, const std::string& doing, const std::function<void()>& work);

// The same for work that only rank 0 does.
void agree_on_root(const Communicator& ranks, const std::string& doing, const std::function<void()>& work);

}  // namespace seiche
