#include "base/emergency_channel.h"

#include <sched.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <thread>

#include "base/patient_yield.h"

namespace seiche {

EmergencyChannel::EmergencyChannel(const Communicator& ranks) : codes_(std::size_t(ranks.size()), 0) {
  MPI_Comm_dup(ranks.handle(), &handle_);
}

// Leaves the duplicate to MPI_Finalize: freeing it is collective, and a failing rank may be alone here.
EmergencyChannel::~EmergencyChannel() = default;

std::optional<std::vector<int>> EmergencyChannel::meet(int code, std::chrono::milliseconds patience) const {
  mine_ = code;
  MPI_Request request;
  MPI_Iallgather(&mine_, 1, MPI_INT, codes_.data(), 1, MPI_INT, handle_, &request);
  const auto give_up = std::chrono::steady_clock::now() + patience;
  int done = 0;
  do {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) return codes_;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (std::chrono::steady_clock::now() < give_up);
  return std::nullopt;
}

void EmergencyChannel::abort(int code) const {
  if (codes_.size() > 1) MPI_Abort(handle_, code);
  std::_Exit(code);
}

namespace {

// The ranks of this machine. The caller frees the communicator.
MPI_Comm split_by_machine(const Communicator& ranks) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(ranks.handle(), MPI_COMM_TYPE_SHARED, ranks.rank(), MPI_INFO_NULL, &machine);
  return machine;
}

}  // namespace

int ranks_on_this_machine(const Communicator& ranks) {
  MPI_Comm machine = split_by_machine(ranks);
  int count = 1;
  MPI_Comm_size(machine, &count);
  MPI_Comm_free(&machine);
  return count;
}

// mpirun may bind each rank to some of the processors, so the ranks' masks are combined.
int processors_of_this_machine(const Communicator& ranks) {
  std::array<unsigned long, 1024> mask{};  // room for 65536 processors
  const int failed = sched_getaffinity(0, sizeof mask, reinterpret_cast<cpu_set_t*>(mask.data()));
  if (failed) mask.fill(0);
  MPI_Comm machine = split_by_machine(ranks);
  MPI_Allreduce(MPI_IN_PLACE, mask.data(), int(mask.size()), MPI_UNSIGNED_LONG, MPI_BOR, machine);
  MPI_Comm_free(&machine);
  int count = 0;
  for (const unsigned long word : mask) count += std::popcount(word);
  return count > 0 ? count : std::max(1, int(std::thread::hardware_concurrency()));
}

void choose_patience(const Communicator& ranks) {
  spin_before_yields(ranks_on_this_machine(ranks) <= processors_of_this_machine(ranks));
}

}  // namespace seiche
