#include "fluid/volume/swept_region.h"

#include <Eigen/Geometry>

namespace seiche {
namespace {

// Gradient of signed_measure() in the facet's first corner: the cofactors of its edge.
Vec<2> gradient_in_first(const Vec<2>& origin, const std::array<Vec<2>, 2>& facet) {
  const Vec<2> e = facet[1] - origin;
  return {0.5 * e[1], -0.5 * e[0]};
}
Vec<3> gradient_in_first(const Vec<3>& origin, const std::array<Vec<3>, 3>& facet) {
  return (facet[1] - origin).cross(facet[2] - origin) / 6;
}

// In 2D the corners of a face across the second axis run clockwise round the region on its low side.
template <int Dim>
double turn(int axis) {
  return Dim == 2 && axis == 1 ? -1 : 1;
}

constexpr double most_beyond = 0.5;  // cells by which a cap's middle may leave the box around the corners

// True if corner k of a face lies before the next one along the edge between them.
bool runs_upward(int k) {
  return k < 2;
}

}  // namespace

template <int Dim>
void SweptRegion<Dim>::add(const Facet& facet) {
  Simplex<Dim> s;
  s.corner[0] = origin_;
  for (int k = 0; k < Dim; ++k) s.corner[k + 1] = facet.corner[k];
  s.measure = facet.sign * signed_measure<Dim>(origin_, facet.corner);
  sum_ += s.measure;
  if (s.measure != 0) simplices_[std::size_t(count_++)] = s;
}

// The surface swept by an edge is cut along its shorter diagonal, for all faces and mirror images alike. Of equal ones,
// the one from the edge's lower end now counts.
template <>
void SweptRegion<3>::add_sides(const TracedFace<3>& f) {
  for (int k = 0; k < 4; ++k) {
    const int l = (k + 1) % 4;
    const Vec<3>&x = f.now[k], &y = f.now[l], &x0 = f.before[k], &y0 = f.before[l];
    const double own = (x - y0).squaredNorm(), other = (y - x0).squaredNorm();
    if (runs_upward(k) ? own <= other : own < other) {
      add({{x, x0, y0}, 1});
      add({{x, y0, y}, 1});
    } else {
      add({{y, x, x0}, 1});
      add({{y, x0, y0}, 1});
    }
  }
}

template <>
void SweptRegion<2>::add_sides(const TracedFace<2>& f) {
  add({{f.now[1], f.before[1]}, turn<2>(f.axis)});
  add({{f.before[0], f.now[0]}, turn<2>(f.axis)});
}

template <>
std::array<SweptRegion<3>::Facet, 4> SweptRegion<3>::cap(const TracedFace<3>& f, const Vec<3>& middle) const {
  std::array<Facet, 4> r;
  for (std::size_t k = 0; k < 4; ++k) r[k] = {{middle, f.before[(k + 1) % 4], f.before[k]}, 1};
  return r;
}

template <>
std::array<SweptRegion<2>::Facet, 2> SweptRegion<2>::cap(const TracedFace<2>& f, const Vec<2>& middle) const {
  return {Facet{{middle, f.before[0]}, turn<2>(f.axis)}, Facet{{middle, f.before[1]}, -turn<2>(f.axis)}};
}

// The volume is linear in the cap's middle m: V(m + t g) = V(m) + t g.g with g its gradient.
template <int Dim>
SweptRegion<Dim>::SweptRegion(const TracedFace<Dim>& face, double volume) : origin_(face.now[0]) {
  add_sides(face);
  Vec<Dim> middle = Vec<Dim>::Zero(), gradient = Vec<Dim>::Zero();
  for (const Vec<Dim>& x : face.before) middle += x / TracedFace<Dim>::count;
  double sum = sum_;
  for (const Facet& f : cap(face, middle)) {
    sum += f.sign * signed_measure<Dim>(origin_, f.corner);
    gradient += f.sign * gradient_in_first(origin_, f.corner);
  }
  if (const double g2 = gradient.squaredNorm(); g2 > 0) middle += (volume - sum) / g2 * gradient;
  lowest_ = highest_ = face.now[0];
  for (std::size_t k = 0; k < face.now.size(); ++k) {
    lowest_ = lowest_.cwiseMin(face.now[k]).cwiseMin(face.before[k]);
    highest_ = highest_.cwiseMax(face.now[k]).cwiseMax(face.before[k]);
  }
  middle = middle.array().max(lowest_.array() - most_beyond).min(highest_.array() + most_beyond);
  lowest_ = lowest_.cwiseMin(middle), highest_ = highest_.cwiseMax(middle);
  for (const Facet& f : cap(face, middle)) add(f);
}

template class SweptRegion<2>;
template class SweptRegion<3>;

}  // namespace seiche
