// Settings of MPI.
#include <mpi.h>

#include <sched.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "base/emergency_channel.h"
#include "base/patient_yield.h"

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

namespace {

// Binds this thread to the n-th of its processors, counted round; its former ones come back at the end.
class Bound {
 public:
  explicit Bound(int n) {
    sched_getaffinity(0, sizeof(all_), &all_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0, k = n % CPU_COUNT(&all_); cpu < CPU_SETSIZE; ++cpu) {
      if (CPU_ISSET(cpu, &all_) && k-- == 0) CPU_SET(cpu, &one);
    }
    sched_setaffinity(0, sizeof(one), &one);
  }
  ~Bound() { sched_setaffinity(0, sizeof(all_), &all_); }
  Bound(const Bound&) = delete;
  Bound& operator=(const Bound&) = delete;

 private:
  cpu_set_t all_;
};

}  // namespace

// mpirun binds two ranks to a core each. They took themselves for ranks without processors of their own, yielded at
// once, and were six times slower beside one busy process.
TEST_CASE("ranks that are bound to a processor each wait patiently; ranks that share one do not", "[ranks]") {
  const Communicator ranks;
  const int processors = processors_of_this_machine(ranks);
  {
    const Bound bound(ranks.rank());
    choose_patience(ranks);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(is_patient() == (ranks.size() <= processors));
  }
  {
    const Bound bound(0);
    choose_patience(ranks);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(is_patient() == (ranks.size() == 1));
  }
  choose_patience(ranks);
}

}  // namespace mpi_tests
