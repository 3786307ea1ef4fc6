#include "levelset/fractions.h"

#include <optional>

#include "grid/loops.h"

namespace seiche {
namespace {

// Visits simplices that tile the part of s with f < 0. Splits edges at the zero of f until no edge crosses it.
template <int N, class Visit>
void visit_negative(const CutSimplex<N>& s, const Visit& visit) {
  int low = -1, high = -1;
  for (int i = 0; i <= N; ++i) {
    if (s.f[i] < 0) low = i;
    if (s.f[i] > 0) high = i;
  }
  if (low < 0) return;
  if (high < 0) return visit(s);
  const double t = s.f[low] / (s.f[low] - s.f[high]);
  CutSimplex<N> near_low = s, near_high = s;
  near_low.f[high] = near_high.f[low] = 0;
  near_low.g[high] = near_high.g[low] = s.g[low] + t * (s.g[high] - s.g[low]);
  near_low.measure = t * s.measure;
  near_high.measure = (1 - t) * s.measure;
  visit_negative(near_low, visit);
  visit_negative(near_high, visit);
}

// f at the corners, those with f < 0 first.
template <int N>
struct SortedCorners {
  std::array<double, N + 1> f;
  int negative = 0;

  explicit SortedCorners(const std::array<double, N + 1>& values) {
    int last = N;
    for (const double v : values) (v < 0 ? f[negative++] : f[last--]) = v;
  }
  // Share of the edge from corner i to corner j on which f has the sign of corner i; corner j has the other sign.
  double share(int i, int j) const { return f[i] / (f[i] - f[j]); }
  // Share of the simplex cut off around corner i, the only one of its sign.
  double around(int i) const {
    double product = 1;
    for (int j = 0; j <= N; ++j)
      if (j != i) product *= share(i, j);
    return product;
  }
};

// Share of a tetrahedron with f < 0 at corners 0 and 1 only. The wedge is three tetrahedra, with ij the zero of the
// edge from i to j: (0, 1, 12, 13), (0, 02, 03, 13) and (0, 02, 12, 13).
double wedge(const SortedCorners<3>& s) {
  const double to02 = s.share(0, 2), to03 = s.share(0, 3), to12 = s.share(1, 2), to13 = s.share(1, 3);
  return to12 * to13 + to02 * to03 * (1 - to13) + to02 * (1 - to12) * to13;
}

template <class Values>
bool all_negative(const Values& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return x < 0; });
}
template <class Values>
bool none_negative(const Values& v) {
  return std::none_of(v.begin(), v.end(), [](double x) { return x < 0; });
}

// Corner values of a cube of D dimensions. Bit a of the corner's number is set if it is at the high end of axis a.
template <int D>
struct Cube {
  std::array<double, (1 << D)> f, g;
  double f_center, g_center;
};

template <int D>
double mean(const std::array<double, D>& v) {
  double s = 0;
  for (double x : v) s += x;
  return s / D;
}

// The square's part with f < 0 and g < 0, from four triangles around its centre, of the given total measure. For N = 3
// each triangle is extended to a tetrahedron by an apex with the values `apex` of f and g.
template <int N>
double square_part(const Cube<2>& q, const std::array<double, 2>& apex, double measure) {
  static constexpr int ring[5] = {0, 1, 3, 2, 0};
  double sum = 0;
  for (int e = 0; e < 4; ++e) {
    CutSimplex<N> s;
    s.f[0] = q.f[ring[e]], s.f[1] = q.f[ring[e + 1]], s.f[2] = q.f_center;
    s.g[0] = q.g[ring[e]], s.g[1] = q.g[ring[e + 1]], s.g[2] = q.g_center;
    if constexpr (N == 3) s.f[3] = apex[0], s.g[3] = apex[1];
    s.measure = measure / 4;
    sum += negative_measure_both(s);
  }
  return sum;
}

double cube_part(const Cube<2>& c) {
  return square_part<2>(c, {}, 1.0);
}

double cube_part(const Cube<3>& c) {
  double sum = 0;
  for (int a = 0; a < 3; ++a)
    for (int side = 0; side < 2; ++side) {
      Cube<2> q;
      for (int k = 0; k < 4; ++k) {
        const int corner = (side << a) | ((k & 1) << ((a + 1) % 3)) | ((k >> 1) << ((a + 2) % 3));
        q.f[k] = c.f[corner], q.g[k] = c.g[corner];
      }
      q.f_center = mean<4>(q.f), q.g_center = mean<4>(q.g);
      sum += square_part<3>(q, {c.f_center, c.g_center}, 1.0 / 6);
    }
  return sum;
}

// The low corner of a cell is that of its site.
template <int Dim>
Site corner_site(const Layout<Dim>& layout, Site cell, int corner) {
  for (int a = 0; a < Dim; ++a) cell += ((corner >> a) & 1) * layout.stride(a);
  return cell;
}

// Place of a cell in ValuesAround: beside corner `corner` of the one in the middle, on the sides that `side` tells.
template <int Dim>
int place_around(int corner, int side) {
  int place = 0;
  for (int a = Dim - 1; a >= 0; --a) place = 3 * place + (corner >> a & 1) - (side >> a & 1) + 1;
  return place;
}

// phi (f) at the corners of a cell and at its centre; g = -1: no solids.
template <int Dim>
Cube<Dim> corners_of(const ValuesAround<Dim>& phi) {
  constexpr int corners = 1 << Dim;
  Cube<Dim> c;
  for (int k = 0; k < corners; ++k) {
    double sum = 0;
    for (int m = 0; m < corners; ++m) sum += phi[std::size_t(place_around<Dim>(k, m))];
    c.f[k] = sum / corners;
    c.g[k] = -1;
  }
  c.f_center = phi[phi.size() / 2];
  return c;
}

// g = -psi at the corners.
template <int Dim>
void set_solids(const Layout<Dim>& layout, const NodeField<Dim>& psi, Site cell, Cube<Dim>& c) {
  for (int k = 0; k < 1 << Dim; ++k) c.g[k] = -psi[corner_site(layout, cell, k)];
}

// phi (f) and -psi (g) at the corners of a cell, and phi at its centre.
template <int Dim>
Cube<Dim> corners_of(const Layout<Dim>& layout, const ValuesAround<Dim>& phi, const NodeField<Dim>& psi, Site cell) {
  Cube<Dim> c = corners_of<Dim>(phi);
  set_solids(layout, psi, cell, c);
  return c;
}

// Share with f < 0 and g < 0. Sets g_center.
template <int Dim>
double share_of(Cube<Dim>& c) {
  if (none_negative(c.g) || (none_negative(c.f) && c.f_center >= 0)) return 0;
  if (all_negative(c.f) && c.f_center < 0 && all_negative(c.g)) return 1;
  c.g_center = mean<(1 << Dim)>(c.g);
  return cube_part(c);
}

// m; farther than any corner of a cell from its centre.
template <int Dim>
double far_above(const Layout<Dim>& layout) {
  return 2 * layout.h();
}

// The share of a cell that no surface comes near.
template <int Dim>
std::optional<double> plain_share(const Layout<Dim>& layout, double phi, const NodeField<Dim>& psi, Site cell) {
  const double far = far_above(layout);
  if (phi > far) return 0;
  if (phi < -far && psi[cell] > far) return 1;
  return {};
}

template <int Dim>
VolumeAndArea share_and_area_of(const Layout<Dim>& layout, Cube<Dim> c) {
  constexpr double probe = 1e-3;  // cells
  const double share = share_of(c);
  for (double& f : c.f) f -= probe * layout.h();
  c.f_center -= probe * layout.h();
  return {share, (share_of(c) - share) / probe};
}

}  // namespace

template <int Dim>
double open_part_of_face(const Layout<Dim>& layout, const NodeField<Dim>& psi, int axis, Site s) {
  if constexpr (Dim == 2) {
    const double a = psi[s], b = psi[s + layout.stride(1 - axis)];
    return negative_measure(CutSimplex<1>{{-a, -b}, {}, 1.0});
  } else {
    const Site d1 = layout.stride((axis + 1) % 3), d2 = layout.stride((axis + 2) % 3);
    Cube<2> q{{-psi[s], -psi[s + d1], -psi[s + d2], -psi[s + d1 + d2]}, {-1, -1, -1, -1}, 0, -1};
    if (all_negative(q.f)) return 1;
    if (none_negative(q.f)) return 0;
    q.f_center = mean<4>(q.f);
    return square_part<2>(q, {}, 1.0);
  }
}

template <int N>
double negative_measure(const CutSimplex<N>& s) {
  const SortedCorners<N> corners(s.f);
  if (corners.negative == 0) return 0;
  if (corners.negative == N + 1) return s.measure;
  if (corners.negative == 1) return s.measure * corners.around(0);
  if (corners.negative == N) return s.measure * (1 - corners.around(N));
  if constexpr (N == 3) return s.measure * wedge(corners);
  return 0;  // no other count in one or two dimensions
}

template <int N>
double negative_measure_both(const CutSimplex<N>& s) {
  if (none_negative(s.f) || none_negative(s.g)) return 0;
  if (all_negative(s.g)) return negative_measure(s);
  double sum = 0;
  visit_negative(s, [&](const CutSimplex<N>& part) {
    sum += negative_measure(CutSimplex<N>{part.g, part.f, part.measure});
  });
  return sum;
}

template <int Dim>
void open_fractions(const Layout<Dim>& layout, const NodeField<Dim>& psi, FaceField<Dim>& open) {
  for (int a = 0; a < Dim; ++a) {
    Box<Dim> box = layout.grown(2);
    for (int b = 0; b < Dim; ++b) box.upper[b] = std::min(box.upper[b], layout.padded().upper[b] - 1);
    for_each_site(layout, box, [&](Site s) { open.at(a, s) = open_part_of_face(layout, psi, a, s); });
  }
}

template <int Dim>
ValuesAround<Dim> values_around(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell) {
  ValuesAround<Dim> values;
  for (std::size_t n = 0; n < values.size(); ++n) {
    Site at = cell;
    for (int a = 0, rest = int(n); a < Dim; ++a, rest /= 3) at += (rest % 3 - 1) * layout.stride(a);
    values[n] = phi[at];
  }
  return values;
}

template <int Dim>
double liquid_share(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi, Site cell) {
  if (const std::optional<double> plain = plain_share(layout, phi[cell], psi, cell)) return *plain;
  Cube<Dim> c = corners_of(layout, values_around(layout, phi, cell), psi, cell);
  return share_of(c);
}

template <int Dim>
double liquid_share(const Layout<Dim>& layout, const ValuesAround<Dim>& phi, const NodeField<Dim>& psi, Site cell) {
  if (const std::optional<double> plain = plain_share(layout, phi[phi.size() / 2], psi, cell)) return *plain;
  Cube<Dim> c = corners_of(layout, phi, psi, cell);
  return share_of(c);
}

template <int Dim>
double liquid_share(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell) {
  if (std::abs(phi[cell]) > far_above(layout)) return phi[cell] < 0;
  Cube<Dim> c = corners_of<Dim>(values_around(layout, phi, cell));
  return share_of(c);
}

template <int Dim>
double open_share(const Layout<Dim>& layout, const NodeField<Dim>& psi, Site cell) {
  if (psi[cell] > far_above(layout)) return 1;
  Cube<Dim> c;
  c.f.fill(-1);
  c.f_center = -1;
  set_solids(layout, psi, cell, c);
  return share_of(c);
}

template <int Dim>
double local_liquid_volume(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi) {
  return layout.geometry().cell_volume() * local_sum_of_possible(
                                               layout, layout.cells(),
                                               [&](Site s) { return !all_above(phi.data() + s, far_above(layout)); },
                                               [&](Site s) { return liquid_share(layout, phi, psi, s); });
}

template <int Dim>
VolumeAndArea share_and_area(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi,
                             Site cell) {
  if (const std::optional<double> plain = plain_share(layout, phi[cell], psi, cell)) return {*plain, 0};
  return share_and_area_of(layout, corners_of(layout, values_around(layout, phi, cell), psi, cell));
}

template <int Dim>
VolumeAndArea share_and_area(const Layout<Dim>& layout, const ValuesAround<Dim>& phi, const NodeField<Dim>& psi,
                             Site cell) {
  if (const std::optional<double> plain = plain_share(layout, phi[phi.size() / 2], psi, cell)) return {*plain, 0};
  return share_and_area_of(layout, corners_of(layout, phi, psi, cell));
}

template <int Dim>
VolumeAndArea local_volume_and_area(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi) {
  const auto may_matter = [&](Site s) { return !all_above(phi.data() + s, far_above(layout)); };
  const VolumeAndArea sum = local_sum_of_possible(layout, layout.cells(), may_matter,
                                                  [&](Site s) { return share_and_area(layout, phi, psi, s); });
  const double cell = layout.geometry().cell_volume();
  return {cell * sum.volume, cell / layout.h() * sum.area};
}

template double negative_measure<1>(const CutSimplex<1>&);
template double negative_measure<2>(const CutSimplex<2>&);
template double negative_measure<3>(const CutSimplex<3>&);
template double negative_measure_both<2>(const CutSimplex<2>&);
template double negative_measure_both<3>(const CutSimplex<3>&);
template double open_part_of_face<2>(const Layout<2>&, const NodeField<2>&, int, Site);
template double open_part_of_face<3>(const Layout<3>&, const NodeField<3>&, int, Site);
template void open_fractions<2>(const Layout<2>&, const NodeField<2>&, FaceField<2>&);
template void open_fractions<3>(const Layout<3>&, const NodeField<3>&, FaceField<3>&);
template double liquid_share<2>(const Layout<2>&, const CellField<2>&, const NodeField<2>&, Site);
template double liquid_share<3>(const Layout<3>&, const CellField<3>&, const NodeField<3>&, Site);
template double liquid_share<2>(const Layout<2>&, const CellField<2>&, Site);
template double liquid_share<2>(const Layout<2>&, const ValuesAround<2>&, const NodeField<2>&, Site);
template ValuesAround<2> values_around<2>(const Layout<2>&, const CellField<2>&, Site);
template double liquid_share<3>(const Layout<3>&, const CellField<3>&, Site);
template double liquid_share<3>(const Layout<3>&, const ValuesAround<3>&, const NodeField<3>&, Site);
template ValuesAround<3> values_around<3>(const Layout<3>&, const CellField<3>&, Site);
template double open_share<2>(const Layout<2>&, const NodeField<2>&, Site);
template double open_share<3>(const Layout<3>&, const NodeField<3>&, Site);
template double local_liquid_volume<2>(const Layout<2>&, const CellField<2>&, const NodeField<2>&);
template double local_liquid_volume<3>(const Layout<3>&, const CellField<3>&, const NodeField<3>&);
template VolumeAndArea share_and_area<2>(const Layout<2>&, const CellField<2>&, const NodeField<2>&, Site);
template VolumeAndArea share_and_area<2>(const Layout<2>&, const ValuesAround<2>&, const NodeField<2>&, Site);
template VolumeAndArea share_and_area<3>(const Layout<3>&, const CellField<3>&, const NodeField<3>&, Site);
template VolumeAndArea share_and_area<3>(const Layout<3>&, const ValuesAround<3>&, const NodeField<3>&, Site);
template VolumeAndArea local_volume_and_area<2>(const Layout<2>&, const CellField<2>&, const NodeField<2>&);
template VolumeAndArea local_volume_and_area<3>(const Layout<3>&, const CellField<3>&, const NodeField<3>&);

}  // namespace seiche
