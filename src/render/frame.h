#pragma once
// The parts of a run's frame that a picture needs.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vdb/openvdb_adapter.h"
#include "render/bvh.h"

namespace seiche {
struct SolidSpec;
}

namespace seiche::render {

struct LoadedFrame {
  int dimension = 3, number = 0;
  double time = 0;
  Box domain;
  std::optional<ScalarVolume> phi;       // the level set; unset if the frame holds none
  std::optional<ScalarVolume> quantity;  // shown in false colours
  SolidMesh solids;
};

// Reads frames/frame.NNNN.vdb and, if present, frames/solids.NNNN.vtu. `quantity` is "none", "speed", or the name of a
// grid (the length for vectors). Throws Error(bad_input); for an unknown quantity it lists the available ones.
LoadedFrame load_frame(const std::filesystem::path& frames, int number, const std::string& quantity);

// Level set of a decoded frame, if any, and a quantity of it at cell centres.
std::optional<ScalarVolume> level_set_of(const vdb::Frame& frame);
ScalarVolume quantity_of(const vdb::Frame& frame, const std::string& quantity);

// "speed m/s"; only the name if the unit is unknown.
std::string label_of(const std::string& quantity);

// Numbers of the frames in the folder, ascending.
std::vector<int> list_frames(const std::filesystem::path& frames);

// Removes the liquid inside inverted solids (containers). The level set continues into solids, and containers are drawn
// without their outside.
void clip_to_containers(LoadedFrame& frame, const std::vector<SolidSpec>& solids);

}  // namespace seiche::render
