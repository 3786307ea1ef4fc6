#include "render/streamlines.h"

#include <algorithm>
#include <cmath>

namespace seiche::render {
namespace {

constexpr float least_distance = 0.5f;   // at which a line ends before another one, in spacings
constexpr float least_length = 1.5f;     // of a line, in spacings
constexpr float rest = 1e-3f;            // speed below which the fluid rests, over the largest one
constexpr int longest = 4000;            // steps of a line in one direction
constexpr float sharpest_turn = 0.966f;  // cosine of the largest angle in half a step, 15 degrees

// Points of the lines by squares of the side `spacing`, for questions of distance.
class DrawnPoints {
 public:
  DrawnPoints(const FaceVelocity& field, float spacing)
      : lower_(field.lower.head<2>()),
        spacing_(spacing),
        count_{int(float(field.cells[0]) * field.h / spacing) + 1, int(float(field.cells[1]) * field.h / spacing) + 1},
        squares_(std::size_t(count_[0]) * count_[1]) {}

  void add(const Polygon& line) {
    for (const Vec2f& x : line) squares_[square(place(x))].push_back(x);
  }
  bool is_free(const Vec2f& x, float distance) const {
    const auto [i, j] = place(x);
    for (int b = std::max(0, j - 1); b <= std::min(count_[1] - 1, j + 1); ++b)
      for (int a = std::max(0, i - 1); a <= std::min(count_[0] - 1, i + 1); ++a)
        for (const Vec2f& other : squares_[square({a, b})])
          if ((other - x).squaredNorm() < distance * distance) return false;
    return true;
  }

 private:
  std::array<int, 2> place(const Vec2f& x) const {
    std::array<int, 2> at;
    for (int a = 0; a < 2; ++a) at[a] = std::clamp(int((x[a] - lower_[a]) / spacing_), 0, count_[a] - 1);
    return at;
  }
  std::size_t square(const std::array<int, 2>& at) const { return std::size_t(at[1]) * count_[0] + at[0]; }

  Vec2f lower_;
  float spacing_;
  std::array<int, 2> count_;
  std::vector<std::vector<Vec2f>> squares_;
};

class LineTracer {
 public:
  LineTracer(const FaceVelocity& field, float spacing, const std::function<bool(const Vec2f&)>& flows)
      : field_(field),
        spacing_(spacing),
        step_(std::min(0.4f * field.h, 0.2f * spacing)),
        flows_(flows),
        drawn_(field, spacing) {
    for (std::size_t c = 0; c + 2 < field.values.size(); c += 3)
      fastest_ = std::max(fastest_, std::hypot(field.values[c], field.values[c + 1]));
  }

  std::vector<Polygon> run() {
    if (!(fastest_ > 0) || !std::isfinite(fastest_)) return {};
    const int nx = std::max(1, int(float(field_.cells[0]) * field_.h / spacing_));
    const int ny = std::max(1, int(float(field_.cells[1]) * field_.h / spacing_));
    for (int k = 0; k < nx * ny; ++k) {
      const int i = k % nx, j = k / nx;
      try_from(field_.lower.head<2>() + spacing_ * Vec2f(float(i) + 0.5f, float(j) + 0.5f));
      // candidates beside the lines that came of it
      for (; done_ < lines_.size(); ++done_) beside(done_);
    }
    return std::move(lines_);
  }

 private:
  // Unit vector of the flow; zero where the fluid rests or is no fluid.
  Vec2f direction(const Vec2f& x) const {
    const Vec2f u = field_.sample(x);
    const float speed = u.norm();
    return speed > rest * fastest_ && flows_(x) ? Vec2f(u / speed) : Vec2f(Vec2f::Zero());
  }

  // Midpoint rule; stays where the line turns too fast for its steps.
  Vec2f advance(const Vec2f& x, float sign) const {
    const Vec2f first = direction(x);
    if (first.isZero()) return x;
    const Vec2f second = direction(x + 0.5f * sign * step_ * first);
    return first.dot(second) < sharpest_turn ? x : Vec2f(x + sign * step_ * second);
  }

  // Points after `start`, until the fluid ends, another line is near, or the line returns to its start.
  Polygon follow(const Vec2f& start, float sign) const {
    Polygon line;
    Vec2f at = start;
    for (int n = 0; n < longest; ++n) {
      const Vec2f next = advance(at, sign);
      if (next == at || !drawn_.is_free(next, least_distance * spacing_)) break;
      line.push_back(next);
      at = next;
      if (n > 8 && (next - start).norm() < 0.8f * step_) break;
    }
    return line;
  }

  void try_from(const Vec2f& seed) {
    if (direction(seed).isZero() || !drawn_.is_free(seed, 0.98f * spacing_)) return;
    Polygon line = follow(seed, -1);
    const bool closed = line.size() > 8 && (line.back() - seed).norm() < 0.8f * step_;
    std::reverse(line.begin(), line.end());
    line.push_back(seed);
    if (!closed) {
      const Polygon ahead = follow(seed, 1);
      line.insert(line.end(), ahead.begin(), ahead.end());
    }
    if (line.size() < 3 || float(line.size()) * step_ < least_length * spacing_) return;
    drawn_.add(line);
    lines_.push_back(std::move(line));
  }

  void beside(std::size_t parent) {
    Polygon line = std::move(lines_[parent]);  // the list of lines grows
    for (std::size_t n = 1; n + 1 < line.size(); n += 4) {
      const Vec2f along = (line[n + 1] - line[n - 1]).normalized(), side = spacing_ * Vec2f(-along.y(), along.x());
      try_from(line[n] + side);
      try_from(line[n] - side);
    }
    lines_[parent] = std::move(line);
  }

  const FaceVelocity& field_;
  float spacing_, step_;
  const std::function<bool(const Vec2f&)>& flows_;
  DrawnPoints drawn_;
  float fastest_ = 0;
  std::vector<Polygon> lines_;
  std::size_t done_ = 0;
};

}  // namespace

std::vector<Polygon> streamlines(const FaceVelocity& velocity, float spacing,
                                 const std::function<bool(const Vec2f&)>& flows) {
  return LineTracer(velocity, spacing, flows).run();
}

}  // namespace seiche::render
