// Wavefront OBJ: reads v and f, or v and l lines. Indices count from 1, or backwards from the last point (-1).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "geometry/mesh/formats.h"

namespace seiche::mesh {
namespace {

constexpr std::array<std::string_view, 12> ignored{"vn", "vt",     "vp",     "g",      "o",      "s",
                                                   "mg", "usemtl", "mtllib", "usemap", "maplib", "p"};

struct Reader {
  const Source& source;
  bool wants_lines;  // else l is passed over
  SurfaceMesh mesh{};
  std::vector<std::size_t> lines{};          // line of each triangle, for messages about indices out of range
  std::vector<std::size_t> segment_lines{};  // line of each segment, likewise
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

std::vector<int> read_indices(const Reader& reader, Tokens words) {
  std::vector<int> corners;
  for (std::string_view word = words.next(); !word.empty(); word = words.next())
    corners.push_back(read_index(reader, word));
  return corners;
}

void read_polyline(Reader& reader, Tokens words) {
  const std::vector<int> points = read_indices(reader, words);
  if (points.size() < 2) fail_at_line(reader.source, reader.line, "a line of fewer than two points");
  for (std::size_t i = 1; i < points.size(); ++i) {
    reader.mesh.segments.push_back({points[i - 1], points[i]});
    reader.segment_lines.push_back(reader.line);
  }
}

void read_face(Reader& reader, Tokens words) {
  const std::vector<int> corners = read_indices(reader, words);
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
  if (key == "l" && reader.wants_lines) return read_polyline(reader, words);
  if (key.empty() || key == "l" || std::find(ignored.begin(), ignored.end(), key) != ignored.end()) return;
  fail_at_line(reader.source, reader.line,
               fmt::format("'{}' is not a statement of OBJ polygons (v, f, l, vn, vt, g, o, s, usemtl, ...)",
                           key.substr(0, 20)));
}

template <class Facets>
void require_known_points(const Reader& reader, const Facets& facets, const std::vector<std::size_t>& lines,
                          const char* what) {
  for (std::size_t t = 0; t < facets.size(); ++t) {
    const int worst = *std::max_element(facets[t].begin(), facets[t].end());
    if (worst < int(reader.mesh.points.size())) continue;
    fail_at_line(
        reader.source, lines[t],
        fmt::format("the {} uses point {}, but the file has {} points", what, worst + 1LL, reader.mesh.points.size()));
  }
}

Reader read_obj(const Source& source, bool wants_lines) {
  Reader reader{source, wants_lines};
  Tokens text(source.bytes);
  while (!text.at_end()) {
    reader.line = text.line();
    read_line(reader, text.rest_of_line());
  }
  require_known_points(reader, reader.mesh.triangles, reader.lines, "face");
  require_known_points(reader, reader.mesh.segments, reader.segment_lines, "line");
  return reader;
}

}  // namespace

SurfaceMesh parse_obj(const Source& source) {
  return read_obj(source, false).mesh;
}

SurfaceMesh parse_obj_lines(const Source& source) {
  SurfaceMesh mesh = read_obj(source, true).mesh;
  const auto fail = [&](const std::string& what) {
    throw Error(ExitCode::bad_input, source.file.string() + ": " + what);
  };
  if (mesh.segments.empty())
    fail(std::string("holds no lines (l)") + (mesh.triangles.empty() ? "" : ", but faces (f)") +
         "; an outline in 2D takes at least 3");
  for (const auto& ends : mesh.segments)
    for (const int p : ends)
      if (mesh.points[std::size_t(p)][2] != 0) fail("its lines leave the plane z = 0 of a 2D scene");
  mesh.triangles.clear();
  return mesh;
}

}  // namespace seiche::mesh
