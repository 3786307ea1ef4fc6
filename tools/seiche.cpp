#include <CLI/CLI.hpp>

#include "base/communicator.h"

int main(int argc, char** argv) {
  const seiche::MpiSession mpi(argc, argv);
  return 0;
}
