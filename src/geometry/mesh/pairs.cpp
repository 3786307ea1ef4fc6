// Halves space until few edges and triangles are left in it, or all of them share a point: the tip of a fan has no
// pairs, however many triangles meet there.
#include "geometry/mesh/pairs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <utility>

namespace seiche::mesh {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr double few_pairs = 256;           // up to so many pairs are tried one by one
constexpr double gain = 0.8;                // a halving is worthwhile if it leaves at most this fraction of the pairs
constexpr std::size_t few_pieces = 64;      // a shared point is looked for among so many pieces
constexpr int most_patience = 4;            // halvings without gain before all pairs are tried
constexpr double rounding = 1e-12;          // relative to the largest coordinate, far above the round-off of clipping
constexpr std::size_t max_corners = 3 + 6;  // corners of a triangle clipped by a box

// An edge or triangle with the bounding box of its part in the current cell.
struct Piece {
  int index;
  Box box;
};
using Pieces = std::vector<Piece>;

// A convex polygon and its clipped remains.
struct Polygon {
  std::array<Vec3, max_corners + 1> corners;
  std::size_t count = 0;
  void add(const Vec3& x) {
    if (count < corners.size()) corners[count++] = x;
  }
};

// The part of a polygon on the side of the plane x[axis] = at that `sign` points to (Sutherland, Hodgman 1974).
Polygon clip(const Polygon& polygon, int axis, double at, double sign) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3 &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.count];
    const double dp = sign * (p[axis] - at), dq = sign * (q[axis] - at);
    if (dp >= 0) result.add(p);
    if ((dp >= 0) != (dq >= 0)) result.add(p + dp / (dp - dq) * (q - p));
  }
  return result;
}

class Search {
 public:
  Search(const std::vector<Vec3>& points, const std::vector<Edge>& edges,
         const std::vector<std::array<int, 3>>& triangles)
      : points_(points), edges_(edges), triangles_(triangles) {
    double largest = 0;
    for (const Vec3& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    margin_ = rounding * largest;
  }

  std::vector<std::array<int, 2>> run() {
    halve({whole(edges_), whole(triangles_)}, most_patience);
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return std::move(found_);
  }

 private:
  template <class Facets>
  Pieces whole(const Facets& facets) const {
    Pieces pieces;
    for (std::size_t i = 0; i < facets.size(); ++i) {
      Box box;
      for (const int p : facets[i]) box.extend(points_[p]);
      pieces.push_back({int(i), box});
    }
    return pieces;
  }

  static Box around(const Pieces& pieces) {
    Box box;
    for (const Piece& p : pieces) box.extend(p.box);
    return box;
  }

  static void keep_within(const Box& box, Pieces& pieces) {
    std::erase_if(pieces, [&](const Piece& p) { return !p.box.intersects(box); });
  }

  template <class Facets>
  static std::size_t count_without(const Facets& facets, const Pieces& pieces, int point) {
    return std::size_t(std::count_if(pieces.begin(), pieces.end(), [&](const Piece& p) {
      return std::find(facets[p.index].begin(), facets[p.index].end(), point) == facets[p.index].end();
    }));
  }

  // Number of pairs to try without those that share `point`. The point is the best of a few candidates; -1: none. It
  // takes time, and is looked for only among few pieces, or where halving has gained little.
  struct Work {
    int point = -1;
    double pairs = 0;
  };
  Work work(const Pieces& edges, const Pieces& triangles, int patience) const {
    if (edges.empty() || triangles.empty()) return {};
    Work least{-1, double(edges.size()) * double(triangles.size())};
    const bool few = edges.size() + triangles.size() <= few_pieces;
    if (least.pairs <= few_pairs || (patience == most_patience && !few)) return least;
    for (const std::size_t t : {std::size_t(0), triangles.size() / 2, triangles.size() - 1}) {
      for (const int point : triangles_[triangles[t].index]) {
        const double e = double(count_without(edges_, edges, point)),
                     f = double(count_without(triangles_, triangles, point));
        const double pairs = e * double(triangles.size()) + double(edges.size()) * f - e * f;
        if (pairs < least.pairs) least = {point, pairs};
      }
    }
    return least;
  }

  template <class Facet>
  Box clipped(const Facet& facet, const Box& cell) const {
    Polygon polygon;
    for (const int p : facet) polygon.add(points_[p]);
    for (int axis = 0; axis < 3; ++axis) {
      polygon = clip(polygon, axis, cell.min()[axis] - margin_, 1);
      polygon = clip(polygon, axis, cell.max()[axis] + margin_, -1);
    }
    Box box;
    for (std::size_t i = 0; i < polygon.count; ++i) box.extend(polygon.corners[i]);
    if (box.isEmpty()) return box;
    return Box(box.min().array() - margin_, box.max().array() + margin_);
  }

  // The parts of the pieces on one side of a plane.
  template <class Facets>
  Pieces beyond(const Facets& facets, const Pieces& pieces, int axis, double at, bool high) const {
    Pieces result;
    for (const Piece& p : pieces) {
      if (high ? p.box.max()[axis] < at : p.box.min()[axis] > at) continue;
      if (high ? p.box.min()[axis] >= at : p.box.max()[axis] <= at) {
        result.push_back(p);
        continue;
      }
      Box cell = p.box;
      (high ? cell.min() : cell.max())[axis] = at;
      const Box box = clipped(facets[p.index], cell);
      if (!box.isEmpty()) result.push_back({p.index, box.intersection(p.box)});
    }
    return result;
  }

  struct Half {
    Pieces edges, triangles;
  };
  struct Halves {
    Half low, high;
    double pairs = std::numeric_limits<double>::infinity();
  };

  Halves halves(const Half& whole, int axis, double at, int patience) const {
    Halves result;
    result.pairs = 0;
    for (const bool high : {false, true}) {
      Half& half = high ? result.high : result.low;
      half = {beyond(edges_, whole.edges, axis, at, high), beyond(triangles_, whole.triangles, axis, at, high)};
      result.pairs += work(half.edges, half.triangles, patience).pairs;
    }
    return result;
  }

  // Halves the longest side, or, if that gains little, the side that gains most.
  Halves best_halves(const Half& whole, const Box& cell, double now, int patience) const {
    Eigen::Index longest = 0;
    cell.sizes().maxCoeff(&longest);
    Halves best = halves(whole, int(longest), cell.center()[longest], patience);
    for (int axis = 0; axis < 3 && best.pairs > gain * now; ++axis) {
      if (axis == longest) continue;
      Halves other = halves(whole, axis, cell.center()[axis], patience);
      if (other.pairs < best.pairs) best = std::move(other);
    }
    return best;
  }

  void halve(Half whole, int patience) {
    const Box cell = around(whole.edges).intersection(around(whole.triangles));
    keep_within(cell, whole.edges);
    keep_within(cell, whole.triangles);
    const Work now = work(whole.edges, whole.triangles, patience);
    if (now.pairs == 0) return;
    if (now.pairs <= few_pairs || patience == 0) return try_all(whole, now.point);
    Halves best = best_halves(whole, cell, now.pairs, patience);
    patience = best.pairs < gain * now.pairs ? most_patience : patience - 1;
    whole = {};
    halve(std::move(best.low), patience);
    halve(std::move(best.high), patience);
  }

  // Tries all pairs except those that share the point.
  void try_all(const Half& half, int point) {
    const auto has = [&](const auto& facet) { return std::find(facet.begin(), facet.end(), point) != facet.end(); };
    Pieces without;
    for (const Piece& t : half.triangles)
      if (!has(triangles_[t.index])) without.push_back(t);
    for (const Piece& e : half.edges)
      for (const Piece& t : has(edges_[e.index]) ? without : half.triangles) try_pair(e, t);
  }

  void try_pair(const Piece& e, const Piece& t) {
    const auto& ends = edges_[e.index];
    const auto& corners = triangles_[t.index];
    const bool apart = std::find_first_of(corners.begin(), corners.end(), ends.begin(), ends.end()) == corners.end();
    if (apart && e.box.intersects(t.box)) found_.push_back({e.index, t.index});
  }

  const std::vector<Vec3>& points_;
  const std::vector<Edge>& edges_;
  const std::vector<std::array<int, 3>>& triangles_;
  double margin_ = 0;
  std::vector<std::array<int, 2>> found_;
};

}  // namespace

std::vector<std::array<int, 2>> close_pairs(const std::vector<Vec3>& points, const std::vector<Edge>& edges,
                                            const std::vector<std::array<int, 3>>& triangles) {
  return Search(points, edges, triangles).run();
}

}  // namespace seiche::mesh
