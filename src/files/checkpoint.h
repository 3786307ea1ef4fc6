#pragma once
// Checkpoints of a run: checkpoints/NNNNNNNN/ (the step) with one file a rank and a COMMIT file with their sizes and
// checksums. All functions are collective.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/checkpoint_data.h"
#include "base/communicator.h"

namespace seiche {

// Identification of a checkpoint, besides the state itself.
struct CheckpointLabel {
  std::int64_t step = 0;
  int dimension = 3;
  std::string scene_hash;
};

// Writes NNNNNNNN.tmp/, makes sure that all ranks succeeded, renames it and commits it; then removes all but the newest
// two. Does nothing if that step is committed already. Throws on all ranks: Error(output_failed), older checkpoints
// then remain; Error(cannot_continue) naming field and index if a value is not finite.
void write_checkpoint(const std::filesystem::path& folder, const CheckpointLabel& label, const CheckpointData& data,
                      const Communicator& ranks);

struct FoundCheckpoint {
  std::filesystem::path folder;
  CheckpointLabel label;
  int ranks = 1;        // of the run that wrote the checkpoint
  CheckpointData data;  // of the writing run's rank 0; scalars and texts hold for all ranks
};

// Finds the newest checkpoint with intact files. Damaged ones are skipped with a warning each and removed. Throws
// Error(bad_checkpoint) if none is left, or if the newest intact one is from another version or kind of machine.
FoundCheckpoint find_newest_checkpoint(const std::filesystem::path& folder, const Communicator& ranks,
                                       std::vector<std::string>& warnings);

// The state with fields cut to the requested boxes; reads only as many of the old ranks' files as needed.
CheckpointData load_checkpoint(const FoundCheckpoint& found, const std::vector<FieldRecord>& boxes,
                               const Communicator& ranks);

}  // namespace seiche
