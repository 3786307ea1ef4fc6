#pragma once
// The ranks of a run. MPI is called only here, in emergency_channel, in src/grid/halo, and in src/linalg (column halo,
// hypre).
#include <mpi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace seiche {

// Starts MPI for the life of the program; main() owns the only one.
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
};

class Communicator {
 public:
  explicit Communicator(MPI_Comm handle = MPI_COMM_WORLD);
  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  MPI_Comm handle() const { return handle_; }

  double global_sum(double value) const;
  double global_max(double value) const;
  double global_min(double value) const;
  std::int64_t global_sum(std::int64_t value) const;
  std::int64_t global_max(std::int64_t value) const;
  void global_sum(std::span<double> values) const;  // element by element, in place
  bool any(bool value) const { return global_max(std::int64_t(value)) != 0; }
  // Sum over the ranks before this one.
  std::int64_t exclusive_prefix_sum(std::int64_t value) const;

  void barrier() const;
  std::string broadcast(const std::string& text) const;                 // rank 0's text
  std::vector<std::string> gather(const std::string& bytes) const;      // on rank 0, by rank; else empty
  std::vector<std::string> all_gather(const std::string& bytes) const;  // on every rank, by rank
  // Sends to[r] to rank r; what this rank got, by sender.
  std::vector<std::string> exchange(const std::vector<std::string>& to) const;

 private:
  MPI_Comm handle_;
  int rank_ = 0, size_ = 1;
};

}  // namespace seiche
