#include "levelset/mesh_intersections.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "levelset/exact_orientation.h"

namespace seiche::mesh {
namespace {

using Triangle = std::array<int, 3>;
using Box = Eigen::AlignedBox3d;

// An axis along which the triangle can be seen at all, if possible the one along which it is widest; -1: none.
int view(const Vec3& a, const Vec3& b, const Vec3& c) {
  int widest = 0;
  (b - a).cross(c - a).cwiseAbs().maxCoeff(&widest);
  for (int k = 0; k < 3; ++k)
    if (const int axis = (widest + k) % 3; orientation(a, b, c, axis) != 0) return axis;
  return -1;
}

bool segments_meet_in_plane(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, int axis) {
  const int pa = orientation(a, b, p, axis), qa = orientation(a, b, q, axis);
  const int ap = orientation(p, q, a, axis), bp = orientation(p, q, b, axis);
  if (pa != 0 || qa != 0 || ap != 0 || bp != 0) return pa * qa <= 0 && ap * bp <= 0;
  for (int k = 0; k < 3; ++k)  // on one line
    if (std::max(p[k], q[k]) < std::min(a[k], b[k]) || std::max(a[k], b[k]) < std::min(p[k], q[k])) return false;
  return true;
}

bool lies_in(const Vec3& p, const std::array<Vec3, 3>& t, int axis) {
  const int ab = orientation(t[0], t[1], p, axis), bc = orientation(t[1], t[2], p, axis),
            ca = orientation(t[2], t[0], p, axis);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

bool meet_in_plane(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const int axis = view(t[0], t[1], t[2]);
  if (axis < 0) return false;
  if (lies_in(p, t, axis)) return true;
  for (int k = 0; k < 3; ++k)
    if (segments_meet_in_plane(p, q, t[k], t[(k + 1) % 3], axis)) return true;
  return false;
}

bool segment_meets(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const int above = orientation(t[0], t[1], t[2], p), below = orientation(t[0], t[1], t[2], q);
  if (above * below > 0) return false;
  if (above == 0 && below == 0) return meet_in_plane(p, q, t);
  const int ab = orientation(p, q, t[0], t[1]), bc = orientation(p, q, t[1], t[2]), ca = orientation(p, q, t[2], t[0]);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

std::array<Vec3, 3> corners(const SurfaceMesh& mesh, const Triangle& t) {
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

// The triangle turned so that the corners it shares with the other come first, and how many those are.
std::pair<Triangle, int> shared_first(Triangle t, const Triangle& other) {
  const auto is_shared = [&](int p) { return std::find(other.begin(), other.end(), p) != other.end(); };
  const auto end = std::stable_partition(t.begin(), t.end(), is_shared);
  return {t, int(end - t.begin())};
}

// Both lie in one plane and on the same side of their common edge.
bool folded(const SurfaceMesh& mesh, const Triangle& s, const Triangle& t) {
  const Vec3 &u = mesh.points[s[0]], &v = mesh.points[s[1]], &a = mesh.points[s[2]], &b = mesh.points[t[2]];
  if (orientation(u, v, a, b) != 0) return false;
  const int axis = view(u, v, a);
  return axis >= 0 && orientation(u, v, a, axis) == orientation(u, v, b, axis);
}

bool any_side_meets(const SurfaceMesh& mesh, const Triangle& s, const Triangle& t) {
  const auto x = corners(mesh, s), y = corners(mesh, t);
  for (int k = 0; k < 3; ++k)
    if (segment_meets(x[k], x[(k + 1) % 3], y)) return true;
  return false;
}

Box box_of(const SurfaceMesh& mesh, const Triangle& t) {
  Box box(mesh.points[t[0]]);
  return box.extend(mesh.points[t[1]]).extend(mesh.points[t[2]]);
}

bool has_area(const SurfaceMesh& mesh, const Triangle& t) {
  return view(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) >= 0 &&
         (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm() > 0;
}

// A number for each point: the same for the corners of triangles without area that hang together, -1 for all others.
std::vector<int> sliver_points(const SurfaceMesh& mesh) {
  std::vector<int> group(mesh.points.size(), -1);
  int count = 0;
  for (const Triangle& t : mesh.triangles) {
    if (has_area(mesh, t)) continue;
    const Triangle known{group[t[0]], group[t[1]], group[t[2]]};
    for (const int p : t) group[p] = count;
    if (*std::max_element(known.begin(), known.end()) >= 0)
      for (int& g : group)
        if (g >= 0 && std::find(known.begin(), known.end(), g) != known.end()) g = count;
    ++count;
  }
  return group;
}

bool share_sliver(const std::vector<int>& group, const Triangle& s, const Triangle& t) {
  for (const int p : s)
    for (const int q : t)
      if (group[p] >= 0 && group[p] == group[q]) return true;
  return false;
}

// A tree of boxes over the triangles, split at the median of their middles along the longest side.
class BoxTree {
 public:
  BoxTree(std::vector<Box> boxes, std::vector<int> members) : boxes_(std::move(boxes)), order_(std::move(members)) {
    if (!order_.empty()) grow(0, int(order_.size()));
  }

  // Visits all pairs of triangles whose boxes meet, lower index first.
  template <class Visit>
  void pairs(const Visit& visit) const {
    std::vector<std::pair<int, int>> todo;
    if (!nodes_.empty()) todo.emplace_back(0, 0);
    while (!todo.empty()) {
      const auto [n, m] = todo.back();
      todo.pop_back();
      const Node &a = nodes_[n], &b = nodes_[m];
      if (!a.box.intersects(b.box)) continue;
      if (a.high < 0 && b.high < 0)
        leaves(a, b, n == m, visit);
      else if (n == m)
        todo.insert(todo.end(), {{a.low, a.low}, {a.low, a.high}, {a.high, a.high}});
      else if (b.high < 0 || (a.high >= 0 && a.last - a.first >= b.last - b.first))
        todo.insert(todo.end(), {{a.low, m}, {a.high, m}});
      else
        todo.insert(todo.end(), {{n, b.low}, {n, b.high}});
    }
  }

 private:
  struct Node {
    Box box;
    int first, last, low = -1, high = -1;
  };

  int grow(int first, int last) {
    constexpr int leaf_size = 4;
    Box box, middles;
    for (int i = first; i < last; ++i) box.extend(boxes_[order_[i]]), middles.extend(boxes_[order_[i]].center());
    const int node = int(nodes_.size());
    nodes_.push_back({box, first, last});
    if (last - first <= leaf_size) return node;
    int axis = 0;
    middles.sizes().maxCoeff(&axis);
    const int half = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                     [&](int s, int t) { return boxes_[s].center()[axis] < boxes_[t].center()[axis]; });
    const int low = grow(first, half), high = grow(half, last);
    nodes_[node].low = low, nodes_[node].high = high;
    return node;
  }

  template <class Visit>
  void leaves(const Node& a, const Node& b, bool same, const Visit& visit) const {
    for (int i = a.first; i < a.last; ++i)
      for (int j = same ? i + 1 : b.first; j < b.last; ++j)
        if (boxes_[order_[i]].intersects(boxes_[order_[j]]))
          visit(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]));
  }

  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace

// Triangles that share a corner meet elsewhere if and only if one's side opposite of it meets the other: the common
// part is convex, and a ray from the corner leaves one of them first.
bool intersect(const SurfaceMesh& mesh, const Triangle& one, const Triangle& two) {
  const auto [s, shared] = shared_first(one, two);
  const Triangle t = shared_first(two, one).first;
  if (shared == 3) return true;
  if (shared == 2) return folded(mesh, s, t);
  if (shared == 0) return any_side_meets(mesh, s, t) || any_side_meets(mesh, t, s);
  const auto x = corners(mesh, s), y = corners(mesh, t);
  return segment_meets(x[1], x[2], y) || segment_meets(y[1], y[2], x);
}

std::vector<std::array<int, 2>> self_intersections(const SurfaceMesh& mesh) {
  std::vector<Box> boxes;
  std::vector<int> members;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    boxes.push_back(box_of(mesh, mesh.triangles[t]));
    if (has_area(mesh, mesh.triangles[t])) members.push_back(int(t));
  }
  const std::vector<int> group = sliver_points(mesh);
  std::vector<std::array<int, 2>> found;
  BoxTree(std::move(boxes), std::move(members)).pairs([&](int s, int t) {
    const Triangle &one = mesh.triangles[s], &two = mesh.triangles[t];
    if (!share_sliver(group, one, two) && intersect(mesh, one, two)) found.push_back({s, t});
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace seiche::mesh
