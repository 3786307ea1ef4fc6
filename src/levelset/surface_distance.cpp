#include "levelset/surface_distance.h"

#include <Eigen/Geometry>
#include <cmath>
#include <deque>
#include <map>

#include "geometry/mesh/segment_crossing.h"
#include "grid/loops.h"

namespace seiche {
namespace {

constexpr double reach = 2;  // search distance for facets, cells

std::int64_t edge_key(int a, int b) {
  return (std::int64_t(std::min(a, b)) << 32) | std::int64_t(std::max(a, b));
}

// Weights of the point on a segment nearest to x.
std::array<double, 2> nearest_weights(const std::array<Vec<2>, 2>& p, const Vec<2>& x) {
  const Vec<2> e = p[1] - p[0];
  const double length2 = e.squaredNorm(), t = length2 > 0 ? std::clamp((x - p[0]).dot(e) / length2, 0., 1.) : 0;
  return {1 - t, t};
}

// The same on a triangle, by the region of its plane that x projects to (Ericson 2005, 5.1.5).
std::array<double, 3> nearest_weights(const std::array<Vec<3>, 3>& p, const Vec<3>& x) {
  const Vec3 ab = p[1] - p[0], ac = p[2] - p[0], ap = x - p[0], bp = x - p[1], cp = x - p[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

// Outward normal whose length is the facet's measure. The inside lies left of segments; triangles are counter-clockwise
// seen from outside.
Vec<2> facet_normal(const std::array<Vec<2>, 2>& p) {
  return {p[1][1] - p[0][1], p[0][0] - p[1][0]};
}
Vec<3> facet_normal(const std::array<Vec<3>, 3>& p) {
  return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
}

template <int Dim>
double longest_side(const std::array<Vec<Dim>, Dim>& p) {
  double longest = 0;
  for (int i = 0; i < Dim; ++i) longest = std::max(longest, (p[(i + 1) % Dim] - p[i]).norm());
  return longest;
}

// Calls visit(w) for the centres of equal parts of a facet whose sides are cut into n. w: barycentric weights.
template <class Visit>
void visit_parts(std::array<double, 2>, int n, const Visit& visit) {
  for (int i = 0; i < n; ++i) visit(std::array<double, 2>{1 - (i + 0.5) / n, (i + 0.5) / n});
}
template <class Visit>
void visit_parts(std::array<double, 3>, int n, const Visit& visit) {
  const auto part = [&](double i, double j) { visit(std::array<double, 3>{1 - (i + j) / n, i / n, j / n}); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      part(i + 1. / 3, j + 1. / 3);
      if (i + j + 1 < n) part(i + 2. / 3, j + 2. / 3);
    }
}

double corner_angle(const std::array<Vec<2>, 2>&, int) {
  return 1;
}
double corner_angle(const std::array<Vec<3>, 3>& p, int i) {
  const Vec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Signed angle (2D) or solid angle (3D) of a facet seen from x (van Oosterom, Strackee 1983). Their sum over a closed
// surface is 2 pi (2D) or 4 pi (3D) inside, and 0 outside.
double seen_angle(const std::array<Vec<2>, 2>& p, const Vec<2>& x) {
  const Vec<2> a = p[0] - x, b = p[1] - x;
  return std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
}
double seen_angle(const std::array<Vec<3>, 3>& p, const Vec<3>& x) {
  const Vec3 a = p[0] - x, b = p[1] - x, c = p[2] - x;
  const double na = a.norm(), nb = b.norm(), nc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
}

// The cells of `within` that are at most `distance` cells from the bounding box of some points.
template <int Dim, class Points>
Box<Dim> cells_around(const Layout<Dim>& layout, const Points& points, double distance, const Box<Dim>& within) {
  Vec<Dim> low = Vec<Dim>::Constant(1e300), high = -low;
  for (const Vec<Dim>& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  Box<Dim> box;
  for (int a = 0; a < Dim; ++a) {
    const double i = (low[a] - layout.geometry().lower[a]) / layout.h() - distance;
    const double j = (high[a] - layout.geometry().lower[a]) / layout.h() + distance;
    const double least = within.lower[a], most = within.upper[a];
    box.lower[a] = int(std::clamp(std::floor(i), least, most));
    box.upper[a] = int(std::clamp(std::floor(j) + 1, least, most));
  }
  return box;
}

}  // namespace

template <int Dim>
std::array<int, Dim> SurfaceDistance<Dim>::corners(int facet) const {
  if constexpr (Dim == 2)
    return facets_.segments[std::size_t(facet)];
  else
    return facets_.triangles[std::size_t(facet)];
}

template <int Dim>
std::array<Vec<Dim>, Dim> SurfaceDistance<Dim>::corner_points(int facet) const {
  std::array<Vec<Dim>, Dim> p;
  const auto c = corners(facet);
  for (int i = 0; i < Dim; ++i) p[i] = points_[std::size_t(c[i])];
  return p;
}

template <int Dim>
SurfaceDistance<Dim>::SurfaceDistance(const Layout<Dim>& layout, const SurfaceMesh& facets,
                                      const std::vector<Vec<Dim>>& points)
    : layout_(layout), facets_(facets), points_(points) {
  box_ = cells_around(layout, points, margin, layout.padded());
  box_.upper = (box_.upper.array() + 1).matrix().cwiseMin(layout.padded().upper);  // nodes: one more than cells
  make_bins();
  make_normals();
}

template <int Dim>
void SurfaceDistance<Dim>::make_bins() {
  const int count = int(Dim == 2 ? facets_.segments.size() : facets_.triangles.size());
  for (int f = 0; f < count; ++f) {
    const Box<Dim> cells = cells_around(layout_, corner_points(f), reach, box_);
    if (cells.empty()) continue;
    for_each_index_in_order(layout_, cells, [&](Site s, const IVec<Dim>&) { bins_[s].push_back(f); });
  }
}

template <int Dim>
void SurfaceDistance<Dim>::make_normals() {
  const int count = int(Dim == 2 ? facets_.segments.size() : facets_.triangles.size());
  point_normals_.assign(points_.size(), Vec<Dim>::Zero());
  for (int f = 0; f < count; ++f) {
    const auto p = corner_points(f);
    const auto c = corners(f);
    facet_normals_.push_back(facet_normal(p).normalized());
    for (int i = 0; i < Dim; ++i) {
      point_normals_[std::size_t(c[i])] += corner_angle(p, i) * facet_normals_.back();
      if constexpr (Dim == 3) {
        const auto [place, fresh] = edge_normals_.try_emplace(edge_key(c[i], c[(i + 1) % 3]), facet_normals_.back());
        if (!fresh) place->second += facet_normals_.back();
      }
    }
  }
}

template <int Dim>
Site SurfaceDistance<Dim>::cell_of(const Vec<Dim>& x) const {
  IVec<Dim> i;
  for (int a = 0; a < Dim; ++a) i[a] = int(std::floor((x[a] - layout_.geometry().lower[a]) / layout_.h()));
  return box_.contains(i) ? layout_.site(i) : -1;
}

template <int Dim>
typename SurfaceDistance<Dim>::Nearest SurfaceDistance<Dim>::search(const Vec<Dim>& x) const {
  Nearest best;
  const auto bin = bins_.find(cell_of(x));
  if (bin == bins_.end()) return best;
  for (const int f : bin->second) {
    const auto p = corner_points(f);
    const auto w = seiche::nearest_weights(p, x);
    Vec<Dim> q = Vec<Dim>::Zero();
    for (int i = 0; i < Dim; ++i) q += w[i] * p[i];
    const double d2 = (x - q).squaredNorm();
    if (best.facet < 0 || d2 < best.distance2) best = {d2, f, w, q};
  }
  return best;
}

template <int Dim>
bool SurfaceDistance<Dim>::is_near(const Nearest& n) const {
  const double far = reach * layout_.h();
  return n.facet >= 0 && n.distance2 <= far * far;
}

// The sign follows from the normal of the nearest corner, edge or facet.
template <int Dim>
bool SurfaceDistance<Dim>::is_inside(const Vec<Dim>& x, const Nearest& n) const {
  const auto c = corners(n.facet);
  int first = -1, other = -1, count = 0;
  for (int i = 0; i < Dim; ++i)
    if (n.weights[i] > 0) (count++ == 0 ? first : other) = c[i];
  Vec<Dim> normal = facet_normals_[std::size_t(n.facet)];
  if (count == 1) normal = point_normals_[std::size_t(first)];
  if constexpr (Dim == 3)
    if (count == 2) normal = edge_normals_.at(edge_key(first, other));
  return (x - n.point).dot(normal) < 0;
}

template <int Dim>
double SurfaceDistance<Dim>::winding_number(const Vec<Dim>& x) const {
  double sum = 0;
  for (int f = 0; f < int(facet_normals_.size()); ++f) sum += seen_angle(corner_points(f), x);
  return sum / (Dim == 2 ? 2 * 3.14159265358979323846 : 4 * 3.14159265358979323846);
}

// Computes nodes near the surface first, then spreads their sign to the others.
template <int Dim>
void SurfaceDistance<Dim>::fill(NodeField<Dim>& distance) const {
  if (box_.empty()) return;
  const double h = layout_.h();
  NodeField<Dim, char> known(layout_);
  std::deque<std::pair<Site, IVec<Dim>>> front;
  for_each_index_in_order(layout_, box_, [&](Site s, const IVec<Dim>& i) {
    const Vec<Dim> x = layout_.position(i, node_offset<Dim>());
    const Nearest n = search(x);
    if (!is_near(n)) return;
    distance[s] = (is_inside(x, n) ? -1 : 1) * std::sqrt(n.distance2);
    known[s] = 1;
    front.emplace_back(s, i);
  });
  if (front.empty()) {
    const bool inside = winding_number(layout_.position(box_.lower, node_offset<Dim>())) > 0.5;
    for_each_site(layout_, box_, [&](Site s) { distance[s] = (inside ? -1 : 1) * reach * h; });
    return;
  }
  for (; !front.empty(); front.pop_front()) {
    const auto [s, i] = front.front();
    for (int a = 0; a < Dim; ++a)
      for (const int step : {-1, 1}) {
        IVec<Dim> j = i;
        j[a] += step;
        const Site t = s + step * layout_.stride(a);
        if (!box_.contains(j) || known[t]) continue;
        known[t] = 1;
        distance[t] = (distance[s] < 0 ? -reach : reach) * h;
        front.emplace_back(t, j);
      }
  }
}

template <int Dim>
bool SurfaceDistance<Dim>::nearest(const Vec<Dim>& x, SurfacePoint<Dim>& point) const {
  const Nearest n = search(x);
  if (!is_near(n)) return false;
  point = {corners(n.facet), n.weights};
  return true;
}

template <int Dim>
SurfaceWeights SurfaceDistance<Dim>::nearest_weights(const Vec<Dim>& x) const {
  SurfacePoint<Dim> point;
  SurfaceWeights weights;
  if (nearest(x, point))
    for (int i = 0; i < Dim; ++i) weights.emplace_back(point.corners[i], point.weights[i]);
  return weights;
}

// Quadrature by the centres of parts of facets, whose sides are at most R/4.
template <int Dim>
SurfaceWeights SurfaceDistance<Dim>::mean_around(const Vec<Dim>& x, double R) const {
  std::map<int, double> sums;
  double total = 0;
  const auto bin = bins_.find(cell_of(x));
  if (bin == bins_.end()) return {};
  for (const int f : bin->second) {
    const auto p = corner_points(f);
    const auto c = corners(f);
    const int cuts = std::max(1, int(std::ceil(longest_side<Dim>(p) / (R / 4))));
    const double area = facet_normal(p).norm() / std::pow(cuts, Dim - 1);
    visit_parts(std::array<double, Dim>{}, cuts, [&](const std::array<double, Dim>& w) {
      Vec<Dim> q = Vec<Dim>::Zero();
      for (int i = 0; i < Dim; ++i) q += w[i] * p[i];
      const double near = 1 - (q - x).squaredNorm() / (R * R);
      if (near <= 0) return;
      for (int i = 0; i < Dim; ++i) sums[c[i]] += area * near * near * w[i];
      total += area * near * near;
    });
  }
  SurfaceWeights weights(sums.begin(), sums.end());
  for (auto& [point, weight] : weights) weight /= total;
  return total > 0 ? weights : SurfaceWeights();
}

template <int Dim>
Vec<Dim> SurfaceDistance<Dim>::normal_near(const Vec<Dim>& x) const {
  const Nearest n = search(x);
  return is_near(n) ? facet_normals_[std::size_t(n.facet)] : Vec<Dim>(Vec<Dim>::Zero());
}

template <int Dim>
double SurfaceDistance<Dim>::distance(const Vec<Dim>& x) const {
  const Nearest n = search(x);
  if (!is_near(n)) return reach * layout_.h();
  return (is_inside(x, n) ? -1 : 1) * std::sqrt(n.distance2);
}

template <int Dim>
double SurfaceDistance<Dim>::first_crossing(const Vec<Dim>& p, const Vec<Dim>& q) const {
  double first = 2;
  const auto bin = bins_.find(cell_of(p));
  if (bin == bins_.end()) return first;
  for (const int f : bin->second) first = std::min(first, crossing<Dim>(p, q, corner_points(f)).value_or(2));
  return first;
}

template class SurfaceDistance<2>;
template class SurfaceDistance<3>;

}  // namespace seiche
