#include "fluid/viscosity/viscous_shares.h"

#include "grid/loops.h"
#include "levelset/fractions.h"

namespace seiche {
namespace {

template <int Dim>
constexpr int corner_count = 1 << Dim;

// Two functions at the corners of a cube. Bit a of a corner's number is set if it is at the high end of axis a.
template <int Dim>
struct Corners {
  std::array<double, corner_count<Dim>> phi, solid;
};

// Means of both functions over the corners that agree with `corner` along all axes that are not in the mask `free`.
template <int Dim>
std::pair<double, double> mean_over(const Corners<Dim>& c, int corner, int free) {
  double f = 0, g = 0;
  int count = 0;
  for (int k = 0; k < corner_count<Dim>; ++k) {
    if ((k ^ corner) & ~free) continue;
    f += c.phi[k], g += c.solid[k], ++count;
  }
  return {f / count, g / count};
}

// Fraction of a unit cube with phi < 0 and solid < 0, over the simplices (corner, middle of an edge, ..., centre).
// Equivariant under all rotations of the grid, exact for planes.
template <int Dim>
double cut_share(const Corners<Dim>& c) {
  std::array<int, Dim> order;
  for (int a = 0; a < Dim; ++a) order[a] = a;
  const double measure = 1.0 / (corner_count<Dim> * (Dim == 2 ? 2 : 6));
  double sum = 0;
  do {
    for (int corner = 0; corner < corner_count<Dim>; ++corner) {
      CutSimplex<Dim> s;
      s.measure = measure;
      int free = 0;
      for (int n = 0; n <= Dim; ++n) {
        std::tie(s.f[n], s.g[n]) = mean_over(c, corner, free);
        if (n < Dim) free |= 1 << order[n];
      }
      sum += negative_measure_both(s);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return std::min(sum, 1.0);
}

template <int Dim>
double share(const Corners<Dim>& c) {
  const auto negative = [](double x) { return x < 0; };
  const auto all = [&](const auto& v) { return std::all_of(v.begin(), v.end(), negative); };
  const auto none = [&](const auto& v) { return std::none_of(v.begin(), v.end(), negative); };
  if (none(c.phi) || none(c.solid)) return 0;
  if (all(c.phi) && all(c.solid)) return 1;
  return cut_share(c);
}

// Mean over the sites reached from s by stepping back along any of the axes in the mask `back`, s included.
template <int Dim, class At>
double mean_back(const Layout<Dim>& layout, Site s, int back, const At& at) {
  double sum = 0;
  int count = 0;
  for (int m = 0; m < corner_count<Dim>; ++m) {
    if (m & ~back) continue;
    Site t = s;
    for (int a = 0; a < Dim; ++a) t -= ((m >> a) & 1) * layout.stride(a);
    sum += at(t), ++count;
  }
  return sum / count;
}

template <int Dim>
class Measure {
 public:
  explicit Measure(const ViscousInput<Dim>& in) : in_(in), layout_(in.layout) {
    for (const ViscousSolid<Dim>& s : in.solids) any_void_ = any_void_ || !s.no_slip;
  }

  // V of the box of cell s, shifted down by half a cell along the axes in the mask `half`.
  double at(Site s, int half) const {
    const double near = 3 * layout_.h();  // farther than the corners
    if (in_.phi[s] > near) return 0;
    if (in_.phi[s] < -near && (!any_void_ || in_.psi[s] > near)) return 1;
    Corners<Dim> c;
    constexpr int every = corner_count<Dim> - 1;
    for (int k = 0; k < corner_count<Dim>; ++k) {
      // Corners are at cell centres along the axes of `half`, at faces along the others.
      Site cell = s, node = s;
      for (int a = 0; a < Dim; ++a) {
        const bool high = (k >> a) & 1, is_half = (half >> a) & 1;
        cell += (is_half ? high - 1 : high) * layout_.stride(a);
        node += high * layout_.stride(a);
      }
      c.phi[k] = mean_back(layout_, cell, every & ~half, [&](Site t) { return in_.phi[t]; });
      c.solid[k] = any_void_ ? -mean_back(layout_, node, half, [&](Site t) { return void_distance(t); }) : -near;
    }
    return share(c);
  }

 private:
  // Distance from free-slip solids. Nodes nearer to a no-slip solid ignore them.
  double void_distance(Site node) const {
    const int k = in_.body[node];
    return k < 0 || in_.solids[k].no_slip ? 3 * layout_.h() : in_.psi[node];
  }

  const ViscousInput<Dim>& in_;
  const Layout<Dim>& layout_;
  bool any_void_ = false;
};

}  // namespace

template <int Dim>
ViscousShares<Dim> viscous_shares(const ViscousInput<Dim>& in) {
  ViscousShares<Dim> r{CellField<Dim>(in.layout), EdgeField<Dim>(in.layout)};
  const Measure<Dim> measure(in);
  for_each_site(in.layout, in.layout.grown(1), [&](Site s) {
    r.cell[s] = measure.at(s, 0);
    for (int p = 0; p < planes<Dim>; ++p) {
      const auto [a, b] = plane_axes<Dim>(p);
      r.edge[p][std::size_t(s)] = measure.at(s, (1 << a) | (1 << b));
    }
  });
  return r;
}

template ViscousShares<2> viscous_shares<2>(const ViscousInput<2>&);
template ViscousShares<3> viscous_shares<3>(const ViscousInput<3>&);

}  // namespace seiche
