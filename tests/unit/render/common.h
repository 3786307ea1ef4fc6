#pragma once
// Run directories and messages for the tests of pictures and plots.
#include <catch2/catch.hpp>

#include <filesystem>
#include <functional>
#include <string>

#include "base/error.h"
#include "files/checked_file.h"
#include "geometry/vdb/openvdb_adapter.h"
#include "unit/files/scratch.h"

namespace seiche::testing {

// A folder with frames/, removed at the end of the test.
struct ScratchRun {
  ScratchFolder scratch;
  std::filesystem::path folder = scratch.path();
  ScratchRun() { std::filesystem::create_directories(folder / "frames"); }
};

inline void silent(const std::string&) {}

// The message with which an action ends for bad input, "" if it does not.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::bad_input);
    return error.what();
  }
  return "";
}

// Gives a frame the grids `surface` and `vel`, each of one block.
inline void set_grids(vdb::Grid surface, const vdb::Block& distances, const vdb::Block& velocities, vdb::Frame& frame) {
  surface.blocks.push_back(distances);
  vdb::Grid velocity;
  velocity.name = "vel";
  velocity.kind = vdb::GridKind::staggered_vector;
  velocity.blocks.push_back(velocities);
  frame.grids = {std::move(surface), std::move(velocity)};
}

inline void store(const ScratchRun& run, const vdb::Frame& frame) {
  write_file(run.folder / "frames" / ("frame.000" + std::to_string(frame.number) + ".vdb"), vdb::encode(frame));
}

}  // namespace seiche::testing
