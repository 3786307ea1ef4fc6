// Settings of MPI.
#include <mpi.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "base/emergency_channel.h"

namespace mpi_tests {
using namespace seiche;

namespace {

// A control variable of the MPI library; -1 if there is none of that name.
int control_variable(const char* name) {
  int provided = 0, index = 0, count = 0, value = -1;
  MPI_T_init_thread(MPI_THREAD_SINGLE, &provided);
  MPI_T_cvar_handle handle = MPI_T_CVAR_HANDLE_NULL;
  if (MPI_T_cvar_get_index(name, &index) == MPI_SUCCESS &&
      MPI_T_cvar_handle_alloc(index, nullptr, &handle, &count) == MPI_SUCCESS && count == 1) {
    MPI_T_cvar_read(handle, &value);
    MPI_T_cvar_handle_free(&handle);
  }
  MPI_T_finalize();
  return value;
}

}  // namespace

TEST_CASE("ranks that wait yield their processor") {
  const char* wanted = std::getenv("OMPI_MCA_mpi_yield_when_idle");
  REQUIRE(wanted != nullptr);
  const int yields = control_variable("mpi_yield_when_idle");
  if (yields >= 0 && std::string(wanted) == "1") CHECK(yields == 1);
}

TEST_CASE("the processors of a machine are counted") {
  const Communicator ranks;
  CHECK(processors_of_this_machine(ranks) >= 1);
  CHECK(ranks_on_this_machine(ranks) == ranks.size());
}

}  // namespace mpi_tests
