#include "solid/contact/search.h"

#include <algorithm>

namespace seiche::contact {
namespace {

template <int Dim>
using Box = Eigen::AlignedBox<double, Dim>;

// Bounding box of a box that moves by `way`.
template <int Dim>
Box<Dim> swept(const Box<Dim>& box, const Vec<Dim>& way) {
  return Box<Dim>(box.min() + way.cwiseMin(0), box.max() + way.cwiseMax(0));
}

// Paths are taken in a frame that moves with the mean motion of a body, so bodies that move together are not paired.
template <int Dim>
class Search {
 public:
  using Scene = typename ContactScene<Dim>::Data;
  Search(const Scene& scene, const Points<Dim>& from, const Points<Dim>& to, double margin)
      : scene_(scene), from_(from), to_(to), half_(0.5 * margin), trees_(scene.surfaces.size()) {
    paths_.reserve(from.size());
    for (size_t b = 0; b < scene.surfaces.size(); ++b) enclose(static_cast<int>(b));
  }

  std::vector<Candidate> run() {
    near_walls();
    for (const auto& [a, b] : near_bodies()) {
      const Vec<Dim> way = drift_[a] - drift_[b], none = Vec<Dim>::Zero();
      meet(a, b, way, [&, a = a, b = b](int e, int f) {
        points_and_element(a, e, way, b, f, none);
        points_and_element(b, f, none, a, e, way);
        if constexpr (Dim == 3) edges(a, e, way, b, f);
      });
    }
    for (size_t b = 0; b < body_boxes_.size(); ++b)
      if (moves_by_itself(static_cast<int>(b)) && !body_boxes_[b].isEmpty()) meet_itself(static_cast<int>(b));
    if (scene_.any_deforms()) measure_edges();
    std::erase_if(found_, [&](const Candidate& c) { return stands_pinned(c); });
    return std::move(found_);
  }

  std::vector<ElementPair> element_pairs() {
    std::vector<ElementPair> pairs;
    for (const auto& [a, b] : near_bodies())
      meet(a, b, drift_[a] - drift_[b], [&, a = a, b = b](int e, int f) { pairs.push_back({a, e, b, f}); });
    const Vec<Dim> none = Vec<Dim>::Zero();
    for (int b = 0; b < static_cast<int>(body_boxes_.size()); ++b)
      if (scene_.deforms(b) && !body_boxes_[b].isEmpty())
        meet(b, b, none, [&](int e, int f) {
          if (e < f) pairs.push_back({b, e, b, f});
        });
    return pairs;
  }

 private:
  // Boxes of a body and of its points, enlarged by half the margin. Boxes of points exclude the drift.
  void enclose(int b) {
    const int begin = scene_.point_begin[b], end = scene_.point_begin[b + 1];
    Vec<Dim> drift = Vec<Dim>::Zero();
    for (int p = begin; p < end; ++p) drift += (to_[p] - from_[p]) / (end - begin);
    const Vec<Dim> grow = Vec<Dim>::Constant(half_);
    Box<Dim> body;
    for (int p = begin; p < end; ++p) {
      const Vec<Dim> last = to_[p] - drift;
      paths_.emplace_back(from_[p].cwiseMin(last) - grow, from_[p].cwiseMax(last) + grow);
      body.extend(paths_.back());
    }
    drift_.push_back(drift);
    body_boxes_.push_back(body.isEmpty() ? body : swept<Dim>(body, drift));
  }

  template <size_t N>
  Box<Dim> path(int begin, const std::array<int, N>& points) const {
    Box<Dim> box = paths_[begin + points[0]];
    for (size_t i = 1; i < N; ++i) box.extend(paths_[begin + points[i]]);
    return box;
  }

  // Sweep and prune along x over the bodies' boxes.
  std::vector<std::pair<int, int>> near_bodies() const {
    std::vector<std::pair<double, int>> starts;
    for (size_t b = 0; b < body_boxes_.size(); ++b)
      if (!body_boxes_[b].isEmpty()) starts.emplace_back(body_boxes_[b].min()[0], static_cast<int>(b));
    std::sort(starts.begin(), starts.end());
    std::vector<std::pair<int, int>> pairs;
    std::vector<int> open;
    for (const auto& [start, b] : starts) {
      std::erase_if(open, [&, at = start](int a) { return body_boxes_[a].max()[0] < at; });
      for (int a : open)
        if ((scene_.moves(a) || scene_.moves(b)) && body_boxes_[a].intersects(body_boxes_[b]) &&
            scene_.may_touch(std::min(a, b), std::max(a, b)))
          pairs.emplace_back(std::min(a, b), std::max(a, b));
      open.push_back(b);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  void near_walls() {
    for (size_t b = 0; b < body_boxes_.size(); ++b) {
      if (!scene_.moves(static_cast<int>(b)) || body_boxes_[b].isEmpty()) continue;
      for (size_t w = 0; w < scene_.walls.size(); ++w) near_wall(static_cast<int>(b), static_cast<int>(w));
    }
  }

  void near_wall(int b, int w) {
    const Wall<Dim>& wall = scene_.walls[w];
    const auto height = [&](const Vec<Dim>& x) { return (x - wall.point).dot(wall.normal); };
    const Vec<Dim> reach = 0.5 * body_boxes_[b].sizes();
    if (height(body_boxes_[b].center()) - reach.dot(wall.normal.cwiseAbs()) > half_) return;
    for (int p = scene_.point_begin[b]; p < scene_.point_begin[b + 1]; ++p)
      if (std::min(height(from_[p]), height(to_[p])) <= 2 * half_)
        found_.push_back({PairKind::point_wall, b, w, {p, 0, 0, 0}});
  }

  // Boxes of a body's tree, built on first use.
  const std::vector<Box<Dim>>& tree(int b) {
    std::vector<Box<Dim>>& boxes = trees_[b];
    const Surface<Dim>& s = scene_.surfaces[b];
    if (!boxes.empty()) return boxes;
    boxes.resize(s.nodes.size());
    for (int n = static_cast<int>(s.nodes.size()) - 1; n >= 0; --n) {
      const TreeNode& node = s.nodes[n];
      if (node.low_child > 0)
        boxes[n] = boxes[node.low_child].merged(boxes[node.high_child]);
      else
        for (int i = node.first; i < node.last; ++i)
          boxes[n].extend(path(scene_.point_begin[b], s.elements[s.order[i]]));
    }
    return boxes;
  }

  // Descends both trees, the larger node first; `visit` gets the elements of overlapping leaves. `way`: drift of a
  // relative to b.
  template <class Visit>
  void meet(int a, int b, const Vec<Dim>& way, const Visit& visit) {
    const std::vector<Box<Dim>>&boxes_a = tree(a), &boxes_b = tree(b);
    std::vector<std::pair<int, int>> todo{{0, 0}};
    while (!todo.empty()) {
      const auto [n, m] = todo.back();
      todo.pop_back();
      if (!swept<Dim>(boxes_a[n], way).intersects(boxes_b[m])) continue;
      const TreeNode &node = scene_.surfaces[a].nodes[n], &other = scene_.surfaces[b].nodes[m];
      const bool split_a = node.low_child > 0 && (other.low_child == 0 || boxes_a[n].diagonal().squaredNorm() >=
                                                                              boxes_b[m].diagonal().squaredNorm());
      if (split_a) {
        todo.insert(todo.end(), {{node.high_child, m}, {node.low_child, m}});
      } else if (other.low_child > 0) {
        todo.insert(todo.end(), {{n, other.high_child}, {n, other.low_child}});
      } else {
        meet_leaves(a, node, way, b, other, visit);
      }
    }
  }

  template <class Visit>
  void meet_leaves(int a, const TreeNode& node, const Vec<Dim>& way, int b, const TreeNode& other, const Visit& visit) {
    const Surface<Dim>&one = scene_.surfaces[a], &two = scene_.surfaces[b];
    for (int i = node.first; i < node.last; ++i) {
      const int e = one.order[i];
      const Box<Dim> box = swept<Dim>(path(scene_.point_begin[a], one.elements[e]), way);
      for (int j = other.first; j < other.last; ++j) {
        const int f = two.order[j];
        if (box.intersects(path(scene_.point_begin[b], two.elements[f]))) visit(e, f);
      }
    }
  }

  // True for a deformable body with points that are not pinned.
  bool moves_by_itself(int b) const {
    const auto pinned = scene_.pinned.begin();
    return scene_.deforms(b) && !std::all_of(pinned + scene_.point_begin[b], pinned + scene_.point_begin[b + 1],
                                             [](char p) { return p != 0; });
  }

  // Pairs within one body; each pair of elements is visited twice, once in each order.
  void meet_itself(int b) {
    const Vec<Dim> none = Vec<Dim>::Zero();
    const auto first = static_cast<std::ptrdiff_t>(found_.size());
    meet(b, b, none, [&](int e, int f) {
      if (e == f) return;
      points_and_element(b, e, none, b, f, none);
      if constexpr (Dim == 3)
        if (e < f) edges(b, e, none, b, f);
    });
    found_.erase(std::remove_if(found_.begin() + first, found_.end(), share_a_point), found_.end());
    std::for_each(found_.begin() + first, found_.end(),
                  [&](Candidate& c) { c.apart_at_rest = separate<Dim>(c.kind, at_rest(c)).distance; });
  }

  // True if all points of one side are pinned and the other body is prescribed or pinned likewise.
  bool stands_pinned(const Candidate& c) const {
    const bool wall = c.kind == PairKind::point_wall, other_prescribed = wall || !scene_.moves(c.second);
    const int count = points_of(c.kind, Dim), first = points_of_first(c.kind);
    const auto pinned = [&](int p) { return scene_.pinned[std::size_t(p)] != 0; };
    if (!other_prescribed && scene_.moves(c.first))
      return std::all_of(c.points.begin(), c.points.begin() + count, pinned);
    return other_prescribed ? std::all_of(c.points.begin(), c.points.begin() + first, pinned)
                            : std::all_of(c.points.begin() + first, c.points.begin() + count, pinned);
  }

  void measure_edges() {
    for (Candidate& c : found_) {
      if (c.kind != PairKind::edge_edge || (!scene_.deforms(c.first) && !scene_.deforms(c.second))) continue;
      const PairPoints<Dim> x = at_rest(c);
      c.edges_at_rest = (x[1] - x[0]).squaredNorm() * (x[3] - x[2]).squaredNorm();
    }
  }

  static bool share_a_point(const Candidate& c) {
    const int count = points_of(c.kind, Dim), first = points_of_first(c.kind);
    for (int i = 0; i < first; ++i)
      for (int j = first; j < count; ++j)
        if (c.points[i] == c.points[j]) return true;
    return false;
  }

  PairPoints<Dim> at_rest(const Candidate& c) const {
    PairPoints<Dim> x;
    for (Vec<Dim>& point : x) point.setZero();
    for (int i = 0; i < points_of(c.kind, Dim); ++i) {
      const int body = i < points_of_first(c.kind) ? c.first : c.second;
      x[i] = scene_.surfaces[body].points[c.points[i] - scene_.point_begin[body]];
    }
    return x;
  }

  void points_and_element(int a, int e, const Vec<Dim>& way, int b, int f, const Vec<Dim>& other_way) {
    const std::vector<int>& own = scene_.surfaces[a].own_points[e];
    if (own.empty()) return;
    const Element<Dim>& element = scene_.surfaces[b].elements[f];
    const Box<Dim> box = swept<Dim>(path(scene_.point_begin[b], element), other_way);
    for (int p : own) {
      if (!swept<Dim>(paths_[scene_.point_begin[a] + p], way).intersects(box)) continue;
      Candidate c{PairKind::point_element, a, b, {scene_.point_begin[a] + p, 0, 0, 0}};
      for (int k = 0; k < Dim; ++k) c.points[k + 1] = scene_.point_begin[b] + element[k];
      found_.push_back(c);
    }
  }

  void edges(int a, int e, const Vec<Dim>& way, int b, int f) {
    const int start_a = scene_.point_begin[a], start_b = scene_.point_begin[b];
    for (int i : scene_.surfaces[a].own_edges[e]) {
      const std::array<int, 2>& one = scene_.surfaces[a].edges[i];
      const Box<Dim> box = swept<Dim>(path(start_a, one), way);
      for (int j : scene_.surfaces[b].own_edges[f]) {
        const std::array<int, 2>& two = scene_.surfaces[b].edges[j];
        if (!box.intersects(path(start_b, two))) continue;
        found_.push_back(
            {PairKind::edge_edge, a, b, {start_a + one[0], start_a + one[1], start_b + two[0], start_b + two[1]}});
      }
    }
  }

  const Scene& scene_;
  const Points<Dim>&from_, &to_;
  double half_;
  std::vector<Vec<Dim>> drift_;               // mean displacement of each body's points
  std::vector<Box<Dim>> paths_, body_boxes_;  // of all points, of all bodies
  std::vector<std::vector<Box<Dim>>> trees_;
  std::vector<Candidate> found_;
};

}  // namespace

template <int Dim>
std::vector<Candidate> find_candidates(const typename ContactScene<Dim>::Data& scene, const Points<Dim>& from,
                                       const Points<Dim>& to, double margin) {
  return Search<Dim>(scene, from, to, margin).run();
}

template <int Dim>
std::vector<ElementPair> find_element_pairs(const typename ContactScene<Dim>::Data& scene, const Points<Dim>& at,
                                            double margin) {
  return Search<Dim>(scene, at, at, margin).element_pairs();
}

template std::vector<ElementPair> find_element_pairs<2>(const ContactScene<2>::Data&, const Points<2>&, double);
template std::vector<ElementPair> find_element_pairs<3>(const ContactScene<3>::Data&, const Points<3>&, double);
template std::vector<Candidate> find_candidates<2>(const ContactScene<2>::Data&, const Points<2>&, const Points<2>&,
                                                   double);
template std::vector<Candidate> find_candidates<3>(const ContactScene<3>::Data&, const Points<3>&, const Points<3>&,
                                                   double);

}  // namespace seiche::contact
