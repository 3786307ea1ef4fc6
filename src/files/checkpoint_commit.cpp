#include "files/checkpoint_commit.h"

#include <fmt/format.h>

#include <sstream>

#include "base/crc32c.h"

namespace seiche {

std::string checkpoint_rank_file(int rank) {
  return fmt::format("rank.{:05d}", rank);
}
std::string checkpoint_folder_name(std::int64_t step) {
  return fmt::format("{:08d}", step);
}

std::string format_commit(const Commit& commit) {
  std::string text = fmt::format("seiche-checkpoint {}\nstep {}\n", commit.format, commit.step);
  for (const CommittedFile& file : commit.files) {
    text += fmt::format("file {} {} {:08x}\n", file.name, file.bytes, file.checksum);
  }
  return text + fmt::format("crc32c {:08x}\n", crc32c(text));
}

std::optional<Commit> parse_commit(const std::string& text) {
  const std::size_t last = text.rfind("crc32c ");
  if (last == std::string::npos || text.substr(last) != fmt::format("crc32c {:08x}\n", crc32c(text.substr(0, last)))) {
    return std::nullopt;
  }
  std::istringstream in(text.substr(0, last));
  Commit commit;
  std::string word;
  if (!(in >> word >> commit.format) || word != "seiche-checkpoint") return std::nullopt;
  if (!(in >> word >> commit.step) || word != "step") return std::nullopt;
  CommittedFile file;
  while (in >> word >> file.name >> file.bytes >> std::hex >> file.checksum >> std::dec) commit.files.push_back(file);
  if (commit.files.empty()) return std::nullopt;
  return commit;
}

}  // namespace seiche
