// Wavefront OBJ: reads v and f lines. Indices count from 1, or backwards from the last point (-1).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/mesh/formats.h"

namespace seiche::mesh {
namespace {

constexpr std::array<std::string_view, 13> ignored{"vn",     "vt",     "vp",     "g",      "o", "s", "mg",
                                                   "usemtl", "mtllib", "usemap", "maplib", "l", "p"};

struct Reader {
  const Source& source;
  SurfaceMesh mesh;
  std::vector<std::size_t> lines{};  // line of each triangle, for messages about indices out of range
  std::size_t line = 0;
};

void read_point(Reader& reader, Tokens words) {
  Vec3 p;
  for (int a = 0; a < 3; ++a) {
    const std::string_view word = words.next();
    const std::optional<double> value = to_double(word);
    if (!value || !std::isfinite(*value)) {
      fail_at_line(reader.source, reader.line,
                   fmt::format("coordinate {} of the point is '{}'; give three finite numbers", a + 1, word));
    }
    p[a] = *value;
  }
  if (reader.mesh.points.size() == max_points) fail_at_line(reader.source, reader.line, "more than 2^31-1 points");
  reader.mesh.points.push_back(p);
}

// Reads "7", "7/1", "7//3" or "7/1/3" of a face as an index from 0.
int read_index(const Reader& reader, std::string_view word) {
  const std::optional<long long> number = to_integer(word.substr(0, word.find('/')));
  const long long points = (long long)(reader.mesh.points.size());
  if (!number || *number == 0 || *number > (long long)(max_points) || *number < -points) {
    fail_at_line(reader.source, reader.line,
                 fmt::format("'{}' is not a point; indices run from 1 (or back from -1 to -{})", word, points));
  }
  return int(*number > 0 ? *number - 1 : points + *number);
}

void read_face(Reader& reader, Tokens words) {
  std::vector<int> corners;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    corners.push_back(read_index(reader, word));
  }
  if (corners.size() < 3) {
    fail_at_line(reader.source, reader.line, fmt::format("a face of {} points; it takes 3 or more", corners.size()));
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    reader.mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    reader.lines.push_back(reader.line);
  }
}

void read_line(Reader& reader, std::string_view text) {
  Tokens words(text.substr(0, text.find('#')));
  const std::string_view key = words.next();
  if (key == "v") return read_point(reader, words);
  if (key == "f") return read_face(reader, words);
  if (key.empty() || std::find(ignored.begin(), ignored.end(), key) != ignored.end()) return;
  fail_at_line(
      reader.source, reader.line,
      fmt::format("'{}' is not a statement of OBJ polygons (v, f, vn, vt, g, o, s, usemtl, ...)", key.substr(0, 20)));
}

void require_known_points(const Reader& reader) {
  for (std::size_t t = 0; t < reader.mesh.triangles.size(); ++t) {
    const auto& corners = reader.mesh.triangles[t];
    const int worst = *std::max_element(corners.begin(), corners.end());
    if (worst < int(reader.mesh.points.size())) continue;
    fail_at_line(
        reader.source, reader.lines[t],
        fmt::format("the face uses point {}, but the file has {} points", worst + 1LL, reader.mesh.points.size()));
  }
}

}  // namespace

SurfaceMesh parse_obj(const Source& source) {
  Reader reader{source, {}};
  Tokens text(source.bytes);
  while (!text.at_end()) {
    reader.line = text.line();
    read_line(reader, text.rest_of_line());
  }
  require_known_points(reader);
  return std::move(reader.mesh);
}

}  // namespace seiche::mesh
