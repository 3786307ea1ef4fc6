#pragma once
// The checkpoints of a run: checkpoints/NNNNNNNN/ (the step) with one file a rank and a COMMIT file that lists their
// sizes and checksums. All functions are collective.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/checkpoint_data.h"
#include "base/communicator.h"

namespace seiche {

// What belongs to a checkpoint besides the state itself.
struct CheckpointLabel {
  std::int64_t step = 0;
  int dimension = 3;
  std::string scene_hash;
};

// Writes NNNNNNNN.tmp/, agrees, renames it and commits it; then removes all but the newest two. Does nothing when that
// step is committed already. Throws Error(output_failed) on all ranks; older checkpoints then still stand.
// Throws Error(cannot_continue) when a value is not a number, naming field and index.
void write_checkpoint(const std::filesystem::path& folder, const CheckpointLabel& label, const CheckpointData& data,
                      const Communicator& ranks);

struct FoundCheckpoint {
  std::filesystem::path folder;
  CheckpointLabel label;
  int ranks = 1;        // of the run that wrote it
  CheckpointData data;  // of its rank 0; scalars and texts hold for all
};

// The newest checkpoint whose files all verify; older ones are tried with a warning for each damaged one, and the
// damaged ones are removed. Throws Error(bad_checkpoint) when none is left, or when the newest intact one was written
// by another version or on another kind of machine.
FoundCheckpoint find_newest_checkpoint(const std::filesystem::path& folder, const Communicator& ranks,
                                       std::vector<std::string>& warnings);

// The state with the fields cut to the boxes asked for, from as many of the old ranks' files as that takes.
CheckpointData load_checkpoint(const FoundCheckpoint& found, const std::vector<FieldRecord>& boxes,
                               const Communicator& ranks);

}  // namespace seiche
