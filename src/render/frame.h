#pragma once
// The parts of a run's frame that a picture needs.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/bvh.h"
#include "render/fields.h"

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
  std::optional<FaceVelocity> velocity;
  SolidMesh solids;
  std::vector<vdb::Point> drops;
};

// Parts that not every picture needs.
struct FrameWants {
  std::string quantity = "none";  // or a name for quantity_of()
  std::string velocity;           // the option that needs it; empty: none does
};

// Reads frames/frame.NNNN.vdb and, if present, frames/solids.NNNN.vtu. Throws Error(bad_input) where the frame lacks
// what is wanted.
LoadedFrame load_frame(const std::filesystem::path& frames, int number, const FrameWants& wants);

// Numbers of the frames in the folder, ascending.
std::vector<int> list_frames(const std::filesystem::path& frames);

// Removes the liquid inside inverted solids (containers). The level set continues into solids, and containers are drawn
// without their outside.
void clip_to_containers(LoadedFrame& frame, const std::vector<SolidSpec>& solids);

}  // namespace seiche::render
