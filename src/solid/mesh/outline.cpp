#include "solid/mesh/outline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace seiche {
namespace {

constexpr double corner_turn = 40 * 3.14159265358979323846 / 180;

// Points of a closed loop in order, and the arc length to each from the first; the last entry is the total.
struct Loop {
  std::vector<Vec3> points;
  std::vector<double> along;
  double length() const { return along.back(); }
};

Loop measure(std::vector<Vec3> points) {
  Loop loop{std::move(points), {0}};
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec3& next = loop.points[(i + 1) % loop.points.size()];
    loop.along.push_back(loop.along.back() + (next - loop.points[i]).norm());
  }
  return loop;
}

// Loops of an outline. Each point has one segment in and one out.
std::vector<Loop> loops_of(const SurfaceMesh& outline) {
  std::vector<int> next(outline.points.size(), -1);
  for (const auto& [a, b] : outline.segments) next[std::size_t(a)] = b;
  std::vector<Loop> loops;
  for (std::size_t start = 0; start < next.size(); ++start) {
    std::vector<Vec3> points;
    for (int at = int(start); at >= 0 && next[std::size_t(at)] >= 0;) {
      const Vec3& x = outline.points[std::size_t(at)];
      if (points.empty() || (x - points.back()).norm() > 0) points.push_back(x);
      at = std::exchange(next[std::size_t(at)], -1);
    }
    if (points.size() > 2) loops.push_back(measure(std::move(points)));
  }
  return loops;
}

// Angle by which the loop turns at point i.
double turn_at(const Loop& loop, std::size_t i) {
  const std::size_t n = loop.points.size();
  const Vec3 in = loop.points[i] - loop.points[(i + n - 1) % n], out = loop.points[(i + 1) % n] - loop.points[i];
  return std::atan2(in[0] * out[1] - in[1] * out[0], in[0] * out[0] + in[1] * out[1]);
}

// Arc length between two points of the loop, by the shorter way.
double gap(const Loop& loop, double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, loop.length() - d);
}

// Sum of the turning angles over all points within `reach` of each point.
std::vector<double> turns_near(const Loop& loop, double reach) {
  const std::size_t n = loop.points.size();
  std::vector<double> turn(n), near(n);
  for (std::size_t i = 0; i < n; ++i) turn[i] = turn_at(loop, i);
  for (std::size_t i = 0; i < n; ++i) {
    near[i] = turn[i];
    for (const std::size_t step : {std::size_t(1), n - 1}) {
      std::size_t j = (i + step) % n;
      for (std::size_t count = 1; count < n && gap(loop, loop.along[i], loop.along[j]) <= reach; ++count) {
        near[i] += turn[j];
        j = (j + step) % n;
      }
    }
  }
  return near;
}

// Points with sharp turns; among close ones only the sharpest.
std::vector<std::size_t> corners_of(const Loop& loop, double size) {
  const std::vector<double> turn = turns_near(loop, size / 4);
  std::vector<std::size_t> order, corners;
  for (std::size_t i = 0; i < turn.size(); ++i) {
    if (std::abs(turn[i]) > corner_turn) order.push_back(i);
  }
  const auto sharpness = [&](std::size_t i) { return std::pair(std::abs(turn[i]), std::abs(turn_at(loop, i))); };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return sharpness(a) > sharpness(b); });
  for (const std::size_t i : order) {
    const bool is_new = std::all_of(corners.begin(), corners.end(),
                                    [&](std::size_t c) { return gap(loop, loop.along[i], loop.along[c]) > size / 4; });
    // Corners of the given outline stay, however close they are.
    if (is_new || std::abs(turn_at(loop, i)) > corner_turn) corners.push_back(i);
  }
  if (corners.empty()) corners.push_back(0);
  std::sort(corners.begin(), corners.end());
  return corners;
}

Vec3 point_along(const Loop& loop, double s) {
  s = std::fmod(s, loop.length());
  const auto after = std::upper_bound(loop.along.begin(), loop.along.end(), s);
  const std::size_t i = std::size_t(std::max<std::ptrdiff_t>(1, after - loop.along.begin())) - 1;
  const std::size_t from = std::min(i, loop.points.size() - 1), to = (from + 1) % loop.points.size();
  const double share = (s - loop.along[from]) / (loop.along[from + 1] - loop.along[from]);
  return loop.points[from] + share * (loop.points[to] - loop.points[from]);
}

void add_loop(const Loop& loop, double size, SurfaceMesh& mesh) {
  const std::vector<std::size_t> corners = corners_of(loop, size);
  const int first = int(mesh.points.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double from = loop.along[corners[k]];
    double to = loop.along[corners[(k + 1) % corners.size()]];
    if (to <= from) to += loop.length();
    // A loop without corners gets at least three points.
    const int fewest = corners.size() == 1 ? 3 : corners.size() == 2 ? 2 : 1;
    const int count = std::max(fewest, int(std::ceil((to - from) / size - 1e-9)));
    mesh.points.push_back(loop.points[corners[k]]);
    for (int i = 1; i < count; ++i) mesh.points.push_back(point_along(loop, from + (to - from) * i / count));
  }
  const int count = int(mesh.points.size()) - first;
  for (int i = 0; i < count; ++i) mesh.segments.push_back({first + i, first + (i + 1) % count});
}

}  // namespace

SurfaceMesh resample_outline(const SurfaceMesh& outline, double size) {
  SurfaceMesh mesh;
  for (const Loop& loop : loops_of(outline)) add_loop(loop, size, mesh);
  return mesh;
}

}  // namespace seiche
