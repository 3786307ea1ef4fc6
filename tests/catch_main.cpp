#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "base/communicator.h"

int main(int argc, char** argv) {
  const seiche::MpiSession mpi(argc, argv);
  return Catch::Session().run(argc, argv);
}
