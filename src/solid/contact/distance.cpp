#include "solid/contact/distance.h"

#include <algorithm>
#include <limits>

namespace seiche::contact {
namespace {

// Distance and normal from the given weights.
template <int Dim>
Separation<Dim> with_weights(const PairPoints<Dim>& x, const std::array<double, 4>& weight, int count, int freedoms,
                             const std::array<std::array<double, 4>, 2>& change) {
  Vec<Dim> apart = Vec<Dim>::Zero();
  for (int i = 0; i < count; ++i) apart += weight[i] * x[i];
  const double distance = apart.norm();
  const Vec<Dim> normal = distance > 0 ? Vec<Dim>(apart / distance) : Vec<Dim>::Zero();
  return {distance, normal, weight, freedoms, change};
}

// Parameter (0 to 1) of the point on the segment a, b nearest to p.
template <int Dim>
double nearest_on_segment(const Vec<Dim>& p, const Vec<Dim>& a, const Vec<Dim>& b) {
  const Vec<Dim> along = b - a;
  const double square = along.squaredNorm();
  return square > 0 ? std::clamp((p - a).dot(along) / square, 0., 1.) : 0;
}

int freedom(double along) {
  return along > 0 && along < 1 ? 1 : 0;
}

template <int Dim>
Separation<Dim> nearer(const Separation<Dim>& one, const Separation<Dim>& other) {
  return other.distance < one.distance ? other : one;
}

Separation<2> point_segment(const PairPoints<2>& x) {
  const double t = nearest_on_segment<2>(x[0], x[1], x[2]);
  return with_weights<2>(x, {1, t - 1, -t, 0}, 3, freedom(t), {{{0, 1, -1, 0}}});
}

// The foot of the perpendicular if it lies inside the triangle, else the nearest point of the three sides.
Separation<3> point_triangle(const PairPoints<3>& x) {
  const Vec3 u = x[2] - x[1], v = x[3] - x[1], w = x[0] - x[1];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
  const double det = uu * vv - uv * uv;
  const double s = vv * wu - uv * wv, t = uu * wv - uv * wu;
  if (det > 0 && s >= 0 && t >= 0 && s + t <= det)
    return with_weights<3>(x, {1, -(1 - s / det - t / det), -s / det, -t / det}, 4, 2,
                           {{{0, 1, -1, 0}, {0, 1, 0, -1}}});
  Separation<3> best;
  best.distance = std::numeric_limits<double>::infinity();
  for (int side = 0; side < 3; ++side) {
    const int low = 1 + side, high = 1 + (side + 1) % 3;
    const double along = nearest_on_segment<3>(x[0], x[low], x[high]);
    std::array<double, 4> weight{1, 0, 0, 0}, change{};
    weight[low] = along - 1;
    weight[high] = -along;
    change[low] = 1;
    change[high] = -1;
    best = nearer(best, with_weights<3>(x, weight, 4, freedom(along), {change}));
  }
  return best;
}

// Minimum of the squared distance, a quadratic in two parameters, over the unit square: inside or on an edge of it.
Separation<3> edge_edge(const PairPoints<3>& x) {
  const Vec3 u = x[1] - x[0], v = x[3] - x[2], w = x[0] - x[2];
  Separation<3> best;
  best.distance = std::numeric_limits<double>::infinity();
  for (int end = 0; end < 2; ++end) {
    const double t = nearest_on_segment<3>(x[end], x[2], x[3]), s = nearest_on_segment<3>(x[2 + end], x[0], x[1]);
    best = nearer(best, with_weights<3>(x, {1. - end, 1. * end, t - 1, -t}, 4, freedom(t), {{{0, 0, 1, -1}}}));
    best = nearer(best, with_weights<3>(x, {1 - s, s, end - 1., -1. * end}, 4, freedom(s), {{{-1, 1, 0, 0}}}));
  }
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
  const double det = uu * vv - uv * uv, s = uv * wv - vv * wu, t = uu * wv - uv * wu;
  if (det > 0 && s > 0 && s < det && t > 0 && t < det)
    best = nearer(best, with_weights<3>(x, {1 - s / det, s / det, t / det - 1, -t / det}, 4, 2,
                                        {{{-1, 1, 0, 0}, {0, 0, 1, -1}}}));
  return best;
}

}  // namespace

template <>
Separation<2> separate<2>(PairKind, const PairPoints<2>& x) {
  return point_segment(x);
}

template <>
Separation<3> separate<3>(PairKind kind, const PairPoints<3>& x) {
  return kind == PairKind::edge_edge ? edge_edge(x) : point_triangle(x);
}

template <int Dim>
Separation<Dim> separate_from_wall(const Vec<Dim>& x, const Vec<Dim>& point, const Vec<Dim>& normal) {
  return {(x - point).dot(normal), normal, {1, 0, 0, 0}, 0, {}};
}

template Separation<2> separate_from_wall<2>(const Vec<2>&, const Vec<2>&, const Vec<2>&);
template Separation<3> separate_from_wall<3>(const Vec<3>&, const Vec<3>&, const Vec<3>&);

}  // namespace seiche::contact
