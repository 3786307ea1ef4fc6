#pragma once
// Broad phase: pairs of primitives that can come near each other along linear paths of their points.
#include <limits>

#include "solid/contact/distance.h"
#include "solid/contact/motion.h"

namespace seiche::contact {

struct Candidate {
  PairKind kind;
  int first, second;          // bodies; `second` is a wall for point_wall
  std::array<int, 4> points;  // in the list of all points
  // Two parts of one body: their distance at rest (m). Parts that are near at rest do not repel each other.
  double apart_at_rest = std::numeric_limits<double>::infinity();
  double edges_at_rest = 0;  // as pair_energy() takes it

  double reach(double reach) const { return std::min(reach, 0.5 * apart_at_rest); }
};

template <int Dim>
using Points = std::vector<Vec<Dim>>;

// All pairs with at least one moving body that may come within `margin` during the motion, both ends included. Pairs
// within a deformable body count if they have no point in common. The order depends on the input only.
template <int Dim>
std::vector<Candidate> find_candidates(const typename ContactScene<Dim>::Data& scene, const Points<Dim>& from,
                                       const Points<Dim>& to, double margin);

// Elements of two bodies, or of one deformable body, whose boxes are within `margin` of each other.
struct ElementPair {
  int first_body, first, second_body, second;
};
template <int Dim>
std::vector<ElementPair> find_element_pairs(const typename ContactScene<Dim>::Data& scene, const Points<Dim>& at,
                                            double margin);

template <int Dim>
PairPoints<Dim> gather(const Candidate& pair, const Points<Dim>& points) {
  PairPoints<Dim> x;
  for (int i = 0; i < points_of(pair.kind, Dim); ++i) x[i] = points[pair.points[i]];
  for (int i = points_of(pair.kind, Dim); i < 4; ++i) x[i].setZero();
  return x;
}

template <int Dim>
Separation<Dim> separate(const typename ContactScene<Dim>::Data& scene, const Candidate& pair,
                         const PairPoints<Dim>& x) {
  if (pair.kind != PairKind::point_wall) return separate<Dim>(pair.kind, x);
  return separate_from_wall<Dim>(x[0], scene.walls[pair.second].point, scene.walls[pair.second].normal);
}

}  // namespace seiche::contact
