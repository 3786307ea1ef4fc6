#pragma once
// The scene of a run as it is kept beside the run: what may change before it is resumed, and what changed.
#include <string>
#include <vector>

#include "base/scene.h"

namespace seiche {

// Of the normalised scene without the keys that a resume may always change (time.end, output.checkpoint_every).
std::string scene_hash(const Scene& scene);

enum class EditPolicy { refuse, force };

// Which of these changed keys stand in the way of resuming: all but time.end, output.checkpoint_every, [solver],
// time.cfl, time.max_step and time.fixed_step; forcing lets output and probes pass, too.
std::vector<std::string> forbidden_changes(const std::vector<std::string>& changed, EditPolicy policy);

}  // namespace seiche
