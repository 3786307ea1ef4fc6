#include "render/outline.h"

#include <map>
#include <set>

namespace seiche::render {
namespace {

// Corners in counter-clockwise order; side s runs from corner s to s + 1.
Vec2f corner(const Box& box, int s) {
  constexpr int along_x[4] = {0, 1, 1, 0}, along_y[4] = {0, 0, 1, 1};
  return {along_x[s & 3] ? box.upper[0] : box.lower[0], along_y[s & 3] ? box.upper[1] : box.lower[1]};
}

// Position of a point on the border as side + share of the side, in [0, 4); negative if it is not near the border.
float border_place(const Box& box, const Vec2f& x) {
  const float slack = 1e-4f * box.size().head<2>().norm();
  for (int s = 0; s < 4; ++s) {
    const Vec2f from = corner(box, s), along = corner(box, s + 1) - from;
    const float share = (x - from).dot(along) / along.squaredNorm();
    if ((x - from - share * along).norm() < slack && share >= -1e-3f && share <= 1.001f) {
      return std::min(float(s) + std::clamp(share, 0.0f, 0.9999f), 3.9999f);
    }
  }
  return -1;
}

float walk_length(float from, float to) {
  return to >= from ? to - from : to - from + 4;
}

// Appends the corners passed on the border from one position to another.
void walk_border(const Box& box, float from, float to, Polygon& polygon) {
  const float end = from + walk_length(from, to);
  for (int s = int(from) + 1; float(s) < end; ++s) polygon.push_back(corner(box, s));
}

// Open and closed chains of a solid's segments.
struct Chains {
  std::vector<Polygon> closed, open;
};

Chains join(const SolidMesh& solids, int solid) {
  std::map<int, int> next;
  std::map<int, int> arrivals;
  for (std::size_t i = 0; i < solids.mesh.segments.size(); ++i) {
    if (i < solids.solid.size() && solids.solid[i] != solid) continue;
    const auto [a, b] = solids.mesh.segments[i];
    next[a] = b;
    ++arrivals[b];
  }
  Chains chains;
  const auto follow = [&](int start) {
    Polygon chain;
    int at = start;
    for (auto step = next.find(at); step != next.end(); step = next.find(at)) {
      chain.push_back(solids.mesh.points[at].head<2>().cast<float>());
      at = step->second;
      next.erase(step);
    }
    if (at != start) chain.push_back(solids.mesh.points[at].head<2>().cast<float>());
    return chain;
  };
  std::vector<int> starts;
  for (const auto& [a, b] : next) {
    if (arrivals.find(a) == arrivals.end()) starts.push_back(a);
  }
  for (const int start : starts) chains.open.push_back(follow(start));
  while (!next.empty()) chains.closed.push_back(follow(next.begin()->first));
  return chains;
}

Box enlarge(Box box, const std::vector<Polygon>& chains) {
  for (const Polygon& chain : chains) {
    for (const Vec2f& x : chain) {
      box.lower.head<2>() = box.lower.head<2>().cwiseMin(x);
      box.upper.head<2>() = box.upper.head<2>().cwiseMax(x);
    }
  }
  return box;
}

// Closes chains along the border: from each chain's end to the nearest start of a chain, until the first one is
// reached.
void close_along_border(std::vector<Polygon> open, const Box& box, std::vector<Polygon>& closed) {
  while (!open.empty()) {
    Polygon polygon = open.front();
    const Vec2f first = polygon.front();
    open.erase(open.begin());
    for (;;) {
      const float from = border_place(box, polygon.back());
      float best = border_place(box, first);
      if (from < 0 || best < 0) break;
      auto nearest = open.end();
      for (auto chain = open.begin(); chain != open.end(); ++chain) {
        const float place = border_place(box, chain->front());
        if (place >= 0 && walk_length(from, place) < walk_length(from, best)) nearest = chain, best = place;
      }
      walk_border(box, from, best, polygon);
      if (nearest == open.end()) break;
      polygon.insert(polygon.end(), nearest->begin(), nearest->end());
      open.erase(nearest);
    }
    closed.push_back(std::move(polygon));
  }
}

// Twice the area to the left of closed polygons; negative if their outside lies to the left.
float left_area(const std::vector<Polygon>& polygons) {
  float sum = 0;
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2f a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
      sum += a.x() * b.y() - a.y() * b.x();
    }
  }
  return sum;
}

Polygon border_of(const Box& box) {
  return {corner(box, 0), corner(box, 1), corner(box, 2), corner(box, 3)};
}

}  // namespace

std::vector<Polygon> close_outlines(const SolidMesh& solids, int solid, const Box& box) {
  Chains chains = join(solids, solid);
  if (!chains.open.empty()) {
    const Box border = enlarge(box, chains.open);
    // with open chains, closed hole outlines need no border: the even-odd rule still holds
    close_along_border(std::move(chains.open), border, chains.closed);
  } else if (left_area(chains.closed) < 0) {
    chains.closed.push_back(border_of(enlarge(box, chains.closed)));  // the outside of the polygons fills the domain
  }
  return std::move(chains.closed);
}

std::vector<std::vector<Polygon>> solid_outlines(const SolidMesh& solids, const Box& box) {
  std::vector<std::vector<Polygon>> outlines;
  for (const int solid : std::set<int>(solids.solid.begin(), solids.solid.end()))
    outlines.push_back(close_outlines(solids, solid, box));
  return outlines;
}

bool is_inside(const std::vector<std::vector<Polygon>>& solids, const Vec2f& x) {
  for (const std::vector<Polygon>& polygons : solids) {
    bool inside = false;
    for (const Polygon& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2f &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if ((a.y() <= x.y()) == (b.y() <= x.y())) continue;
        inside ^= a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > x.x();
      }
    }
    if (inside) return true;
  }
  return false;
}

}  // namespace seiche::render
