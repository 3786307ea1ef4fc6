#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <cstdlib>
#include <optional>

#include "base/communicator.h"
#include "base/thread_limit.h"

// SEICHE_TEST_THREADS: the most threads that tests use; all processors without it.
int main(int argc, char** argv) {
  const seiche::MpiSession mpi(argc, argv);
  std::optional<seiche::ThreadLimit> limit;
  if (const char* threads = std::getenv("SEICHE_TEST_THREADS")) limit.emplace(std::atoi(threads));
  return Catch::Session().run(argc, argv);
}
