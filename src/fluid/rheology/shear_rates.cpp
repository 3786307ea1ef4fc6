#include "fluid/rheology/shear_rates.h"

#include <cmath>

namespace seiche {

template <int Dim>
bool ShearRates<Dim>::lies_in_side(int axis, const IVec<Dim>& index) const {
  const Geometry<Dim>& g = layout_.geometry();
  return !g.periodic[axis] && (index[axis] <= 0 || index[axis] >= g.cells[axis]);
}

template <int Dim>
bool ShearRates<Dim>::is_inside(const IVec<Dim>& cell) const {
  const Geometry<Dim>& g = layout_.geometry();
  for (int a = 0; a < Dim; ++a)
    if (!g.periodic[a] && (cell[a] < 0 || cell[a] >= g.cells[a])) return false;
  return true;
}

// True if the faces of d_a u_b + d_b u_a are valid: u_a on both sides along b, u_b on both sides along a.
template <int Dim>
bool ShearRates<Dim>::is_valid(int plane, Site e) const {
  if (!valid_) return true;
  const auto [a, b] = axes_of_plane<Dim>(plane);
  return valid_->at(a, e) && valid_->at(a, e - layout_.stride(b)) && valid_->at(b, e) &&
         valid_->at(b, e - layout_.stride(a));
}

template <int Dim>
double ShearRates<Dim>::shear(int plane, Site e) const {
  const auto [a, b] = axes_of_plane<Dim>(plane);
  const double along_b = u_.at(a, e) - u_.at(a, e - layout_.stride(b));
  const double along_a = u_.at(b, e) - u_.at(b, e - layout_.stride(a));
  return (along_b + along_a) / layout_.h();
}

// Mean over four sites: `site` and its neighbours one step `towards` along either axis of the plane or both. `value`
// adds its site's term to the sum and returns true, or returns false if the site does not count. 0 if none counts.
template <int Dim>
template <class Value>
double ShearRates<Dim>::mean_of_four(int plane, Site site, const IVec<Dim>& index, int towards,
                                     const Value& value) const {
  const auto [a, b] = axes_of_plane<Dim>(plane);
  double sum = 0;
  int count = 0;
  for (int corner = 0; corner < 4; ++corner) {
    Site s = site;
    IVec<Dim> i = index;
    if (corner & 1) s += towards * layout_.stride(a), i[a] += towards;
    if (corner & 2) s += towards * layout_.stride(b), i[b] += towards;
    if (value(s, i, sum)) ++count;
  }
  return count > 0 ? sum / count : 0;
}

template <int Dim>
double ShearRates<Dim>::mean_squared_shear(int plane, Site c, const IVec<Dim>& index) const {
  const auto [a, b] = axes_of_plane<Dim>(plane);
  return mean_of_four(plane, c, index, 1, [&, a = a, b = b](Site e, const IVec<Dim>& i, double& sum) {
    if (lies_in_side(a, i) || lies_in_side(b, i) || !is_valid(plane, e)) return false;
    sum += shear(plane, e) * shear(plane, e);
    return true;
  });
}

template <int Dim>
double ShearRates<Dim>::squared_rate(Site c, const IVec<Dim>& index, int left_out) const {
  double squared = 0;
  for (int a = 0; a < Dim; ++a) {
    const double stretch = (u_.at(a, c + layout_.stride(a)) - u_.at(a, c)) / layout_.h();
    squared += 2 * stretch * stretch;
  }
  for (int plane = 0; plane < EdgeField<Dim>::count; ++plane)
    if (plane != left_out) squared += mean_squared_shear(plane, c, index);
  return squared;
}

template <int Dim>
double ShearRates<Dim>::of_cell(Site c, const IVec<Dim>& index) const {
  return std::sqrt(squared_rate(c, index, no_plane));
}

// Mean over the cells of the domain around the edge.
template <int Dim>
double ShearRates<Dim>::mean_around(int plane, Site e, const IVec<Dim>& index, int left_out) const {
  return mean_of_four(plane, e, index, -1, [&](Site c, const IVec<Dim>& i, double& sum) {
    if (!is_inside(i)) return false;
    sum += squared_rate(c, i, left_out);
    return true;
  });
}

// The edge's own shear. Returns false if the edge lies on two sides of the domain, or beyond a side, or if it needs an
// invalid face. On one side, the three edges inside must be valid and the domain at least four cells wide.
template <int Dim>
bool ShearRates<Dim>::shear_at(int plane, Site e, const IVec<Dim>& index, double& value) const {
  const auto [a, b] = axes_of_plane<Dim>(plane);
  const bool in_a = lies_in_side(a, index), in_b = lies_in_side(b, index);
  if (in_a && in_b) return false;
  if (!in_a && !in_b) {
    value = shear(plane, e);
    return is_valid(plane, e);
  }
  const int axis = in_a ? a : b, cells = layout_.geometry().cells[axis];
  if (cells < 4 || (index[axis] != 0 && index[axis] != cells)) return false;
  const Site in = index[axis] == 0 ? layout_.stride(axis) : -layout_.stride(axis);
  value = 3 * shear(plane, e + in) - 3 * shear(plane, e + 2 * in) + shear(plane, e + 3 * in);
  return is_valid(plane, e + in) && is_valid(plane, e + 2 * in) && is_valid(plane, e + 3 * in);
}

template <int Dim>
double ShearRates<Dim>::of_edge(int plane, Site e, const IVec<Dim>& index) const {
  double own = 0;
  if (!shear_at(plane, e, index, own)) return std::sqrt(mean_around(plane, e, index, no_plane));
  return std::sqrt(own * own + mean_around(plane, e, index, plane));
}

template class ShearRates<2>;
template class ShearRates<3>;

}  // namespace seiche
