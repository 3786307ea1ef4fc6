#include "files/checkpoint.h"

#include <fmt/format.h>

#include "base/agree.h"
#include "base/checkpoint_boxes.h"
#include "base/error.h"
#include "base/version.h"
#include "files/checked_file.h"
#include "files/checkpoint_commit.h"
#include "files/checkpoint_file.h"
#include "files/checkpoint_folders.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t checkpoints_kept = 2;
constexpr const char* writing = "writing a checkpoint";

// Lines of the COMMIT file from all ranks, by rank.
std::vector<CommittedFile> exchange(const CommittedFile& mine, const Communicator& ranks) {
  std::vector<CommittedFile> files;
  for (const std::string& text : ranks.all_gather(fmt::format("{} {}", mine.bytes, mine.checksum))) {
    CommittedFile file;
    file.name = checkpoint_rank_file(int(files.size()));
    file.bytes = std::stoull(text);
    file.checksum = std::uint32_t(std::stoul(text.substr(text.find(' '))));
    files.push_back(file);
  }
  return files;
}

void check_finite(const CheckpointData& data, const Communicator& ranks) {
  agree(ranks, writing, [&] {
    const std::string where = first_not_finite(data.fields);
    if (where.empty()) return;
    throw Error(ExitCode::cannot_continue,
                fmt::format("the state holds a value that is not a number: {}; the checkpoint "
                            "before it still stands",
                            where));
  });
}

CommittedFile write_own_file(const fs::path& folder, const CheckpointLabel& label, const CheckpointData& data,
                             const Communicator& ranks) {
  const CheckpointHeader header{label.dimension, ranks.rank(),     ranks.size(),
                                label.step,      label.scene_hash, "seiche " + version()};
  const std::string name = checkpoint_rank_file(ranks.rank());
  WrittenBytes written;
  write_file(folder / name, [&](const ByteSink& sink) { written = write_checkpoint_file(header, data, sink); });
  return {name, written.count, written.checksum};
}

}  // namespace

void write_checkpoint(const fs::path& folder, const CheckpointLabel& label, const CheckpointData& data,
                      const Communicator& ranks) {
  const fs::path final = folder / checkpoint_folder_name(label.step);
  const fs::path temporary = fs::path(final.string() + ".tmp");
  if (ranks.any(ranks.is_root() && fs::exists(final / "COMMIT"))) return;
  check_finite(data, ranks);
  const auto on_root = [&](const std::function<void()>& work) { agree_on_root(ranks, writing, work); };
  try {
    on_root([&] {
      remove_checkpoint(temporary);
      remove_checkpoint(final);
      make_folder(temporary);
    });
    CommittedFile mine;
    agree(ranks, writing, [&] { mine = write_own_file(temporary, label, data, ranks); });
    const Commit commit{checkpoint_format_version, label.step, exchange(mine, ranks)};
    on_root([&] {
      sync_folder(temporary);
      rename_durably(temporary, final);
      write_file(final / "COMMIT", format_commit(commit));
      remove_old_checkpoints(folder, checkpoints_kept);
    });
  } catch (const Error&) {
    if (ranks.is_root()) {
      remove_checkpoint(temporary);
      if (!fs::exists(final / "COMMIT")) remove_checkpoint(final);
    }
    throw;
  }
}

}  // namespace seiche
