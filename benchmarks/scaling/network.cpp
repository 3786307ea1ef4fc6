// What messages between ranks cost on this machine: latency (s) of a message, seconds a byte, and seconds a step of a
// reduction, on two ranks or more. Prints one line of JSON.
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

// Seconds of one call of `work`, the least of several series.
template <class Work>
double seconds_of(const Work& work) {
  constexpr int series = 20, calls = 200;
  double least = INFINITY;
  for (int s = 0; s < series; ++s) {
    MPI_Barrier(MPI_COMM_WORLD);
    const double start = MPI_Wtime();
    for (int n = 0; n < calls; ++n) work();
    least = std::min(least, (MPI_Wtime() - start) / calls);
  }
  return least;
}

// Seconds that a message of `size` bytes takes one way, between ranks 0 and 1.
double one_way(int rank, int size) {
  const auto length = static_cast<std::size_t>(size);
  std::vector<char> out(length, 1), in(length);
  return seconds_of([&] {
    if (rank > 1) return;
    MPI_Sendrecv(out.data(), size, MPI_CHAR, 1 - rank, 0, in.data(), size, MPI_CHAR, 1 - rank, 0, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
  });
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks > 1) {
    constexpr int large = 1 << 18;
    const double latency = one_way(rank, 8), seconds_a_byte = (one_way(rank, large) - latency) / large;
    double value = 1, sum = 0;
    const double reduction =
        seconds_of([&] { MPI_Allreduce(&value, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD); }) / std::log2(ranks);
    if (rank == 0)
      std::printf("{\"latency\": %.3e, \"seconds_a_byte\": %.3e, \"reduction\": %.3e}\n", latency, seconds_a_byte,
                  reduction);
  }
  MPI_Finalize();
}
