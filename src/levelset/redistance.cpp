#include "levelset/redistance.h"

#include "grid/ghosts.h"
#include "grid/loops.h"
#include "grid/parallel_range.h"
#include "levelset/closest_point.h"

namespace seiche {
namespace {

double minmod(double a, double b) {
  return a * b <= 0 ? 0 : (std::abs(a) < std::abs(b) ? a : b);
}

// `cell` is the cell size in the units of phi: no distance changes faster.
template <int Dim>
void fill_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, double cell, CellField<Dim>& phi) {
  halo.fill_ghosts(phi);
  extend_beyond_sides<Dim>(layout, phi.data(), cell_offset<Dim>(), all_sides<Dim>(Extension::linear), cell);
}

// Second difference along d, unscaled.
double second(const double* f, Site d) {
  return f[-d] - 2 * f[0] + f[d];
}

// Share t of the way from f[0] to f[d] at which the ENO parabola a + B t + c/2 t^2 crosses zero; signs of f[0], f[d]
// differ. Written so that nothing cancels as c goes to zero.
double crossing(const double* f, Site d) {
  const double c = minmod(second(f, d), second(f + d, d)), a = f[0], b = f[d];
  const double B = b - a - c / 2;
  const double theta = -2 * a / (B + std::copysign(std::sqrt(std::max(0.0, B * B - 2 * a * c)), B));
  return theta > 0 && theta < 1 ? theta : a / (a - b);
}

// |grad phi| by fourth-order central differences.
template <int Dim>
double smooth_norm(const Layout<Dim>& layout, const double* f) {
  double sum = 0;
  for (int a = 0; a < Dim; ++a) {
    const Site d = layout.stride(a);
    const double slope = (8 * (f[d] - f[-d]) - (f[2 * d] - f[-2 * d])) / 12;
    sum += slope * slope;
  }
  return std::sqrt(sum);
}

// phi <- phi + w (d - phi), d the distance of the nearest point of the zero, w from 0 to 1 as phi or its slope there is
// off, but for fixed cells; marks the cells that relaxation is to leave alone. phi in cells, ghosts filled.
template <int Dim>
void correct_by_closest_points(const Layout<Dim>& layout, double reach, CellField<Dim>& phi,
                               CellField<Dim, char>& fixed) {
  constexpr double none = 0.02, all = 0.1;
  const CellField<Dim> start = phi;
  for_each_index(layout, layout.cells(), [&](Site s, const IVec<Dim>& i) {
    if (fixed[s] || std::abs(start[s]) >= reach) return;
    const auto foot = foot_on_zero(layout, start, i, reach);
    if (!foot) {
      fixed[s] = std::abs(smooth_norm(layout, start.data() + s) - 1) < all;
      return;
    }
    fixed[s] = 1;
    const double d = foot->distance;
    const double off = std::max(std::abs(foot->slope - 1), std::abs(start[s] - d) / std::max(1.0, std::abs(d)));
    phi[s] += std::clamp((off - none) / (all - none), 0.0, 1.0) * (d - start[s]);
  });
}

// What the relaxation needs of a band cell's initial values: for each neighbour, the distance in cells to the zero
// crossing or 1, and the smallest of these for the step.
template <int Dim>
struct BandCell {
  Site site;
  double sign;
  double step;
  unsigned sides;  // bit 2 axis + side: no cell of the domain beyond
  std::array<std::array<double, 2>, Dim> reach;
};

template <int Dim>
class Relaxation {
 public:
  Relaxation(const Layout<Dim>& layout, const Halo<Dim>& halo, const RedistanceOptions& options,
             const CellField<Dim, char>& fixed, CellField<Dim>& phi)
      : layout_(layout),
        halo_(halo),
        limit_(options.band),
        entering_(std::min(options.entering, layout.halo())),
        phi_(phi),
        start_(phi) {
    collect(fixed);
  }

  // Heun steps: two forward steps averaged with the start.
  void run(int iterations) {
    std::vector<double> before(cells_.size());
    for (int n = 0; n < iterations; ++n) {
      for (std::size_t k = 0; k < cells_.size(); ++k) before[k] = phi_[cells_[k].site];
      forward_step();
      forward_step();
      for (std::size_t k = 0; k < cells_.size(); ++k) {
        double& p = phi_[cells_[k].site];
        p = 0.5 * (before[k] + p);
      }
      fill_ghosts(layout_, halo_, 1.0, phi_);
    }
  }

 private:
  void collect(const CellField<Dim, char>& fixed) {
    for_each_index_in_order(layout_, layout_.cells(), [&](Site s, const IVec<Dim>&) {
      if (start_[s] != 0 && !fixed[s] && near_band(s)) cells_.push_back(describe(s));
    });
    change_.resize(cells_.size());
  }

  // In the band, or close enough for the interface to have brought the band here.
  bool near_band(Site s) const {
    if (std::abs(start_[s]) < limit_) return true;
    for (int a = 0; a < Dim; ++a)
      for (int n = 1; n <= entering_; ++n)
        if (std::min(std::abs(start_[s - n * layout_.stride(a)]), std::abs(start_[s + n * layout_.stride(a)])) < limit_)
          return true;
    return false;
  }

  // Beyond a side of the domain there is no interface to stop at, whatever sign the continued values take.
  bool at_side(Site s, int axis, int side) const {
    const Geometry<Dim>& g = layout_.geometry();
    return !g.periodic[axis] && layout_.index(s)[axis] == (side == 0 ? 0 : g.cells[axis] - 1);
  }

  BandCell<Dim> describe(Site s) const {
    BandCell<Dim> c{s, start_[s] < 0 ? -1.0 : 1.0, 1.0, 0, {}};
    for (int a = 0; a < Dim; ++a)
      for (int side = 0; side < 2; ++side) {
        const Site d = side == 0 ? -layout_.stride(a) : layout_.stride(a);
        if (at_side(s, a, side)) c.sides |= 1u << (2 * a + side);
        const double reach = at_side(s, a, side) || start_[s] * start_[s + d] >= 0 ? 1 : crossing(start_.data() + s, d);
        c.reach[a][side] = std::max(reach, 1e-6);
        c.step = std::min(c.step, c.reach[a][side]);
      }
    c.step *= 0.45;
    return c;
  }

  // One-sided slope along +-axis, ending at the interface where it lies between (phi = 0 there).
  double slope(const BandCell<Dim>& c, int axis, int side) const {
    const Site d = side == 0 ? -layout_.stride(axis) : layout_.stride(axis);
    const double* f = phi_.data() + c.site;
    const double reach = c.reach[axis][side];
    const double rise = reach < 1 ? -f[0] : f[d] - f[0];
    return rise / reach - 0.5 * reach * minmod(second(f, d), second(f + d, d));
  }

  // Godunov's |grad phi| for a front moving away from the interface, and whether part of it enters through a side.
  struct Gradient {
    double norm = 0;
    bool enters = false;
  };
  Gradient gradient(const BandCell<Dim>& c) const {
    Gradient g;
    for (int a = 0; a < Dim; ++a) {
      const double backward = -slope(c, a, 0) * c.sign, forward = slope(c, a, 1) * c.sign;
      const double steepest = std::max({backward, -forward, 0.0});
      g.norm += steepest * steepest;
      g.enters = g.enters || (steepest > 0 && (c.sides >> (2 * a + (steepest == backward ? 0 : 1)) & 1u));
    }
    g.norm = std::sqrt(g.norm);
    return g;
  }

  // Beyond a side phi only continues what is inside: a distance must not shrink on its word, or it would shrink without
  // end (a lower phi at the wall makes the continued slope steeper). It may grow.
  double rate(const BandCell<Dim>& c) const {
    const Gradient g = gradient(c);
    return g.enters && g.norm > 1 ? 0 : 1 - g.norm;
  }

  void forward_step() {
    parallel_range_in_tasks(cells_.size(), 1024,
                            [&](std::size_t k) { change_[k] = cells_[k].step * cells_[k].sign * rate(cells_[k]); });
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      double& p = phi_[cells_[k].site];
      p = std::clamp(p + change_[k], -limit_, limit_);
    }
    fill_ghosts(layout_, halo_, 1.0, phi_);
  }

  const Layout<Dim>& layout_;
  const Halo<Dim>& halo_;
  double limit_;
  int entering_;
  CellField<Dim>& phi_;
  CellField<Dim> start_;
  std::vector<BandCell<Dim>> cells_;
  std::vector<double> change_;
};

}  // namespace

template <int Dim>
void fill_level_set_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, CellField<Dim>& phi) {
  fill_ghosts(layout, halo, layout.h(), phi);
}

template <int Dim>
void redistance(const Layout<Dim>& layout, const Halo<Dim>& halo, const RedistanceOptions& options, CellField<Dim>& phi,
                const CellField<Dim, char>* kept) {
  const double h = layout.h(), limit = options.band;
  for_each_site(layout, layout.cells(), [&](Site s) { phi[s] = std::clamp(phi[s] / h, -limit, limit); });
  fill_ghosts(layout, halo, 1.0, phi);
  CellField<Dim, char> fixed = kept ? *kept : CellField<Dim, char>(layout, 0);
  if (options.closest_point_cells > 0) {
    correct_by_closest_points(layout, options.closest_point_cells, phi, fixed);
    fill_ghosts(layout, halo, 1.0, phi);
  }
  Relaxation<Dim>(layout, halo, options, fixed, phi).run(options.iterations);
  for_each_site(layout, layout.padded(), [&](Site s) { phi[s] *= h; });
}

template void redistance<2>(const Layout<2>&, const Halo<2>&, const RedistanceOptions&, CellField<2>&,
                            const CellField<2, char>*);
template void redistance<3>(const Layout<3>&, const Halo<3>&, const RedistanceOptions&, CellField<3>&,
                            const CellField<3, char>*);
template void fill_level_set_ghosts<2>(const Layout<2>&, const Halo<2>&, CellField<2>&);
template void fill_level_set_ghosts<3>(const Layout<3>&, const Halo<3>&, CellField<3>&);

}  // namespace seiche
