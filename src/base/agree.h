#pragma once
// Runs work that may fail on some ranks only and makes all ranks throw the same error.
#include <functional>
#include <string>

#include "base/communicator.h"

namespace seiche {

// Runs `work` on every rank; it must not communicate. If it threw on any rank, the exception of the lowest failing rank
// is thrown on all of them as Error. The message names a rank above 0. Running out of memory becomes Error(machine,
// "out of memory while <doing>"), any other foreign exception Error(bug). Collective.
void agree(const Communicator& ranks, const std::string& doing, const std::function<void()>& work);

// The same, but only rank 0 runs `work`. Collective.
void agree_on_root(const Communicator& ranks, const std::string& doing, const std::function<void()>& work);

}  // namespace seiche
