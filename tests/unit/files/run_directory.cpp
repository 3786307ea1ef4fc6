#include "files/run_directory.h"

#include <fcntl.h>
#include <sys/file.h>

#include <catch2/catch.hpp>
#include <optional>

#include "base/error.h"
#include "unit/files/scratch.h"

namespace run_directory_tests {
using namespace seiche;
namespace fs = std::filesystem;

namespace {

ExitCode code_of_opening(const fs::path& folder, ExistingOutput policy) {
  try {
    const RunDirectory directory(folder, policy);
    return ExitCode::done;
  } catch (const Error& error) {
    return error.code();
  }
}

}  // namespace

TEST_CASE("a run directory is created with its parents and removed again when nothing was put into it") {
  const ScratchFolder scratch;
  {
    const RunDirectory directory(scratch / "a/b/c", ExistingOutput::refuse);
    CHECK(fs::exists(directory.paths().lock()));
  }
  CHECK_FALSE(fs::exists(scratch / "a"));
  {
    const RunDirectory directory(scratch / "a/b", ExistingOutput::refuse);
    put(directory.paths().stats(), "x");
  }
  CHECK(entries(scratch / "a/b") == 1);
}

TEST_CASE("existing output is refused, replaced or resumed as asked") {
  const ScratchFolder scratch;
  CHECK(code_of_opening(scratch / "none", ExistingOutput::resume) == ExitCode::bad_input);
  CHECK(code_of_opening(scratch.path(), ExistingOutput::resume) == ExitCode::bad_input);
  put(scratch / "scene.toml", "");
  CHECK(code_of_opening(scratch.path(), ExistingOutput::refuse) == ExitCode::bad_input);
  CHECK(code_of_opening(scratch.path(), ExistingOutput::resume) == ExitCode::done);
  CHECK(code_of_opening(scratch.path(), ExistingOutput::overwrite) == ExitCode::done);
  CHECK_FALSE(fs::exists(scratch / "scene.toml"));
}

TEST_CASE("overwriting removes the files of a run and nothing else") {
  const ScratchFolder scratch;
  for (const char* folder : {"frames", "checkpoints/00000010", "checkpoints/00000012.tmp", "mine"}) {
    fs::create_directories(scratch / folder);
  }
  for (const char* file :
       {"scene.toml", "stats.csv", "frames/frame.0001.vdb", "frames/solids.pvd", "frames/fluid.0003.vti.tmp",
        "frames/elastic.0002.vtu", "frames/elastic.pvd", "joints.csv", "frames/joints.0001.vtu", "frames/joints.pvd",
        "frames/ball.pc2", "frames/ball.obj", "frames/mine.obj", "checkpoints/00000010/COMMIT",
        "checkpoints/00000012.tmp/rank.00000", "notes.txt", "mine/stats.csv"}) {
    put(scratch / file, "x");
  }
  CHECK(code_of_opening(scratch.path(), ExistingOutput::overwrite) == ExitCode::done);
  CHECK(entries(scratch.path()) == 3);
  CHECK(entries(scratch / "frames") == 1);
  CHECK(fs::exists(scratch / "frames/mine.obj"));
  CHECK(fs::exists(scratch / "notes.txt"));
  CHECK(fs::exists(scratch / "mine/stats.csv"));
}

TEST_CASE("a folder that another job holds or that is a file is an output error") {
  const ScratchFolder scratch;
  put(scratch / "file", "x");
  CHECK(code_of_opening(scratch / "file", ExistingOutput::refuse) == ExitCode::output_failed);
  CHECK(code_of_opening(scratch / "file/sub", ExistingOutput::refuse) == ExitCode::output_failed);
  std::optional<RunDirectory> first;
  first.emplace(scratch / "run", ExistingOutput::refuse);
  CHECK(code_of_opening(scratch / "run", ExistingOutput::overwrite) == ExitCode::output_failed);
  CHECK(fs::exists(scratch / "run/lock"));
  first.reset();
  CHECK(code_of_opening(scratch / "run", ExistingOutput::refuse) == ExitCode::done);
}

}  // namespace run_directory_tests
