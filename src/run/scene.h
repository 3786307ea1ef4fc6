#pragma once
// The scene file kept in the run directory: permitted and actual changes before a resume.
#include <string>
#include <vector>

namespace seiche {

struct Scene;

// Hash of the normalised scene without the keys that may always change (time.end, output.checkpoint_every).
std::string scene_hash(const Scene& scene);

enum class EditPolicy { refuse, force };

// The changed keys that forbid resuming: all but time.end, output.checkpoint_every, [solver], time.cfl, time.max_step
// and time.fixed_step. `force` also permits output and probes.
std::vector<std::string> forbidden_changes(const std::vector<std::string>& changed, EditPolicy policy);

}  // namespace seiche
