#include "geometry/vdb/frame_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "base/crc32c.h"
#include "geometry/vdb/frame_checks.h"

namespace seiche::vdb {
namespace {

constexpr std::string_view magic(" BDV\0\0\0\0", 8);
constexpr std::string_view checksum_tag = "seiche crc32c ";
constexpr std::uint32_t format_version = 224;
constexpr std::size_t identifier_bytes = 36, transform_bytes = 18 * sizeof(double), longest_message = 200;

// Reads forward and never beyond the end: throws Error(bad_input) instead.
class Cursor {
 public:
  Cursor(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  std::size_t place() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }

  std::string_view take(std::size_t count, const char* what) {
    if (count > left()) {
      refuse(file_, fmt::format("is damaged or cut off: {} at byte {} would take {} bytes, {} are left", what, at_,
                                count, left()));
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  template <class Number>
  Number number(const char* what) {
    Number value;
    std::memcpy(&value, take(sizeof value, what).data(), sizeof value);
    return value;
  }

  std::string_view text(const char* what) { return take(number<std::uint32_t>(what), what); }

  void move_to(std::uint64_t place, const char* what) {
    if (place < at_ || place > bytes_.size()) {
      refuse(file_, fmt::format("is damaged: {} is said to be at byte {} of {}", what, place, bytes_.size()));
    }
    at_ = std::size_t(place);
  }

  [[noreturn]] void fail(const std::string& what) const { refuse(file_, what); }

 private:
  const std::filesystem::path& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

// Checks OpenVDB's table for delayed loading: the number of its entries (at least a byte each) and its packed size.
void check_delayed_load(Cursor value, std::size_t left_in_file) {
  if (value.left() < 2 * sizeof(std::uint32_t)) return;
  for (const char* what : {"the table for delayed loading", "its packed part"}) {
    const auto count = value.number<std::uint32_t>(what);
    if (count > left_in_file) value.fail(fmt::format("is damaged: {} would have {} entries", what, count));
  }
}

void check_metadata(const std::filesystem::path& file, Cursor& cursor) {
  const auto count = cursor.number<std::uint32_t>("the number of metadata");
  for (std::uint32_t i = 0; i < count; ++i) {
    cursor.text("the name of metadata");
    const std::string_view type = cursor.text("the type of metadata");
    const std::string_view value = cursor.text("the value of metadata");
    if (type == "__delayedload") check_delayed_load(Cursor(file, value), value.size() + cursor.left());
  }
}

// Checks a grid's header. Returns the position of its transform's numbers.
std::size_t check_grid(const std::filesystem::path& file, Cursor& cursor) {
  cursor.text("the name of a grid");
  cursor.text("the type of a grid");
  cursor.text("the parent of a grid");
  const auto begin = cursor.number<std::uint64_t>("the place of a grid"),
             blocks = cursor.number<std::uint64_t>("the place of its values"),
             end = cursor.number<std::uint64_t>("the end of a grid");
  cursor.move_to(begin, "a grid");
  cursor.number<std::uint32_t>("the compression of a grid");
  check_metadata(file, cursor);
  cursor.text("the type of a transform");
  const std::size_t transform = cursor.place();
  cursor.take(transform_bytes, "a transform");
  cursor.move_to(blocks, "the values of a grid");
  cursor.move_to(end, "the end of a grid");
  return transform;
}

std::vector<std::size_t> check_header(const std::filesystem::path& file, const std::string& bytes) {
  Cursor cursor(file, bytes);
  if (bytes.compare(0, magic.size(), magic) != 0) cursor.fail("is not a .vdb file");
  cursor.take(magic.size(), "the magic number");
  const auto version = cursor.number<std::uint32_t>("the version");
  if (version != format_version) {
    cursor.fail(
        fmt::format("is of version {} of the .vdb format; Seiche writes and reads {}", version, format_version));
  }
  cursor.take(2 * sizeof(std::uint32_t), "the version of the library");
  if (cursor.number<char>("the layout") != 1) cursor.fail("has no places of grids, so Seiche did not write it");
  cursor.take(identifier_bytes, "the identifier");
  check_metadata(file, cursor);
  const auto grids = cursor.number<std::uint32_t>("the number of grids");
  std::vector<std::size_t> transforms;
  for (std::uint32_t i = 0; i < grids; ++i) transforms.push_back(check_grid(file, cursor));
  return transforms;
}

}  // namespace

void require_sound_header(const std::filesystem::path& file, const std::string& bytes) {
  check_header(file, bytes);
}

std::string with_transforms(std::string bytes, const Vec3& first, double h) {
  std::array<double, 18> numbers{first[0], first[1], first[2]};
  const std::array<double, 5> scales{h, h, 1 / h, 1 / h * (1 / h), 1 / h / 2};
  for (std::size_t i = 3; i < numbers.size(); ++i) numbers[i] = scales[i / 3 - 1];
  static_assert(sizeof numbers == transform_bytes);
  for (const std::size_t place : check_header("the frame", bytes))
    std::memcpy(bytes.data() + place, numbers.data(), sizeof numbers);
  return bytes;
}

std::string with_checksum(std::string bytes) {
  const std::uint32_t checksum = crc32c(bytes);
  return std::move(bytes) + fmt::format("{}{:08x}", checksum_tag, checksum);
}

void require_checksum(const std::filesystem::path& file, const std::string& bytes) {
  constexpr std::size_t tail = checksum_tag.size() + 8;
  const std::string_view body(bytes.data(), bytes.size() - std::min(bytes.size(), tail));
  const std::string_view end = std::string_view(bytes).substr(body.size());
  if (!end.starts_with(checksum_tag))
    refuse(file, "does not end with the checksum of Seiche's frames: it is cut off, or was changed since");
  if (end.substr(checksum_tag.size()) != fmt::format("{:08x}", crc32c(body)))
    refuse(file, "is damaged: its bytes do not have the checksum that was written with them");
}

std::string readable_start(const std::string& message) {
  std::string start = message.substr(0, longest_message);
  std::replace_if(
      start.begin(), start.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return message.size() > longest_message ? start + " ..." : start;
}

}  // namespace seiche::vdb
