// Finds and loads checkpoints.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/agree.h"
#include "base/checkpoint_boxes.h"
#include "base/crc32c.h"
#include "base/error.h"
#include "files/checked_file.h"
#include "files/checkpoint.h"
#include "files/checkpoint_commit.h"
#include "files/checkpoint_file.h"
#include "files/checkpoint_folders.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

std::optional<Commit> read_commit(const fs::path& folder) {
  try {
    return parse_commit(read_whole_file(folder / "COMMIT"));
  } catch (const Error&) {
    return std::nullopt;
  }
}

CheckpointDefect examine_file(const fs::path& folder, const CommittedFile& expected, std::int64_t step, int rank) {
  try {
    const std::string bytes = read_whole_file(folder / expected.name);
    CheckpointDefect defect = examine_checkpoint_file(bytes);
    if (defect.kind == CheckpointDefect::Kind::none) {
      const CheckpointFile file = decode_checkpoint_file(bytes);
      if (bytes.size() != expected.bytes || crc32c(bytes) != expected.checksum || file.header.rank != rank ||
          file.header.step != step) {
        defect = CheckpointDefect::damaged("it is not the file that COMMIT lists");
      }
    }
    if (!defect.text.empty()) defect.text = expected.name + ": " + defect.text;
    return defect;
  } catch (const Error& error) {
    return CheckpointDefect::damaged(expected.name + ": " + error.what());
  }
}

// Examines this rank's share of a checkpoint's files.
CheckpointDefect examine_share(const fs::path& folder, const Communicator& ranks) {
  const std::optional<Commit> commit = read_commit(folder);
  if (!commit) return CheckpointDefect::damaged("its COMMIT file is missing or damaged");
  if (std::string text = unknown_format(commit->format); !text.empty())
    return {CheckpointDefect::Kind::foreign, std::move(text)};
  for (int rank = ranks.rank(); rank < int(commit->files.size()); rank += ranks.size()) {
    CheckpointDefect defect = examine_file(folder, commit->files[std::size_t(rank)], commit->step, rank);
    if (defect.kind != CheckpointDefect::Kind::none) return defect;
  }
  return {};
}

// The worst defect found by any rank; the same on all of them.
CheckpointDefect examine(const fs::path& folder, const Communicator& ranks) {
  std::string mine;
  agree(ranks, "verifying a checkpoint", [&] {
    const CheckpointDefect defect = examine_share(folder, ranks);
    mine = fmt::format("{}{}", int(defect.kind), defect.text);
  });
  CheckpointDefect worst;
  for (const std::string& text : ranks.all_gather(mine)) {
    const auto kind = CheckpointDefect::Kind(text[0] - '0');
    if (kind > worst.kind) worst = {kind, text.substr(1)};
  }
  return worst;
}

std::vector<std::string> broadcast_names(const fs::path& folder, const Communicator& ranks) {
  std::string joined;
  if (ranks.is_root()) joined = fmt::format("{}", fmt::join(checkpoints_newest_first(folder), "\n"));
  joined = ranks.broadcast(joined);
  std::vector<std::string> names;
  for (std::size_t start = 0; start < joined.size();) {
    const std::size_t end = std::min(joined.find('\n', start), joined.size());
    names.push_back(joined.substr(start, end - start));
    start = end + 1;
  }
  return names;
}

CheckpointFile read_rank_file(const fs::path& folder, int rank) {
  const fs::path path = folder / checkpoint_rank_file(rank);
  try {
    return decode_checkpoint_file(read_whole_file(path));
  } catch (const Error& error) {
    throw Error(ExitCode::bad_checkpoint, fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace

FoundCheckpoint find_newest_checkpoint(const fs::path& folder, const Communicator& ranks,
                                       std::vector<std::string>& warnings) {
  std::vector<fs::path> unusable;
  for (const std::string& name : broadcast_names(folder, ranks)) {
    const CheckpointDefect defect = examine(folder / name, ranks);
    if (defect.kind == CheckpointDefect::Kind::foreign) {
      throw Error(ExitCode::bad_checkpoint,
                  fmt::format("{} cannot be used: {}", (folder / name).string(), defect.text));
    }
    if (defect.kind == CheckpointDefect::Kind::damaged) {
      warnings.push_back(fmt::format("checkpoint {} is not usable, trying the one before: {}", name, defect.text));
      unusable.push_back(folder / name);
      continue;
    }
    FoundCheckpoint found;
    found.folder = folder / name;
    agree(ranks, "reading a checkpoint", [&] {
      CheckpointFile first = read_rank_file(found.folder, 0);
      found.label = {first.header.step, first.header.dimension, first.header.scene_hash};
      found.ranks = first.header.ranks;
      found.data = std::move(first.data);
    });
    if (ranks.is_root()) std::for_each(unusable.begin(), unusable.end(), remove_checkpoint);
    ranks.barrier();
    return found;
  }
  throw Error(ExitCode::bad_checkpoint,
              fmt::format("{} holds no usable checkpoint{}; start the run again with --overwrite", folder.string(),
                          warnings.empty() ? "" : " (" + warnings.front() + ")"));
}

CheckpointData load_checkpoint(const FoundCheckpoint& found, const std::vector<FieldRecord>& boxes,
                               const Communicator& ranks) {
  CheckpointData data{found.data.scalars, found.data.texts, {}};
  agree(ranks, "loading a checkpoint", [&] {
    BoxFiller filler(boxes);
    // With an unchanged number of ranks, the first file already holds everything.
    for (int n = 0; n < found.ranks && (n == 0 || !filler.complete()); ++n) {
      const CheckpointFile file = read_rank_file(found.folder, (ranks.rank() + n) % found.ranks);
      for (const FieldRecord& field : file.data.fields) filler.take(field);
    }
    if (!filler.complete()) {
      const std::string field = filler.first_incomplete();
      const char* remedy =
          field == "liquid" ? ": its run kept the volume by a shift; add --set liquid.volume=shift" : "";
      throw Error(ExitCode::bad_checkpoint, fmt::format("{} does not hold all of the field {} of this grid{}",
                                                        found.folder.string(), field, remedy));
    }
    data.fields = std::move(filler).result();
  });
  return data;
}

}  // namespace seiche
