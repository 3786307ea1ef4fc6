// Detects bodies that overlap at the start.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "solid/contact/search.h"

namespace seiche {
namespace contact {
namespace {

template <int Dim>
using Corners = std::array<Vec<Dim>, Dim>;

// Angle (2D) or solid angle (Van Oosterom, Strackee 1983) of an element seen from the origin.
double seen_angle(const Corners<2>& c) {
  return std::atan2(c[0][0] * c[1][1] - c[0][1] * c[1][0], c[0].dot(c[1]));
}
double seen_angle(const Corners<3>& c) {
  const double a = c[0].norm(), b = c[1].norm(), d = c[2].norm();
  const double over = c[0].dot(c[1].cross(c[2]));
  return 2 * std::atan2(over, a * b * d + c[0].dot(c[1]) * d + c[1].dot(c[2]) * a + c[2].dot(c[0]) * b);
}

// Sign: the side of the line (plane) through p, q (and r) on which x lies.
double side(const Vec<2>& p, const Vec<2>& q, const Vec<2>& x) {
  return (q - p)[0] * (x - p)[1] - (q - p)[1] * (x - p)[0];
}
double side(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& x) {
  return (q - p).cross(r - p).dot(x - p);
}

bool opposite(double a, double b) {
  return (a > 0 && b < 0) || (a < 0 && b > 0);
}

bool crosses(const Corners<2>& s, const Corners<2>& t) {
  return opposite(side(s[0], s[1], t[0]), side(s[0], s[1], t[1])) &&
         opposite(side(t[0], t[1], s[0]), side(t[0], t[1], s[1]));
}

// True if the segment a, b pierces the triangle: its ends lie on both sides, and its line passes all three edges on the
// same side.
bool pierces(const Vec3& a, const Vec3& b, const Corners<3>& t) {
  if (!opposite(side(t[0], t[1], t[2], a), side(t[0], t[1], t[2], b))) return false;
  const double s0 = side(a, b, t[0], t[1]), s1 = side(a, b, t[1], t[2]), s2 = side(a, b, t[2], t[0]);
  return (s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0);
}

bool crosses(const Corners<3>& s, const Corners<3>& t) {
  for (int i = 0; i < 3; ++i)
    if (pierces(s[i], s[(i + 1) % 3], t) || pierces(t[i], t[(i + 1) % 3], s)) return true;
  return false;
}

template <int Dim>
class Overlaps {
 public:
  Overlaps(const typename ContactScene<Dim>::Data& scene, const std::vector<ContactMotion>& motions, double clearance)
      : scene_(scene), clearance_(clearance) {
    const Interval<Dim> interval = make_interval<Dim>(scene, motions, 1);
    points_ = place<Dim>(scene, interval, all_velocities<Dim>(scene, interval, zero(), 0)).points;
  }

  std::vector<Overlap> run() {
    for (const Candidate& pair : find_candidates<Dim>(scene_, points_, points_, clearance_)) {
      const Separation<Dim> apart = separate<Dim>(scene_, pair, gather<Dim>(pair, points_));
      if (apart.distance >= pair.reach(clearance_)) continue;
      auto& depths = pair.kind == PairKind::point_wall ? walls_ : near_;
      deepen(depths, pair.first, pair.second, -apart.distance);
    }
    for (const ElementPair& p : find_element_pairs<Dim>(scene_, points_, clearance_))
      if (p.first_body == p.second_body ? crosses_itself(p)
                                        : crosses(corners(p.first_body, p.first), corners(p.second_body, p.second)))
        crossing_.insert(std::minmax(p.first_body, p.second_body));
    for (const auto& [a, b] : crossing_) deepen(near_, a, b, a == b ? 0 : std::max({0., depth(a, b), depth(b, a)}));
    contained();
    return report();
  }

 private:
  using Depths = std::map<std::pair<int, int>, double>;
  Eigen::VectorXd zero() const { return Eigen::VectorXd::Zero(scene_.size); }

  void deepen(Depths& depths, int a, int b, double depth) {
    const std::pair<int, int> key = &depths == &walls_ ? std::pair(a, b) : std::pair<int, int>(std::minmax(a, b));
    const auto [place, fresh] = depths.try_emplace(key, depth);
    if (!fresh) place->second = std::max(place->second, depth);
  }

  Corners<Dim> corners(int body, int element) const {
    Corners<Dim> c;
    for (int i = 0; i < Dim; ++i) c[i] = points_[scene_.point_begin[body] + scene_.surfaces[body].elements[element][i]];
    return c;
  }

  // Elements with one common point intersect elsewhere only if the opposite side of one pierces the other.
  bool crosses_itself(const ElementPair& p) const {
    const auto& elements = scene_.surfaces[p.first_body].elements;
    const Corners<Dim> s = corners(p.first_body, p.first), t = corners(p.second_body, p.second);
    int common = 0, at_s = 0, at_t = 0;
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j)
        if (elements[p.first][i] == elements[p.second][j]) ++common, at_s = i, at_t = j;
    if (common == 0) return crosses(s, t);
    if constexpr (Dim == 3)
      if (common == 1)
        return pierces(s[(at_s + 1) % 3], s[(at_s + 2) % 3], t) || pierces(t[(at_t + 1) % 3], t[(at_t + 2) % 3], s);
    return false;
  }

  // Winding number: 1 in a solid; for an inverted solid -1 in its cavity and 0 outside. A sheet has no inside.
  bool in_solid(int body, const Vec<Dim>& x) const {
    if (!scene_.surfaces[body].closed) return false;
    double angle = 0;
    for (size_t e = 0; e < scene_.surfaces[body].elements.size(); ++e) {
      Corners<Dim> c = corners(body, static_cast<int>(e));
      for (Vec<Dim>& corner : c) corner -= x;
      angle += seen_angle(c);
    }
    return angle / (Dim == 2 ? 2 * std::numbers::pi : 4 * std::numbers::pi) + (inverted(body) ? 1 : 0) > 0.5;
  }
  bool inverted(int body) const { return scene_.surfaces[body].volume < 0; }

  double distance(int body, const Vec<Dim>& x) const {
    double least = std::numeric_limits<double>::infinity();
    for (size_t e = 0; e < scene_.surfaces[body].elements.size(); ++e) {
      const Corners<Dim> c = corners(body, static_cast<int>(e));
      PairPoints<Dim> pair{x, c[0], c[1], c[Dim - 1]};
      least = std::min(least, separate<Dim>(PairKind::point_element, pair).distance);
    }
    return least;
  }

  // Depth in b of a's deepest point; negative if no point lies in b.
  double depth(int a, int b) const {
    const Eigen::AlignedBox<double, Dim> around = box(b);
    double deepest = -1;
    for (int p = scene_.point_begin[a]; p < scene_.point_begin[a + 1]; ++p)
      if ((inverted(b) || around.contains(points_[p])) && in_solid(b, points_[p]))
        deepest = std::max(deepest, distance(b, points_[p]));
    return deepest;
  }

  Eigen::AlignedBox<double, Dim> box(int body) const {
    Eigen::AlignedBox<double, Dim> r;
    for (int p = scene_.point_begin[body]; p < scene_.point_begin[body + 1]; ++p) r.extend(points_[p]);
    return r;
  }

  // Containment for surfaces that do not cross: one point of each connected part is tested.
  void contained() {
    std::vector<Eigen::AlignedBox<double, Dim>> boxes;
    std::vector<std::vector<int>> parts;
    const int count = static_cast<int>(scene_.surfaces.size());
    for (int b = 0; b < count; ++b) {
      boxes.push_back(box(b));
      parts.push_back(parts_of(b));
    }
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b) {
        if (boxes[a].isEmpty() || boxes[b].isEmpty() || (!scene_.moves(a) && !scene_.moves(b))) continue;
        if (!scene_.may_touch(std::min(a, b), std::max(a, b))) continue;
        if (!boxes[a].intersects(boxes[b]) && !inverted(a) && !inverted(b)) continue;
        if (crossing_.count({a, b})) continue;
        const bool inside = any_in(b, parts[a]) || any_in(a, parts[b]);
        if (inside) deepen(near_, a, b, std::max({0., depth(a, b), depth(b, a)}));
      }
  }

  bool any_in(int body, const std::vector<int>& points) const {
    return std::any_of(points.begin(), points.end(), [&](int p) { return in_solid(body, points_[p]); });
  }

  // One point of each connected part of a surface.
  std::vector<int> parts_of(int b) const {
    std::vector<int> root(scene_.surfaces[b].points.size());
    for (size_t p = 0; p < root.size(); ++p) root[p] = static_cast<int>(p);
    const auto find = [&](int p) {
      while (root[p] != p) p = root[p] = root[root[p]];
      return p;
    };
    for (const Element<Dim>& e : scene_.surfaces[b].elements)
      for (int i = 1; i < Dim; ++i) root[find(e[i])] = find(e[0]);
    std::vector<int> parts;
    for (size_t p = 0; p < root.size(); ++p)
      if (root[p] == static_cast<int>(p)) parts.push_back(scene_.point_begin[b] + root[p]);
    return parts;
  }

  std::vector<Overlap> report() const {
    std::vector<Overlap> list;
    for (const auto& [pair, depth] : near_) {
      const bool swap = !scene_.moves(pair.first);
      const int body = swap ? pair.second : pair.first, other = swap ? pair.first : pair.second;
      list.push_back({body, other, Overlap::With::body, depth, say(scene_.names[body], scene_.names[other], depth)});
    }
    for (const auto& [pair, depth] : walls_)
      list.push_back({pair.first, pair.second, Overlap::With::wall, depth,
                      say(scene_.names[pair.first], fmt::format("wall {}", pair.second), depth)});
    return list;
  }

  std::string say(const std::string& a, const std::string& b, double depth) const {
    if (a == b && depth >= 0) return fmt::format("{} intersects itself", a);
    if (depth < 0) return fmt::format("{} and {} are {:.3g} m apart, nearer than {:.3g} m", a, b, -depth, clearance_);
    return fmt::format("{} and {} overlap by {:.3g} m", a, b, depth);
  }

  const typename ContactScene<Dim>::Data& scene_;
  double clearance_;
  Points<Dim> points_;
  Depths near_, walls_;
  std::set<std::pair<int, int>> crossing_;
};

}  // namespace
}  // namespace contact

template <int Dim>
std::vector<Overlap> find_initial_overlaps(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions,
                                           double clearance) {
  return contact::Overlaps<Dim>(scene.data(), motions, clearance).run();
}

template std::vector<Overlap> find_initial_overlaps<2>(const ContactScene<2>&, const std::vector<ContactMotion>&,
                                                       double);
template std::vector<Overlap> find_initial_overlaps<3>(const ContactScene<3>&, const std::vector<ContactMotion>&,
                                                       double);

}  // namespace seiche
