#include "geometry/mesh/polyline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "geometry/mesh/exact_orientation.h"
#include "geometry/mesh/extent.h"
#include "geometry/mesh/formats.h"
#include "geometry/mesh/intersections.h"
#include "geometry/mesh/topology.h"

namespace seiche {
namespace mesh {
namespace {

using Segment = std::array<int, 2>;
constexpr int across = 2;  // the axis that the plane of the polylines is seen along

[[noreturn]] void refuse_outline(const std::string& message) {
  throw Error(ExitCode::bad_input, message);
}

std::string spot(const Vec3& p) {
  return fmt::format("({:g}, {:g})", p[0], p[1]);
}

SurfaceMesh parse_polylines(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char ch) { return char(std::tolower(ch)); });
  const Source source{file, read_bytes(file)};
  return ending == ".obj" ? parse_obj_lines(source) : parse_rows_of_points(source);
}

void drop_lines_without_length(SurfaceMesh& mesh, std::vector<std::string>& notes) {
  const std::size_t dropped = std::erase_if(mesh.segments, [](const Segment& s) { return s[0] == s[1]; });
  if (dropped > 0) notes.push_back(fmt::format("dropped {} lines without length", dropped));
  if (mesh.segments.size() < 3) refuse_outline("fewer than 3 lines enclose no area");
}

// The segments at each point. Throws where there are not two.
std::vector<std::array<int, 2>> segments_at_points(const SurfaceMesh& mesh) {
  std::vector<int> count(mesh.points.size(), 0);
  std::vector<std::array<int, 2>> at(mesh.points.size(), {-1, -1});
  for (std::size_t s = 0; s < mesh.segments.size(); ++s)
    for (const int p : mesh.segments[s]) {
      if (count[std::size_t(p)] < 2) at[std::size_t(p)][std::size_t(count[std::size_t(p)])] = int(s);
      ++count[std::size_t(p)];
    }
  const auto is_end = [](int n) { return n == 1; };
  const auto is_knot = [](int n) { return n > 2; };
  const auto place_of = [&](auto wanted) {
    return spot(mesh.points[std::size_t(std::find_if(count.begin(), count.end(), wanted) - count.begin())]);
  };
  if (const auto ends = std::count_if(count.begin(), count.end(), is_end); ends > 0)
    refuse_outline(fmt::format("the outline is not closed, it has {} open ends, the first at {}; join them", ends,
                               place_of(is_end)));
  if (const auto knots = std::count_if(count.begin(), count.end(), is_knot); knots > 0)
    refuse_outline(fmt::format("more than two lines meet at {} points, the first {}; separate the outlines there",
                               knots, place_of(is_knot)));
  return at;
}

std::string named_line(const SurfaceMesh& mesh, int s) {
  const Segment& ends = mesh.segments[std::size_t(s)];
  return spot(mesh.points[std::size_t(ends[0])]) + " to " + spot(mesh.points[std::size_t(ends[1])]);
}

void require_no_crossing(const SurfaceMesh& mesh) {
  const auto pairs = crossing_segments(mesh);
  if (pairs.empty()) return;
  refuse_outline(fmt::format("the outline crosses or touches itself in {} pairs of lines, the first {} and {}",
                             pairs.size(), named_line(mesh, pairs[0][0]), named_line(mesh, pairs[0][1])));
}

// Lets the segments of the loop that begins with segment `seed` follow each other. Returns them in their order.
std::vector<int> follow(SurfaceMesh& mesh, const std::vector<std::array<int, 2>>& at, int seed) {
  std::vector<int> loop;
  int s = seed;
  do {
    loop.push_back(s);
    const int end = mesh.segments[std::size_t(s)][1];
    const auto& two = at[std::size_t(end)];
    s = two[0] == s ? two[1] : two[0];
    Segment& next = mesh.segments[std::size_t(s)];
    if (next[0] != end) std::swap(next[0], next[1]);
  } while (s != seed);
  return loop;
}

double doubled_area(const SurfaceMesh& mesh, const std::vector<int>& loop) {
  const Vec3& o = mesh.points[std::size_t(mesh.segments[std::size_t(loop[0])][0])];
  double sum = 0;
  for (const int s : loop) {
    const Vec3 a = mesh.points[std::size_t(mesh.segments[std::size_t(s)][0])] - o,
               b = mesh.points[std::size_t(mesh.segments[std::size_t(s)][1])] - o;
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

// True if the ray from x along the first axis crosses a segment. Corners count with the segment above them.
bool meets_ray(const Vec3& a, const Vec3& b, const Vec3& x) {
  const bool up = a[1] <= x[1] && x[1] < b[1], down = b[1] <= x[1] && x[1] < a[1];
  return (up && orientation(a, b, x, across) > 0) || (down && orientation(a, b, x, across) < 0);
}

bool encloses(const SurfaceMesh& mesh, const std::vector<int>& loop, const Vec3& x) {
  bool inside = false;
  for (const int s : loop) {
    const Segment& ends = mesh.segments[std::size_t(s)];
    inside ^= meets_ray(mesh.points[std::size_t(ends[0])], mesh.points[std::size_t(ends[1])], x);
  }
  return inside;
}

// Outer loops run counter-clockwise, holes clockwise. No two loops meet.
void orient_loops(SurfaceMesh& mesh) {
  const auto at = segments_at_points(mesh);
  require_no_crossing(mesh);
  std::vector<std::vector<int>> loops;
  std::set<int> known;
  for (int s = 0; s < int(mesh.segments.size()); ++s) {
    if (known.contains(s)) continue;
    loops.push_back(follow(mesh, at, s));
    known.insert(loops.back().begin(), loops.back().end());
  }
  for (const std::vector<int>& loop : loops) {
    const Vec3& x = mesh.points[std::size_t(mesh.segments[std::size_t(loop[0])][0])];
    bool hole = false;
    for (const std::vector<int>& other : loops) hole ^= &other != &loop && encloses(mesh, other, x);
    if ((doubled_area(mesh, loop) > 0) != hole) continue;
    for (const int s : loop) std::swap(mesh.segments[std::size_t(s)][0], mesh.segments[std::size_t(s)][1]);
  }
}

// A segment's ends along the axis of a sweep, and across it.
struct Reach {
  int segment;
  double from, to, low, high;
};

std::vector<Reach> reaches_of(const SurfaceMesh& mesh) {
  Vec3 lower = mesh.points.front(), upper = lower;
  for (const Vec3& p : mesh.points) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  const int along = upper[0] - lower[0] >= upper[1] - lower[1] ? 0 : 1;
  std::vector<Reach> reaches;
  for (std::size_t s = 0; s < mesh.segments.size(); ++s) {
    const Vec3 &a = mesh.points[std::size_t(mesh.segments[s][0])], &b = mesh.points[std::size_t(mesh.segments[s][1])];
    const auto [from, to] = std::minmax(a[along], b[along]);
    const auto [low, high] = std::minmax(a[1 - along], b[1 - along]);
    reaches.push_back({int(s), from, to, low, high});
  }
  std::sort(reaches.begin(), reaches.end(),
            [](const Reach& a, const Reach& b) { return std::pair(a.from, a.segment) < std::pair(b.from, b.segment); });
  return reaches;
}

// True if two segments from one point lie on each other.
bool folds_back(const SurfaceMesh& mesh, int shared, int p, int q) {
  const Vec3 &o = mesh.points[std::size_t(shared)], &a = mesh.points[std::size_t(p)], &b = mesh.points[std::size_t(q)];
  return orientation(o, a, b, across) == 0 && (a - o).dot(b - o) > 0;
}

bool cross(const SurfaceMesh& mesh, const Segment& s, const Segment& t) {
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (s[std::size_t(i)] == t[std::size_t(j)])
        return folds_back(mesh, s[std::size_t(i)], s[std::size_t(1 - i)], t[std::size_t(1 - j)]);
  return segments_meet_in_plane(mesh.points[std::size_t(s[0])], mesh.points[std::size_t(s[1])],
                                mesh.points[std::size_t(t[0])], mesh.points[std::size_t(t[1])], across);
}

SurfaceMesh as_flat_triangles(SurfaceMesh mesh) {
  for (const auto& [a, b] : mesh.segments) mesh.triangles.push_back({a, b, b});
  return mesh;
}

}  // namespace

// A sweep: segments are compared with those before them that end no earlier than they begin.
std::vector<std::array<int, 2>> crossing_segments(const SurfaceMesh& mesh) {
  std::vector<std::array<int, 2>> found;
  std::vector<Reach> open;
  for (const Reach& next : reaches_of(mesh)) {
    std::erase_if(open, [&](const Reach& r) { return r.to < next.from; });
    for (const Reach& r : open) {
      if (r.high < next.low || next.high < r.low) continue;
      const auto [s, t] = std::minmax(r.segment, next.segment);
      if (cross(mesh, mesh.segments[std::size_t(s)], mesh.segments[std::size_t(t)])) found.push_back({s, t});
    }
    open.push_back(next);
  }
  std::sort(found.begin(), found.end());
  return found;
}

PolylineDistance::PolylineDistance(SurfaceMesh polylines)
    : mesh_(as_flat_triangles(std::move(polylines))), nearest_(mesh_) {}

double PolylineDistance::operator()(const Vec3& x) const {
  bool inside = false;
  nearest_.visit_line(x, 0, [&](const std::array<Vec3, 3>& t) { inside ^= meets_ray(t[0], t[1], x); });
  const double distance = nearest_.distance(x, INFINITY);
  return inside ? -distance : distance;
}

}  // namespace mesh

SurfaceMesh read_closed_polylines(const std::filesystem::path& file, std::vector<std::string>& notes) {
  SurfaceMesh mesh = mesh::parse_polylines(file);
  std::vector<std::string> found;
  try {
    mesh::weld(mesh);
    mesh::drop_lines_without_length(mesh, found);
    mesh::orient_loops(mesh);
  } catch (const Error& e) {
    throw Error(e.code(), file.string() + ": " + e.what());
  }
  for (const std::string& note : found) notes.push_back(file.string() + ": " + note);
  return mesh;
}

SurfaceMesh close_polyline(const std::vector<Vec3>& corners) {
  SurfaceMesh mesh;
  mesh.points = corners;
  for (int n = 0; n < int(corners.size()); ++n) mesh.segments.push_back({n, (n + 1) % int(corners.size())});
  mesh::weld(mesh);
  std::vector<std::string> unheard;
  mesh::drop_lines_without_length(mesh, unheard);
  mesh::orient_loops(mesh);
  return mesh;
}

Vec3 polyline_extent(const std::filesystem::path& file) {
  const SurfaceMesh mesh = mesh::parse_polylines(file);
  Vec3 lower = mesh.points.front(), upper = lower;
  for (const Vec3& p : mesh.points) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  return upper - lower;
}

}  // namespace seiche
