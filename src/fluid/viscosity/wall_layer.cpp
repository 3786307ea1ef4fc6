#include "fluid/viscosity/wall_layer.h"

#include "grid/loops.h"

namespace seiche {
namespace {

// The stored sites beyond a side. `edge`: index of the outermost site inside or on the side.
template <int Dim>
Box<Dim> beyond_side(const Layout<Dim>& layout, int axis, int side, int edge) {
  Box<Dim> box = layout.padded();
  (side == 0 ? box.upper[axis] : box.lower[axis]) = side == 0 ? edge : edge + 1;
  return box.cut(layout.padded());
}

// b h^2 of the parabola u_wall + a y + b y^2. u0 and u1 are its means over the layers [0, h] and [h, 2h], or its values
// in their middle.
double curvature(FaceValues values, double wall, double u0, double u1) {
  return values == FaceValues::means ? 0.75 * (u1 - wall) - 2.25 * (u0 - wall)
                                     : 2.0 / 3 * (u1 - wall) - 2 * (u0 - wall);
}

// Extends the normal component: u(-y) = u(y).
template <int Dim>
void continue_across(const Layout<Dim>& layout, int axis, int side, FaceField<Dim>& u) {
  const int n = layout.geometry().cells[axis], edge = side == 0 ? 0 : n;
  const Site inward = (side == 0 ? 1 : -1) * layout.stride(axis);
  for_each_index(layout, beyond_side(layout, axis, side, edge), [&](Site s, const IVec<Dim>& i) {
    const int k = std::abs(i[axis] - edge);
    double* v = &u.at(axis, s);
    *v = v[(k + std::min(k, n)) * inward];
  });
}

// Extends a tangential component: u(k-th beyond) = 2 u_wall - u(k-th inside) + 2 b y^2. The mean of y^2 over the layer
// is h^2 (k^2 - k + 1/3), its value in the middle h^2 (k - 1/2)^2. Beyond the first layer, the even part is limited to
// the odd part in magnitude: in badly resolved flow at the wall it would grow with k^2.
template <int Dim>
void continue_along(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, int axis, int side, double t,
                    int component, FaceValues values, FaceField<Dim>& u) {
  const int n = layout.geometry().cells[axis], edge = side == 0 ? 0 : n - 1;
  const double middle = values == FaceValues::means ? 1.0 / 3 : 0.25;
  const Site inward = (side == 0 ? 1 : -1) * layout.stride(axis);
  for_each_index_in_order(layout, beyond_side(layout, axis, side, edge), [&](Site s, const IVec<Dim>& i) {
    const int k = std::abs(i[axis] - edge);
    double* v = &u.at(component, s);
    Vec<Dim> x = layout.position(i, face_offset<Dim>(component));
    x[axis] = layout.geometry().lower[axis] + (side == 0 ? 0 : n * layout.h());
    const double wall = sides.velocity(axis, side, component, x, t);
    const double b = curvature(values, wall, v[k * inward], v[(k + 1) * inward]);
    const double odd = wall - v[(k + std::min(k, n) - 1) * inward], even = 2 * b * (k * k - k + middle);
    *v = wall + odd + (k == 1 ? even : std::clamp(even, -std::abs(odd), std::abs(odd)));
  });
}

// The side whose adjacent layer of cells along an axis contains the face (0 lower, 1 upper), or -1.
template <int Dim>
int wall_beside(const Layout<Dim>& layout, int component, int axis, const IVec<Dim>& i) {
  if (component == axis || layout.geometry().periodic[axis] || layout.geometry().cells[axis] < 2) return -1;
  return i[axis] == 0 ? 0 : i[axis] == layout.geometry().cells[axis] - 1 ? 1 : -1;
}

template <int Dim>
bool is_near_opening(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, int axis, const IVec<Dim>& i) {
  const int n = layout.geometry().cells[axis];
  const auto opens = [&](int side) {
    const SideType type = sides.type(axis, side);
    return type == SideType::inflow || type == SideType::outflow || type == SideType::waves;
  };
  return !layout.geometry().periodic[axis] && ((i[axis] < 3 && opens(0)) || (i[axis] > n - 3 && opens(1)));
}

}  // namespace

template <int Dim>
char least_along(const Layout<Dim>& layout, const FieldValues<char>& mask, int component, int axis, int reach, Site f,
                 const IVec<Dim>& i) {
  const bool ends = !layout.geometry().periodic[axis];
  const int last = layout.geometry().cells[axis] - (axis == component ? 0 : 1);
  const int from = ends ? std::max(-reach, -i[axis]) : -reach, to = ends ? std::min(reach, last - i[axis]) : reach;
  char least = 1;
  for (int k = from; k <= to; ++k) least = std::min<char>(least, mask[f + k * layout.stride(axis)] != 0);
  return least;
}

template <int Dim>
void continue_beyond_walls(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t, FaceValues values,
                           FaceField<Dim>& u) {
  for (int b = 0; b < Dim; ++b)
    for (int side = 0; side < 2; ++side) {
      if (layout.geometry().periodic[b] || layout.geometry().cells[b] < 2 || !sides.sticks(b, side)) continue;
      continue_across(layout, b, side, u);
      for (int a = 0; a < Dim; ++a)
        if (a != b) continue_along(layout, sides, b, side, t, a, values, u);
    }
}

template <int Dim>
FaceField<Dim, char> whole_faces(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides,
                                 const FaceField<Dim, char>& valid) {
  FaceField<Dim, char> whole(layout);
  for (int a = 0; a < Dim; ++a)
    for_each_index(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      char& is_whole = whole.at(a, f) = 1;
      for (int b = 0; b < Dim && is_whole; ++b)
        is_whole = !is_near_opening(layout, sides, b, i) && least_along(layout, valid[a], a, b, 2, f, i) != 0;
    });
  return whole;
}

template <int Dim>
double excess_of_mean(const Layout<Dim>& layout, const FaceField<Dim>& u, int axis, Site f) {
  double sum = 0;
  const double* v = &u.at(axis, f);
  for (int b = 0; b < Dim; ++b)
    if (const Site d = layout.stride(b); b != axis) sum += v[-d] - 2 * v[0] + v[d];
  return sum / 24;
}

// Next to a wall the correction is 2 b h^2 - ((u1 - u0) - 2 (u0 - u_wall)), u_wall = (ghost + 5/2 u0 - 1/2 u1)/3.
template <int Dim>
double missing_laplacian(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, const FaceField<Dim>& u, int axis,
                         Site f, const IVec<Dim>& i) {
  double sum = 0;
  const double* v = &u.at(axis, f);
  for (int b = 0; b < Dim; ++b) {
    const Site d = layout.stride(b);
    const int side = wall_beside(layout, axis, b, i);
    if (side >= 0 && sides.sticks(b, side)) {
      const Site in = side == 0 ? d : -d;
      const double wall = (v[-in] + 2.5 * v[0] - 0.5 * v[in]) / 3;
      sum += 2 * curvature(FaceValues::means, wall, v[0], v[in]) - (v[in] - 3 * v[0] + 2 * wall);
    } else {
      sum -= (v[-2 * d] - 4 * v[-d] + 6 * v[0] - 4 * v[d] + v[2 * d]) / 12;
    }
  }
  return sum;
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template char least_along<D>(const Layout<D>&, const FieldValues<char>&, int, int, int, Site, const IVec<D>&);     \
  template void continue_beyond_walls<D>(const Layout<D>&, const DomainBoundary<D>&, double, FaceValues,             \
                                         FaceField<D>&);                                                             \
  template FaceField<D, char> whole_faces<D>(const Layout<D>&, const DomainBoundary<D>&, const FaceField<D, char>&); \
  template double excess_of_mean<D>(const Layout<D>&, const FaceField<D>&, int, Site);                               \
  template double missing_laplacian<D>(const Layout<D>&, const DomainBoundary<D>&, const FaceField<D>&, int, Site,   \
                                       const IVec<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
