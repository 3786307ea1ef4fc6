#pragma once
// Runs a scene built in code and returns the error that ends it.
#include <string>
#include <utility>

#include "base/error.h"
#include "coupling/state/simulation.h"

namespace seiche::test {

// Error that ends the run before the given time, or ("", done).
inline std::pair<std::string, ExitCode> end_of(const Scene& s, double until) {
  try {
    const auto sim = make_simulation(s, Communicator());
    while (sim->time() < until) (void)sim->step(until);
  } catch (const Error& error) {
    return {error.what(), error.code()};
  }
  return {"", ExitCode::done};
}

}  // namespace seiche::test
