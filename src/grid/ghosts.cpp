#include "grid/ghosts.h"

#include "grid/loops.h"

namespace seiche {
namespace {

// Value k steps beyond a side: `at(n)` is the value n steps inside (0 = the last one inside or on the side).
template <class At>
double beyond(Extension rule, double on_side, double steepest, int k, int inside, const At& at) {
  switch (rule) {
    case Extension::constant:
      return at(0);
    case Extension::linear:
      return inside > 1 ? at(0) + k * std::clamp(at(0) - at(1), -steepest, steepest) : at(0);
    case Extension::mirror:
      return on_side == 0 ? 2 * at(0) - at(std::min(k, inside - 1)) : at(std::min(k - 1, inside - 1));
  }
  return 0;
}

template <int Dim>
void extend_one_side(const Layout<Dim>& layout, double* f, int axis, int side, double offset, double steepest,
                     Extension rule) {
  const int n = layout.geometry().cells[axis];
  const int last = offset == 0 ? n : n - 1;  // highest index inside or on the side
  const int edge = side == 0 ? 0 : last;
  Box<Dim> box = layout.padded();
  if (side == 0) box.upper[axis] = std::min(box.upper[axis], edge);
  if (side == 1) box.lower[axis] = std::max(box.lower[axis], edge + 1);
  if (box.empty()) return;
  const Site inward = side == 0 ? layout.stride(axis) : -layout.stride(axis);
  for_each_index(layout, box, [&](Site s, const IVec<Dim>& i) {
    const int k = std::abs(i[axis] - edge);
    f[s] = beyond(rule, offset, steepest, k, last + 1, [&](int m) { return f[s + (k + m) * inward]; });
  });
}

}  // namespace

template <int Dim>
void extend_beyond_sides(const Layout<Dim>& layout, double* f, const Vec<Dim>& offset, const Extensions<Dim>& rules,
                         double steepest) {
  for (int a = 0; a < Dim; ++a) {
    if (layout.geometry().periodic[a]) continue;
    for (int side = 0; side < 2; ++side) extend_one_side(layout, f, a, side, offset[a], steepest, rules[a][side]);
  }
}

template void extend_beyond_sides<2>(const Layout<2>&, double*, const Vec<2>&, const Extensions<2>&, double);
template void extend_beyond_sides<3>(const Layout<3>&, double*, const Vec<3>&, const Extensions<3>&, double);

}  // namespace seiche
