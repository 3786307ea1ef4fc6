#include "fluid/boundary/inflow.h"

#include "fluid/boundary/inflow_places.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Entry point of liquid whose path crosses a side at x: x itself if liquid enters there. Else the centre of its face if
// liquid enters there, since the formula's inflow may end within a face. Else the centre of the nearest adjacent face
// that lets liquid in; empty if none does.
template <int Dim>
std::optional<Vec<Dim>> nearest_inflow(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, int axis, int side,
                                       const Vec<Dim>& x, double t) {
  constexpr int neighbours = Dim == 2 ? 3 : 9;
  const Vec<Dim> own = center_of_face(layout, axis, x);
  if (sides.inward_speed(axis, side, own, t) > 0) return sides.inward_speed(axis, side, x, t) > 0 ? x : own;
  std::optional<Vec<Dim>> nearest;
  for (int n = 0; n < neighbours; ++n) {
    Vec<Dim> to = own;
    for (int b = 1, left = n; b < Dim; ++b, left /= 3) to[(axis + b) % Dim] += (left % 3 - 1) * layout.h();
    const Vec<Dim> there = center_of_face(layout, axis, bring_inside(layout, axis, to));
    if (sides.inward_speed(axis, side, there, t) <= 0) continue;
    if (!nearest || (there - x).norm() < (*nearest - x).norm()) nearest = there;
  }
  return nearest;
}

// Prescribed velocity component at a face (index i) projected onto the side: the mean over the side's faces that it
// touches and that let liquid in. It touches one for the component across the side, two for those along it. Empty if
// none lets liquid in.
template <int Dim>
std::optional<double> inflow_beside(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, int axis, int side,
                                    int component, const IVec<Dim>& i, double t) {
  const Geometry<Dim>& g = layout.geometry();
  double sum = 0;
  int count = 0;
  for (int n = component == axis ? 0 : -1; n <= 0; ++n) {
    IVec<Dim> cell = i;
    if (component != axis) cell[component] += n;
    bool within = true;
    for (int b = 0; b < Dim; ++b)
      within = within && (b == axis || g.periodic[b] || (cell[b] >= 0 && cell[b] < g.cells[b]));
    if (!within) continue;
    Vec<Dim> x = layout.position(cell, cell_offset<Dim>());
    x[axis] = side_position(layout, axis, side);
    x = bring_inside(layout, axis, x);
    if (sides.inward_speed(axis, side, x, t) <= 0) continue;
    sum += sides.velocity(axis, side, component, x, t);
    ++count;
  }
  return count > 0 ? std::optional<double>(sum / count) : std::nullopt;
}

// Fills the layers of one component beyond a side: u(k-th outside) = 2 u_side - u(k-th inside), k <= odd_layers.
template <int Dim>
void continue_component(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, int axis, int side, double t,
                        int component, FaceField<Dim>& u) {
  constexpr int odd_layers = 2;
  const int n = layout.geometry().cells[axis], on_side = component == axis ? 0 : 1;
  const int edge = side == 0 ? 0 : n - on_side;
  const Site inward = (side == 0 ? 1 : -1) * layout.stride(axis);
  Box<Dim> box = layout.padded();
  const int layers = side == 0 ? edge - box.lower[axis] : box.upper[axis] - 1 - edge;
  if (layers <= 0) return;
  box.lower[axis] = edge, box.upper[axis] = edge + 1;
  for_each_index_in_order(layout, box, [&](Site s, const IVec<Dim>& i) {
    const auto given = inflow_beside(layout, sides, axis, side, component, i, t);
    if (!given) return;
    double* v = &u.at(component, s);
    for (int k = 1; k <= layers; ++k)
      v[-k * inward] = 2 * *given - v[(std::min({k, odd_layers, n}) - on_side) * inward];
  });
}

// Fills the layers of the component across a side: u(k-th outside) = 2 u(side) - u(k-th inside), k <= odd_layers.
template <int Dim>
void continue_straight(const Layout<Dim>& layout, int axis, int side, FaceField<Dim>& u) {
  constexpr int odd_layers = 2;
  const int n = layout.geometry().cells[axis], edge = side == 0 ? 0 : n;
  const Site inward = (side == 0 ? 1 : -1) * layout.stride(axis);
  Box<Dim> box = layout.padded();
  const int layers = side == 0 ? edge - box.lower[axis] : box.upper[axis] - 1 - edge;
  if (layers <= 0) return;
  box.lower[axis] = edge, box.upper[axis] = edge + 1;
  for_each_index_in_order(layout, box, [&](Site s, const IVec<Dim>&) {
    double* v = &u.at(axis, s);
    for (int k = 1; k <= layers; ++k) v[-k * inward] = 2 * v[0] - v[std::min({k, odd_layers, n}) * inward];
  });
}

}  // namespace

// The path is at to + r (from - to) at time r dt before its end.
template <int Dim>
std::optional<Entry<Dim>> find_entry(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, const Vec<Dim>& from,
                                     const Vec<Dim>& to, double t, double dt) {
  std::optional<Entry<Dim>> last;
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      if (sides.type(a, side) != SideType::inflow) continue;
      const double at = side_position(layout, a, side), inward = side == 0 ? 1 : -1;
      if ((to[a] - at) * inward <= 0 || (from[a] - at) * inward >= 0) continue;
      const double share = (to[a] - at) / (to[a] - from[a]);
      Entry<Dim> e{a, side, to + share * (from - to), t + (1 - share) * dt, share * dt};
      e.x[a] = at;
      const auto x = nearest_inflow(layout, sides, a, side, bring_inside(layout, a, e.x), e.time);
      if (!x || (last && last->inside < e.inside)) continue;
      e.x = *x;
      last = e;
    }
  return last;
}

template <int Dim>
Vec<Dim> velocity_of(const DomainBoundary<Dim>& sides, const Entry<Dim>& e) {
  Vec<Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = sides.velocity(e.axis, e.side, a, e.x, e.time);
  return v;
}

// Only the component across the side is set: faces of the others lie within the stream or the air.
template <int Dim>
void let_air_follow(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t,
                    const FaceField<Dim, char>& valid, FaceField<Dim>& u) {
  for (int axis = 0; axis < Dim; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (sides.type(axis, side) != SideType::inflow) continue;
      const int edge = side == 0 ? 0 : layout.geometry().cells[axis];
      const Site inward = (side == 0 ? 1 : -1) * layout.stride(axis);
      Box<Dim> box = layout.padded();
      const int layers = side == 0 ? edge - box.lower[axis] : box.upper[axis] - 1 - edge;
      if (layers < 0) continue;
      box.lower[axis] = edge, box.upper[axis] = edge + 1;
      for_each_index_in_order(layout, box, [&](Site s, const IVec<Dim>& i) {
        if (valid.at(axis, s)) return;
        const Vec<Dim> x = bring_inside(layout, axis, layout.position(i, face_offset<Dim>(axis)));
        if (sides.inward_speed(axis, side, x, t) > 0 || !nearest_inflow(layout, sides, axis, side, x, t)) return;
        for (int k = 0; k <= layers; ++k) u.at(axis, s - k * inward) = u.at(axis, s + inward);
      });
    }
}

template <int Dim>
void continue_beyond_inflows(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t, FaceField<Dim>& u) {
  for (int axis = 0; axis < Dim; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (sides.type(axis, side) == SideType::waves) continue_straight(layout, axis, side, u);
      if (sides.type(axis, side) != SideType::inflow) continue;
      for (int component = 0; component < Dim; ++component)
        continue_component(layout, sides, axis, side, t, component, u);
    }
}

template <int Dim>
std::vector<Site> cells_beyond_inflows(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t) {
  std::vector<Site> cells;
  for (int axis = 0; axis < Dim; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (sides.type(axis, side) != SideType::inflow) continue;
      const int n = layout.geometry().cells[axis];
      Box<Dim> box = layout.padded();
      const int layers = side == 0 ? -box.lower[axis] : box.upper[axis] - n;
      if (layers <= 0) continue;
      box.lower[axis] = side == 0 ? -1 : n, box.upper[axis] = box.lower[axis] + 1;
      const Site outward = (side == 0 ? -1 : 1) * layout.stride(axis);
      for_each_index_in_order(layout, box, [&](Site c, const IVec<Dim>& i) {
        Vec<Dim> x = layout.position(i, cell_offset<Dim>());
        x[axis] = side_position(layout, axis, side);
        x = center_of_face(layout, axis, bring_inside(layout, axis, x));
        if (!(sides.inward_speed(axis, side, x, t) > 0)) return;
        for (int k = 0; k < layers; ++k) cells.push_back(c + k * outward);
      });
    }
  return cells;
}

#define SEICHE_INSTANTIATE(D)                                                                                    \
  template std::optional<Entry<D>> find_entry<D>(const Layout<D>&, const DomainBoundary<D>&, const Vec<D>&,      \
                                                 const Vec<D>&, double, double);                                 \
  template Vec<D> velocity_of<D>(const DomainBoundary<D>&, const Entry<D>&);                                     \
  template void continue_beyond_inflows<D>(const Layout<D>&, const DomainBoundary<D>&, double, FaceField<D>&);   \
  template std::vector<Site> cells_beyond_inflows<D>(const Layout<D>&, const DomainBoundary<D>&, double);        \
  template void let_air_follow<D>(const Layout<D>&, const DomainBoundary<D>&, double, const FaceField<D, char>&, \
                                  FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
