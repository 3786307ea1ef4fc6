#pragma once
// The COMMIT file: the list of a checkpoint's files, with a checksum over itself.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct CommittedFile {
  std::string name;
  std::uint64_t bytes = 0;
  std::uint32_t checksum = 0;
};

struct Commit {
  std::uint32_t format = 0;
  std::int64_t step = 0;
  std::vector<CommittedFile> files;  // by rank
};

std::string checkpoint_rank_file(int rank);             // "rank.00003"
std::string checkpoint_folder_name(std::int64_t step);  // "00000120"

std::string format_commit(const Commit& commit);
// Empty if the text is not a COMMIT file or does not match its own checksum.
std::optional<Commit> parse_commit(const std::string& text);

}  // namespace seiche
