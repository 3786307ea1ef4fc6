#include "base/communicator.h"

#include <cstdlib>
#include <utility>

#include "base/blas_kernels.h"
#include "base/emergency_channel.h"
#include "base/error.h"
#include "base/patient_yield.h"

namespace seiche {
namespace {

template <class T>
T reduce(MPI_Comm comm, T value, MPI_Datatype type, MPI_Op op) {
  T result{};
  MPI_Allreduce(&value, &result, 1, type, op, comm);
  return result;
}

struct Pieces {
  std::vector<int> counts, offsets;
  std::string bytes;
};

// Room for pieces of these sizes, one behind the other.
Pieces room_for(std::vector<int> counts) {
  Pieces p{std::move(counts), {}, {}};
  std::int64_t total = 0;
  for (const int count : p.counts) {
    p.offsets.push_back(int(total));
    total += count;
    if (total > INT32_MAX) throw Error(ExitCode::machine, "more than 2 GiB gathered on one rank");
  }
  p.bytes.resize(std::size_t(total));
  return p;
}

Pieces exchange_sizes(MPI_Comm comm, int ranks, int mine) {
  std::vector<int> counts(std::size_t(ranks), 0);
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  return room_for(std::move(counts));
}

std::vector<std::string> split(const Pieces& p) {
  std::vector<std::string> parts;
  for (std::size_t r = 0; r < p.counts.size(); ++r) parts.push_back(p.bytes.substr(p.offsets[r], p.counts[r]));
  return parts;
}

}  // namespace

// Variables that the environment sets already keep their values.
MpiSession::MpiSession(int& argc, char**& argv) {
  // Waiting ranks yield their core. Otherwise, on a busy machine, they would block the ranks that they wait for.
  wait_patiently();
  choose_blas_kernels();
  // Without mpirun, Open MPI starts a daemon for the single process and makes a folder that all such processes share:
  // both can fail if one process starts while another ends. A single process needs neither.
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  choose_patience(Communicator());
}

MpiSession::~MpiSession() {
  MPI_Finalize();
}

Communicator::Communicator(MPI_Comm handle) : handle_(handle) {
  MPI_Comm_rank(handle, &rank_);
  MPI_Comm_size(handle, &size_);
}

double Communicator::global_sum(double value) const {
  return reduce(handle_, value, MPI_DOUBLE, MPI_SUM);
}
double Communicator::global_max(double value) const {
  return reduce(handle_, value, MPI_DOUBLE, MPI_MAX);
}
double Communicator::global_min(double value) const {
  return reduce(handle_, value, MPI_DOUBLE, MPI_MIN);
}
std::int64_t Communicator::global_sum(std::int64_t value) const {
  return reduce(handle_, value, MPI_INT64_T, MPI_SUM);
}
std::int64_t Communicator::global_max(std::int64_t value) const {
  return reduce(handle_, value, MPI_INT64_T, MPI_MAX);
}

void Communicator::global_sum(std::span<double> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, MPI_SUM, handle_);
}

std::int64_t Communicator::exclusive_prefix_sum(std::int64_t value) const {
  std::int64_t before = 0;
  MPI_Exscan(&value, &before, 1, MPI_INT64_T, MPI_SUM, handle_);
  return rank_ == 0 ? 0 : before;
}

void Communicator::barrier() const {
  MPI_Barrier(handle_);
}

std::string Communicator::broadcast(const std::string& text) const {
  std::int64_t size = std::int64_t(text.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, handle_);
  std::string result = text;
  result.resize(std::size_t(size));
  MPI_Bcast(result.data(), int(size), MPI_CHAR, 0, handle_);
  return result;
}

std::vector<std::string> Communicator::gather(const std::string& bytes) const {
  Pieces p = exchange_sizes(handle_, size_, int(bytes.size()));
  if (!is_root()) p.bytes.clear();
  MPI_Gatherv(bytes.data(), int(bytes.size()), MPI_CHAR, p.bytes.data(), p.counts.data(), p.offsets.data(), MPI_CHAR, 0,
              handle_);
  return is_root() ? split(p) : std::vector<std::string>{};
}

std::vector<std::string> Communicator::all_gather(const std::string& bytes) const {
  Pieces p = exchange_sizes(handle_, size_, int(bytes.size()));
  MPI_Allgatherv(bytes.data(), int(bytes.size()), MPI_CHAR, p.bytes.data(), p.counts.data(), p.offsets.data(), MPI_CHAR,
                 handle_);
  return split(p);
}

std::vector<std::string> Communicator::exchange(const std::vector<std::string>& to) const {
  std::vector<int> sizes, counts(to.size());
  for (const std::string& bytes : to) sizes.push_back(int(bytes.size()));
  MPI_Alltoall(sizes.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, handle_);
  Pieces out = room_for(std::move(sizes)), in = room_for(std::move(counts));
  for (std::size_t r = 0; r < to.size(); ++r) to[r].copy(out.bytes.data() + out.offsets[r], to[r].size());
  MPI_Alltoallv(out.bytes.data(), out.counts.data(), out.offsets.data(), MPI_CHAR, in.bytes.data(), in.counts.data(),
                in.offsets.data(), MPI_CHAR, handle_);
  return split(in);
}

}  // namespace seiche
