#include "files/point_cache.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>

#include "files/checked_file.h"

namespace seiche::point_cache {
namespace {

static_assert(std::endian::native == std::endian::little, "PC2 files are little-endian");

// 32-byte header of a PC2 file.
struct Header {
  std::array<char, 12> magic{'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', '\0'};
  std::int32_t version = 1;
  std::int32_t points = 0;
  float start = 0;  // frame of the first sample
  float rate = 1;   // frames per sample
  std::int32_t samples = 0;
};
static_assert(sizeof(Header) == 32);

std::uint64_t sample_bytes(const Header& h) {
  return std::uint64_t(h.points) * 3 * sizeof(float);
}

std::optional<Header> read_header(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Header h;
  if (!in.read(reinterpret_cast<char*>(&h), sizeof h)) return std::nullopt;
  const bool is_ours = h.magic == Header{}.magic && h.version == 1 && h.rate == 1 && h.start >= 0;
  return is_ours ? std::optional(h) : std::nullopt;
}

// Header of a usable cache: it has these points and all samples from its start up to, but not including, frame
// `number`.
std::optional<Header> usable_header(const std::filesystem::path& file, int number, std::size_t points) {
  const std::optional<Header> found = read_header(file);
  if (!found || found->points != std::int32_t(points)) return std::nullopt;
  const Header& h = *found;
  if (!(h.start <= float(number)) || h.samples < number - int(h.start)) return std::nullopt;
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  const std::uint64_t wanted = sizeof h + sample_bytes(h) * std::uint64_t(number - int(h.start));
  return error || size < wanted ? std::nullopt : found;
}

std::string bytes_of(const std::vector<Vec3>& points) {
  std::vector<float> numbers;
  for (const Vec3& x : points) numbers.insert(numbers.end(), {float(x[0]), float(x[1]), float(x[2])});
  std::string bytes(numbers.size() * sizeof(float), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::string bytes_of(const Header& header) {
  std::string bytes(sizeof header, '\0');
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

}  // namespace

std::vector<std::string> stems(const std::vector<std::string>& names) {
  std::vector<std::string> stems;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    std::string stem = name.substr(0, 200);
    for (char& c : stem) {
      const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.';
      if (!plain) c = '_';
    }
    if (stem[0] == '.') stem[0] = '_';
    while (!taken.insert(stem).second) stem += '_';
    stems.push_back(stem);
  }
  return stems;
}

std::string rest_surface(const VolumeFrame& solid, const SurfaceMesh& surface) {
  std::string text = "# surface at rest; its .pc2 has the same points in each frame\n";
  for (const int node : solid.surface_nodes) {
    const Vec3& x = solid.rest[std::size_t(node)];
    text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
  }
  for (const auto& [a, b, c] : surface.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  for (const auto& [a, b] : surface.segments) text += fmt::format("l {} {}\n", a + 1, b + 1);
  return text;
}

std::vector<Vec3> surface_points(const VolumeFrame& solid) {
  std::vector<Vec3> points;
  for (const int node : solid.surface_nodes)
    points.push_back(solid.rest[std::size_t(node)] + solid.displacement[std::size_t(node)]);
  return points;
}

std::optional<Facts> read_facts(const std::filesystem::path& file) {
  const std::optional<Header> header = read_header(file);
  if (!header) return std::nullopt;
  return Facts{header->points, header->samples, int(header->start)};
}

void add_sample(const std::filesystem::path& file, int number, const std::vector<Vec3>& points) {
  const std::optional<Header> found = usable_header(file, number, points.size());
  Header header = found.value_or(Header{});
  header.points = std::int32_t(points.size());
  if (!found) {
    header.start = float(number);
    header.samples = 1;
    return write_file(file, bytes_of(header) + bytes_of(points));
  }
  const int earlier = number - int(header.start);
  // The header never counts samples that are not in the file.
  if (header.samples > earlier) {
    header.samples = earlier;
    overwrite_start(file, bytes_of(header));
  }
  AppendFile cache(file, sizeof header + sample_bytes(header) * std::uint64_t(earlier));
  cache.append(bytes_of(points));
  cache.sync();
  header.samples = earlier + 1;
  overwrite_start(file, bytes_of(header));
}

}  // namespace seiche::point_cache
