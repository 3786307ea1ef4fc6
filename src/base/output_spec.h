#pragma once
// The table [output] of a scene.
#include <string>
#include <vector>

namespace seiche {

struct OutputSpec {
  std::vector<std::string> frames{"surface", "velocity"};
  std::vector<std::string> formats{"vdb"};
  std::string surface = "closed";     // the level set of frames; "free": open at walls, continued into solids
  std::string velocity_name = "vel";  // of that grid in .vdb files; "velocity"
  std::string up = "scene";           // axis that points up in files of `seiche export`; "y", "z"
  int checkpoint_every = 10;          // frames
};

}  // namespace seiche
