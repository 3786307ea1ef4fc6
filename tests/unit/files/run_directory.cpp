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
  put(scratch / "log.txt", "");
  CHECK(code_of_opening(scratch.path(), ExistingOutput::overwrite) == ExitCode::done);
  CHECK_FALSE(fs::exists(scratch / "scene.toml"));
}

TEST_CASE("overwriting removes the files of a run and nothing else") {
  const ScratchFolder scratch;
  for (const char* folder : {"frames", "checkpoints/00000010", "checkpoints/00000012.tmp", "mine"}) {
    fs::create_directories(scratch / folder);
  }
  for (const char* file : {"scene.toml", "stats.csv", "frames/frame.0001.vdb", "frames/solids.pvd",
                           "frames/fluid.0003.vti.tmp", "frames/elastic.0002.vtu", "frames/elastic.pvd", "joints.csv",
                           "frames/joints.0001.vtu", "frames/joints.pvd", "frames/ball.pc2", "frames/ball.obj",
                           "frames/mine.obj", "checkpoints/00000010/COMMIT", "checkpoints/00000012.tmp/rank.00000",
                           "pictures/frame.0001.png", "pictures/poster.png", "notes.txt", "mine/stats.csv"}) {
    fs::create_directories((scratch / file).parent_path());
    put(scratch / file, "x");
  }
  CHECK(code_of_opening(scratch.path(), ExistingOutput::overwrite) == ExitCode::done);
  CHECK(entries(scratch.path()) == 4);
  CHECK(fs::exists(scratch / "pictures/poster.png"));
  CHECK_FALSE(fs::exists(scratch / "pictures/frame.0001.png"));
  CHECK(entries(scratch / "frames") == 1);
  CHECK(fs::exists(scratch / "frames/mine.obj"));
  CHECK(fs::exists(scratch / "notes.txt"));
  CHECK(fs::exists(scratch / "mine/stats.csv"));
}

TEST_CASE("a folder with a stranger's scene is not overwritten") {
  const ScratchFolder scratch;
  put(scratch / "scene.toml", "# by hand");
  put(scratch / "notes.txt", "x");
  CHECK(code_of_opening(scratch.path(), ExistingOutput::overwrite) == ExitCode::bad_input);
  CHECK(fs::exists(scratch / "scene.toml"));
  fs::remove(scratch / "scene.toml");
  CHECK(code_of_opening(scratch.path(), ExistingOutput::overwrite) == ExitCode::done);
  CHECK(fs::exists(scratch / "notes.txt"));
}

TEST_CASE("what overwriting removes is told before it goes") {
  const ScratchFolder scratch;
  for (const char* folder : {"frames", "checkpoints/00000010", "pictures"}) fs::create_directories(scratch / folder);
  for (const char* file : {"scene.toml", "frames/frame.0000.vdb", "frames/frame.0001.vdb", "frames/solids.0000.vtu",
                           "checkpoints/00000010/COMMIT", "checkpoints/00000010/rank.00000", "pictures/frame.0000.png"})
    put(scratch / file, "12345");
  put(scratch / "stats.csv", "step,time,dt\n0,0,0\n7,0.25,0.1\n8,0.5");
  RunContents told;
  bool was_there = false;
  {
    const RunDirectory directory(scratch.path(), ExistingOutput::overwrite, [&](const RunContents& held) {
      told = held;
      was_there = fs::exists(scratch / "frames/frame.0001.vdb");
    });
  }
  CHECK(was_there);
  CHECK_FALSE(fs::exists(scratch / "frames"));
  CHECK((told.frames == 2 && told.checkpoints == 1 && told.pictures == 1 && told.files == 8));
  CHECK(told.time == 0.25);  // the last row was cut off
  CHECK(told.bytes == 7 * 5 + 35);
  CHECK(describe_contents(told) == "2 frames to t = 0.25 s, 1 checkpoint, 1 picture; 8 files, 0.07 kB");
  told = {};
  const RunDirectory empty(scratch.path(), ExistingOutput::overwrite, [&](const RunContents& held) { told = held; });
  CHECK(told.files == 0);
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
