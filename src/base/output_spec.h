#pragma once
// The table [output] of a scene.
#include <string>
#include <vector>

namespace seiche {

struct OutputSpec {
  std::vector<std::string> frames{"surface", "velocity"};
  std::vector<std::string> formats{"vdb"};
  std::string surface = "closed";  // the level set of frames; "free": open at walls, continued into solids
  int checkpoint_every = 10;       // frames
};

}  // namespace seiche
