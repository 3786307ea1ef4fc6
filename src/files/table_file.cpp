#include "files/table_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string_view>
#include <vector>

#include "base/crc32c.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

// Passes the first bytes of the file to `take` in pieces; returns their number.
std::uint64_t read_start(const fs::path& path, std::uint64_t bytes, const std::function<void(std::string_view)>& take) {
  constexpr std::uint64_t piece = 1 << 20;
  std::ifstream in(path, std::ios::binary);
  std::vector<char> buffer(std::size_t(std::min(bytes, piece)));
  std::uint64_t done = 0;
  while (in && done < bytes) {
    in.read(buffer.data(), std::streamsize(std::min(bytes - done, piece)));
    take({buffer.data(), std::size_t(in.gcount())});
    done += std::uint64_t(in.gcount());
  }
  return done;
}

std::uint32_t checksum_of_start(const fs::path& path, std::uint64_t bytes) {
  std::uint32_t sum = 0;
  read_start(path, bytes, [&](std::string_view part) { sum = crc32c(part, sum); });
  return sum;
}

}  // namespace

TableFile::TableFile(const fs::path& path, std::uint64_t keep, const std::string& header)
    : file_(path, keep), checksum_(checksum_of_start(path, file_.size())) {
  if (file_.size() == 0) append(header);
  flush();
}

void TableFile::append(const std::string& text) {
  file_.append(text);
  checksum_ = crc32c(text, checksum_);
}

std::string fault_of_table(const fs::path& path, const TableMark& mark) {
  std::error_code error;
  if (!fs::exists(path, error)) return fmt::format("{} is missing", path.string());
  if (!fs::is_regular_file(path, error)) return {};  // a device stores nothing to compare
  std::uint32_t sum = 0;
  const std::uint64_t there = read_start(path, mark.bytes, [&](std::string_view part) { sum = crc32c(part, sum); });
  if (there < mark.bytes)
    return fmt::format("{} has {} bytes where the run had written {}", path.string(), there, mark.bytes);
  if (mark.checksum && sum != *mark.checksum)
    return fmt::format("{} is not as the run had written it (its checksum differs)", path.string());
  return {};
}

std::uint64_t whole_lines(const fs::path& path, std::uint64_t most) {
  std::uint64_t at = 0, end = 0;
  read_start(path, most, [&](std::string_view part) {
    const std::size_t last = part.rfind('\n');
    if (last != std::string_view::npos) end = at + last + 1;
    at += part.size();
  });
  return end;
}

}  // namespace seiche
