#include "files/checked_file.h"

#include <sys/resource.h>

#include <catch2/catch.hpp>

#include "base/error.h"
#include "run/signals.h"
#include "unit/files/scratch.h"

namespace checked_file_tests {
using namespace seiche;
namespace fs = std::filesystem;

namespace {

// Limits the size of this process's files.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const struct rlimit limit { bytes, before_.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  struct rlimit before_ {};
};

template <class F>
Error error_of(F&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error;
  }
  return {ExitCode::done, ""};
}

}  // namespace

TEST_CASE("a written file holds its bytes and leaves no temporary file") {
  const ScratchFolder folder;
  const std::string bytes(100000, 'x');
  write_file(folder / "a", bytes);
  write_file(folder / "a", bytes + "y");
  CHECK(contents(folder / "a") == bytes + "y");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a file over the size limit fails with its path and the free bytes and keeps the old one") {
  const StopSignals signals;  // ignores SIGXFSZ, as in a run
  const ScratchFolder folder;
  write_file(folder / "a", "old");
  const FileSizeLimit limit(1000);
  const Error error = error_of([&] { write_file(folder / "a", std::string(5000, 'x')); });
  CHECK(error.code() == ExitCode::output_failed);
  CHECK(std::string(error.what()).find((folder / "a").string()) != std::string::npos);
  CHECK(std::string(error.what()).find("bytes free") != std::string::npos);
  CHECK(contents(folder / "a") == "old");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("writing into a missing folder or a full device is an output error") {
  const ScratchFolder folder;
  CHECK(error_of([&] { write_file(folder / "none/a", "x"); }).code() == ExitCode::output_failed);
  CHECK(error_of([&] { make_folder("/dev/null/sub"); }).code() == ExitCode::output_failed);
  fs::create_symlink("/dev/full", folder / "full");
  AppendFile file(folder / "full", 0);
  file.append("text");
  const Error error = error_of([&] { file.flush(); });
  CHECK(error.code() == ExitCode::output_failed);
  CHECK(std::string(error.what()).find("No space left") != std::string::npos);
}

TEST_CASE("a growing file continues at its end and can be cut to an earlier size") {
  const ScratchFolder folder;
  {
    AppendFile file(folder / "t", 0);
    file.append("one\n");
    file.flush();
    file.append("two\n");
    CHECK(file.size() == 8);
    CHECK(contents(folder / "t") == "one\n");
    file.sync();
  }
  AppendFile file(folder / "t", 4);
  file.append("2\n");
  file.flush();
  CHECK(contents(folder / "t") == "one\n2\n");
}

}  // namespace checked_file_tests
