// Counts what a program's ranks exchange, hypre's messages too. Preloaded into the program (LD_PRELOAD), these
// functions stand before MPI's own, which MPI offers under the names PMPI_* for such tools (MPI standard, profiling
// interface). At the end each rank writes its counts to $MPI_COUNTS/RANK.json.
#include <mpi.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace {

struct Counts {
  long long messages = 0, bytes = 0, reductions = 0, collectives = 0;
  double seconds_in_mpi = 0;  // of this thread's processor time: waiting ranks spin
} counts;

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

// Adds the processor time of its life to seconds_in_mpi, unless it lies within another one's.
class Timer {
 public:
  Timer() : outermost_(depth_++ == 0), start_(outermost_ ? thread_seconds() : 0) {}
  ~Timer() {
    --depth_;
    if (outermost_) counts.seconds_in_mpi += thread_seconds() - start_;
  }
  Timer(const Timer&) = delete;

 private:
  static inline int depth_ = 0;
  bool outermost_;
  double start_;
};

void count_message(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  ++counts.messages;
  counts.bytes += static_cast<long long>(count) * size;
}

double processor_seconds() {
  rusage use;
  getrusage(RUSAGE_SELF, &use);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

void write_counts() {
  const char* folder = std::getenv("MPI_COUNTS");
  if (!folder) return;
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::FILE* file = std::fopen((std::string(folder) + "/" + std::to_string(rank) + ".json").c_str(), "w");
  if (!file) return;
  std::fprintf(file,
               "{\"messages\": %lld, \"bytes\": %lld, \"reductions\": %lld, \"collectives\": %lld, "
               "\"seconds_in_mpi\": %.6f, \"processor_seconds\": %.6f}\n",
               counts.messages, counts.bytes, counts.reductions, counts.collectives, counts.seconds_in_mpi,
               processor_seconds());
  std::fclose(file);
}

}  // namespace

extern "C" {

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  const Timer timer;
  count_message(count, type);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Irsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  const Timer timer;
  count_message(count, type);
  return PMPI_Irsend(data, count, type, to, tag, comm, request);
}

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  const Timer timer;
  count_message(count, type);
  return PMPI_Send(data, count, type, to, tag, comm);
}

int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status) {
  const Timer timer;
  return PMPI_Recv(data, count, type, from, tag, comm, status);
}

int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request) {
  const Timer timer;
  return PMPI_Irecv(data, count, type, from, tag, comm, request);
}

int MPI_Wait(MPI_Request* request, MPI_Status* status) {
  const Timer timer;
  return PMPI_Wait(request, status);
}

int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
  const Timer timer;
  return PMPI_Waitall(count, requests, statuses);
}

int MPI_Test(MPI_Request* request, int* flag, MPI_Status* status) {
  const Timer timer;
  return PMPI_Test(request, flag, status);
}

int MPI_Iprobe(int from, int tag, MPI_Comm comm, int* flag, MPI_Status* status) {
  const Timer timer;
  return PMPI_Iprobe(from, tag, comm, flag, status);
}

int MPI_Allreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  const Timer timer;
  ++counts.reductions;
  return PMPI_Allreduce(data, result, count, type, op, comm);
}

int MPI_Reduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm) {
  const Timer timer;
  ++counts.reductions;
  return PMPI_Reduce(data, result, count, type, op, root, comm);
}

int MPI_Exscan(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  const Timer timer;
  ++counts.reductions;
  return PMPI_Exscan(data, result, count, type, op, comm);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  const Timer timer;
  ++counts.collectives;
  return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Barrier(MPI_Comm comm) {
  const Timer timer;
  ++counts.collectives;
  return PMPI_Barrier(comm);
}

int MPI_Allgather(const void* data, int count, MPI_Datatype type, void* result, int each, MPI_Datatype result_type,
                  MPI_Comm comm) {
  const Timer timer;
  ++counts.collectives;
  return PMPI_Allgather(data, count, type, result, each, result_type, comm);
}

int MPI_Allgatherv(const void* data, int count, MPI_Datatype type, void* result, const int each[], const int first[],
                   MPI_Datatype result_type, MPI_Comm comm) {
  const Timer timer;
  ++counts.collectives;
  return PMPI_Allgatherv(data, count, type, result, each, first, result_type, comm);
}

int MPI_Gatherv(const void* data, int count, MPI_Datatype type, void* result, const int each[], const int first[],
                MPI_Datatype result_type, int root, MPI_Comm comm) {
  const Timer timer;
  ++counts.collectives;
  return PMPI_Gatherv(data, count, type, result, each, first, result_type, root, comm);
}

int MPI_Alltoall(const void* data, int count, MPI_Datatype type, void* result, int each, MPI_Datatype result_type,
                 MPI_Comm comm) {
  const Timer timer;
  ++counts.collectives;
  return PMPI_Alltoall(data, count, type, result, each, result_type, comm);
}

int MPI_Alltoallv(const void* data, const int counts_out[], const int first_out[], MPI_Datatype type, void* result,
                  const int counts_in[], const int first_in[], MPI_Datatype result_type, MPI_Comm comm) {
  const Timer timer;
  ++counts.collectives;
  return PMPI_Alltoallv(data, counts_out, first_out, type, result, counts_in, first_in, result_type, comm);
}

int MPI_Finalize(void) {
  write_counts();
  return PMPI_Finalize();
}

}  // extern "C"
