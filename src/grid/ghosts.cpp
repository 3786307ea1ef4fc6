#include "grid/ghosts.h"

#include "grid/field_values.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// The stored sites beyond a side. May be empty.
template <int Dim>
Box<Dim> box_beyond(const Layout<Dim>& layout, int axis, int side, double offset) {
  const int n = layout.geometry().cells[axis];
  const int edge = side == 0 ? 0 : (offset == 0 ? n : n - 1);  // outermost index inside or on the side
  Box<Dim> box = layout.padded();
  if (side == 0) box.upper[axis] = std::min(box.upper[axis], edge);
  if (side == 1) box.lower[axis] = std::max(box.lower[axis], edge + 1);
  return box;
}

// The sites on one side of the domain or next to it, from which those beyond are filled.
struct Side {
  Site inward;     // step
  int beyond;      // sites to fill
  int inside;      // sites from there to the other side
  double on_side;  // 0: values lie on the side, else half a cell from it
};

// Fills the sites beyond p, the outermost one inside or on the side. Values inside are p[0], p[inward], ...
void extend_constant(double* p, const Side& side) {
  for (int k = 1; k <= side.beyond; ++k) set_if_other(p[-k * side.inward], p[0]);
}

void extend_linear(double* p, const Side& side, double steepest) {
  const double rise = side.inside > 1 ? std::clamp(p[0] - p[side.inward], -steepest, steepest) : 0;
  for (int k = 1; k <= side.beyond; ++k) set_if_other(p[-k * side.inward], p[0] + k * rise);
}

void extend_mirrored(double* p, const Side& side) {
  const int last = side.inside - 1;
  for (int k = 1; k <= side.beyond; ++k)
    set_if_other(p[-k * side.inward], side.on_side == 0 ? 2 * p[0] - p[std::min(k, last) * side.inward]
                                                        : p[std::min(k - 1, last) * side.inward]);
}

template <int Dim>
void extend_one_side(const Layout<Dim>& layout, double* f, int axis, int side, double offset, double steepest,
                     Extension rule) {
  Box<Dim> box = box_beyond(layout, axis, side, offset);
  if (box.empty()) return;
  const int n = layout.geometry().cells[axis], last = offset == 0 ? n : n - 1, edge = side == 0 ? 0 : last;
  const Side at{side == 0 ? layout.stride(axis) : -layout.stride(axis), box.upper[axis] - box.lower[axis], last + 1,
                offset};
  box.lower[axis] = edge, box.upper[axis] = edge + 1;
  switch (rule) {
    case Extension::constant:
      return for_each_site(layout, box, [&](Site s) { extend_constant(f + s, at); });
    case Extension::linear:
      return for_each_site(layout, box, [&](Site s) { extend_linear(f + s, at, steepest); });
    case Extension::mirror:
      return for_each_site(layout, box, [&](Site s) { extend_mirrored(f + s, at); });
  }
}

// Steps from the nearest site inside to index i. 0 along periodic axes and along axes where i is inside.
template <int Dim>
IVec<Dim> steps_beyond(const Layout<Dim>& layout, const IVec<Dim>& i, const Vec<Dim>& offset) {
  IVec<Dim> steps = IVec<Dim>::Zero();
  for (int a = 0; a < Dim; ++a) {
    const int n = layout.geometry().cells[a];
    if (!layout.geometry().periodic[a]) steps[a] = i[a] - std::clamp(i[a], 0, offset[a] == 0 ? n : n - 1);
  }
  return steps;
}

// Fills a site beyond several sides if all of them are extended linearly:
//   f(s) = f(p) + sum_a k_a clamp(slope_a(p)),  p the nearest site inside, k_a the steps from it along axis a.
// Extension axis by axis would depend on the order of the axes, because slopes are limited.
template <int Dim>
void extend_edge(const Layout<Dim>& layout, double* f, Site s, const IVec<Dim>& steps, const Extensions<Dim>& rules,
                 double steepest) {
  Site nearest = s;
  for (int a = 0; a < Dim; ++a) {
    if (steps[a] != 0 && rules[a][steps[a] > 0] != Extension::linear) return;
    nearest -= steps[a] * layout.stride(a);
  }
  double value = f[nearest];
  for (int a = 0; a < Dim; ++a) {
    const Site inward = steps[a] > 0 ? -layout.stride(a) : layout.stride(a);
    if (steps[a] != 0 && layout.geometry().cells[a] > 1)
      value += std::abs(steps[a]) * std::clamp(f[nearest] - f[nearest + inward], -steepest, steepest);
  }
  set_if_other(f[s], value);
}

// Fills the sites beyond both a side of axis a and a side of axis b.
template <int Dim>
void extend_edges(const Layout<Dim>& layout, double* f, int a, int b, const Vec<Dim>& offset, double steepest,
                  const Extensions<Dim>& rules) {
  if (layout.geometry().periodic[a] || layout.geometry().periodic[b]) return;
  for (const int sides : {0, 1, 2, 3}) {
    const Box<Dim> box = box_beyond(layout, a, sides & 1, offset[a]).cut(box_beyond(layout, b, sides >> 1, offset[b]));
    if (box.empty()) continue;
    for_each_index(layout, box, [&](Site s, const IVec<Dim>& i) {
      extend_edge<Dim>(layout, f, s, steps_beyond<Dim>(layout, i, offset), rules, steepest);
    });
  }
}

}  // namespace

template <int Dim>
void extend_beyond_sides(const Layout<Dim>& layout, double* f, const Vec<Dim>& offset, const Extensions<Dim>& rules,
                         double steepest) {
  for (int a = 0; a < Dim; ++a) {
    if (layout.geometry().periodic[a]) continue;
    for (int side = 0; side < 2; ++side) extend_one_side(layout, f, a, side, offset[a], steepest, rules[a][side]);
  }
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < a; ++b) extend_edges<Dim>(layout, f, a, b, offset, steepest, rules);
}

template void extend_beyond_sides<2>(const Layout<2>&, double*, const Vec<2>&, const Extensions<2>&, double);
template void extend_beyond_sides<3>(const Layout<3>&, double*, const Vec<3>&, const Extensions<3>&, double);

}  // namespace seiche
