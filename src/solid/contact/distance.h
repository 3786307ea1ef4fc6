#pragma once
// Distances between surface primitives, with the weights of their nearest points.
#include <array>

#include "base/vec.h"

namespace seiche::contact {

enum class PairKind : char { point_wall, point_element, edge_edge };

// Points of one pair: one point and then a segment (2D) or triangle (3D), or two and two points of edges.
template <int Dim>
using PairPoints = std::array<Vec<Dim>, 4>;

constexpr int points_of(PairKind kind, int dim) {
  return kind == PairKind::point_wall ? 1 : kind == PairKind::edge_edge ? 4 : dim + 1;
}
constexpr int points_of_first(PairKind kind) {
  return kind == PairKind::edge_edge ? 2 : 1;
}

// Distance of a pair. normal: unit, from the second side to the first. weight: weights of the nearest points, with sum
// 1 on the first side and -1 on the second; normal * weight is the gradient of the distance by each point. freedoms:
// number of free parameters of the nearest points (2 within a face, 1 along an edge, 0 at a corner). change:
// derivatives of the weights by these.
template <int Dim>
struct Separation {
  double distance = 0;
  Vec<Dim> normal = Vec<Dim>::Zero();
  std::array<double, 4> weight{};
  int freedoms = 0;
  std::array<std::array<double, 4>, 2> change{};
};

template <int Dim>
Separation<Dim> separate(PairKind kind, const PairPoints<Dim>& x);

template <int Dim>
Separation<Dim> separate_from_wall(const Vec<Dim>& x, const Vec<Dim>& point, const Vec<Dim>& normal);

}  // namespace seiche::contact
