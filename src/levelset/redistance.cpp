#include "levelset/redistance.h"

#include <algorithm>
#include <optional>

#include "base/parallel_range.h"
#include "grid/ghosts.h"
#include "grid/loops.h"
#include "levelset/closest_point.h"
#include "levelset/minmod.h"

namespace seiche {
namespace {

// `cell`: cell size in the units of phi. It limits the slopes beyond the sides, since |grad| of a distance is 1.
template <int Dim>
void fill_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, double cell, CellField<Dim>& phi) {
  halo.fill_ghosts(phi);
  extend_beyond_sides<Dim>(layout, phi.data(), cell_offset<Dim>(), all_sides<Dim>(Extension::linear), cell);
}

// Second difference along d, unscaled.
double second(const double* f, Site d) {
  return f[-d] - 2 * f[0] + f[d];
}

// Fraction t of the way from f[0] to f[d] at which the ENO parabola a + B t + c/2 t^2 crosses zero. The signs of f[0]
// and f[d] must differ. This form has no cancellation as c goes to zero.
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

// Closest-point redistancing: phi <- phi + w (d - phi) in cells that are not `fixed`, d the distance from the nearest
// point of the zero. w grows from 0 to 1 with the error of phi and of |grad phi| there. Adds the cells that relaxation
// must skip to `fixed`. phi in cells, ghosts filled.
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

// Data of a band cell that follow from the initial values.
template <int Dim>
struct BandCell {
  Site site;
  double sign;
  double step;                                   // pseudo-time step: 0.45 times the smallest reach
  unsigned sides;                                // bit 2 axis + side: this side is a side of the domain
  unsigned unread, unread_behind;                // the same: the next cell there is unread, the one behind it is
  std::array<std::array<double, 2>, Dim> reach;  // distance to the zero crossing towards each neighbour, or 1, cells
};

template <int Dim>
class Relaxation {
 public:
  Relaxation(const Layout<Dim>& layout, const Halo<Dim>& halo, const RedistanceOptions& options,
             const CellField<Dim, char>* kept, const CellField<Dim, char>& fixed, CellField<Dim>& phi)
      : layout_(layout),
        halo_(halo),
        limit_(options.band),
        entering_(std::min(options.entering, layout.halo())),
        kept_(kept),
        phi_(phi),
        start_(phi) {
    collect(fixed);
  }

  // Heun's method: averages two forward steps with the start.
  void run(int iterations) {
    std::vector<double> before(cells_.size());
    for (int n = 0; n < iterations; ++n) {
      for_each_cell([&](std::size_t k, double& p) { before[k] = p; });
      forward_step();
      forward_step();
      for_each_cell([&](std::size_t k, double& p) { p = 0.5 * (before[k] + p); });
      fill_ghosts_of_cells();
    }
    fill_ghosts(layout_, halo_, 1.0, phi_);
  }

 private:
  // A line of cells from the outermost one inward.
  struct Line {
    Site outermost, inward;
    friend auto operator<=>(const Line&, const Line&) = default;
  };

  void collect(const CellField<Dim, char>& fixed) {
    const std::vector<Site> sites = listed_possible(
        layout_, layout_.cells(), [&](Site s) { return any_near_band(s); },
        [&](Site s) { return start_[s] != 0 && !fixed[s] && near_band(s); });
    cells_.resize(sites.size());
    parallel_range_in_tasks(sites.size(), 4096, [&](std::size_t k) { cells_[k] = describe(sites[k]); });
    std::vector<Site> read;
    for (const Site s : sites) collect_lines(s, layout_.index(s)), collect_read(s, layout_.index(s), read);
    std::sort(read.begin(), read.end());
    read.erase(std::unique(read.begin(), read.end()), read.end());
    halo_of_cells_.emplace(halo_.part(read));
    change_.resize(cells_.size());
    std::sort(lines_.begin(), lines_.end());
    lines_.erase(std::unique(lines_.begin(), lines_.end()), lines_.end());
  }

  // Differences reach two cells along each axis: beyond the sides that are less than two cells from s.
  void collect_lines(Site s, const IVec<Dim>& i) {
    const Geometry<Dim>& g = layout_.geometry();
    for (int a = 0; a < Dim; ++a)
      for (const int side : {0, 1}) {
        if (g.periodic[a]) continue;
        const int steps = side == 0 ? i[a] : g.cells[a] - 1 - i[a];
        const Site inward = side == 0 ? layout_.stride(a) : -layout_.stride(a);
        if (steps < differences) lines_.push_back({s - steps * inward, inward});
      }
  }

  // Sites beyond this rank's cells that the differences at s read.
  void collect_read(Site s, const IVec<Dim>& i, std::vector<Site>& read) const {
    const Box<Dim>& own = layout_.cells();
    for (int a = 0; a < Dim; ++a)
      for (int n = 1; n <= differences; ++n) {
        if (i[a] - n < own.lower[a]) read.push_back(s - n * layout_.stride(a));
        if (i[a] + n >= own.upper[a]) read.push_back(s + n * layout_.stride(a));
      }
  }

  template <class Body>
  void for_each_cell(const Body& body) {
    parallel_range_in_tasks(cells_.size(), 4096, [&](std::size_t k) { body(k, phi_[cells_[k].site]); });
  }

  // Ghosts that the slopes of the cells read, as fill_ghosts() has them; it would visit all of the domain's surface.
  void fill_ghosts_of_cells() {
    halo_of_cells_->fill_ghosts(phi_);
    parallel_range_in_tasks(lines_.size(), 4096, [&](std::size_t n) {
      double* f = phi_.data() + lines_[n].outermost;
      const Site in = lines_[n].inward;
      const double rise = layout_.geometry().cells[axis_of(in)] > 1 ? std::clamp(f[0] - f[in], -1.0, 1.0) : 0;
      for (int k = 1; k <= differences; ++k) f[-k * in] = f[0] + k * rise;
    });
  }

  int axis_of(Site stride) const {
    int axis = 0;
    while (layout_.stride(axis) != std::abs(stride)) ++axis;
    return axis;
  }

  // near_band() of any of a group.
  bool any_near_band(Site s) const {
    const double* f = start_.data() + s;
    if (any_within(f, limit_)) return true;
    for (int a = 0; a < Dim; ++a)
      for (int n = 1; n <= entering_; ++n)
        if (any_within(f - n * layout_.stride(a), limit_) || any_within(f + n * layout_.stride(a), limit_)) return true;
    return false;
  }

  // True if s is in the band or at most entering_ cells from it.
  bool near_band(Site s) const {
    if (std::abs(start_[s]) < limit_) return true;
    for (int a = 0; a < Dim; ++a)
      for (int n = 1; n <= entering_; ++n)
        if (std::min(std::abs(start_[s - n * layout_.stride(a)]), std::abs(start_[s + n * layout_.stride(a)])) < limit_)
          return true;
    return false;
  }

  // True if s is next to this side of the domain. No interface lies beyond it, even if extended values change sign.
  bool at_side(Site s, int axis, int side) const {
    const Geometry<Dim>& g = layout_.geometry();
    return !g.periodic[axis] && layout_.index(s)[axis] == (side == 0 ? 0 : g.cells[axis] - 1);
  }

  bool is_unread(Site s) const { return kept_ && (*kept_)[s] == Kept::unread; }

  BandCell<Dim> describe(Site s) const {
    BandCell<Dim> c{s, start_[s] < 0 ? -1.0 : 1.0, 1.0, 0, 0, 0, {}};
    for (int a = 0; a < Dim; ++a)
      for (int side = 0; side < 2; ++side) {
        const Site d = side == 0 ? -layout_.stride(a) : layout_.stride(a);
        const unsigned bit = 1u << (2 * a + side);
        if (at_side(s, a, side)) c.sides |= bit;
        if (is_unread(s + d)) c.unread |= bit;
        if (is_unread(s + 2 * d)) c.unread_behind |= bit;
        const bool goes_on = ((c.sides | c.unread) & bit) != 0 || start_[s] * start_[s + d] >= 0;
        const double reach = goes_on ? 1 : crossing(start_.data() + s, d);
        c.reach[a][side] = std::max(reach, 1e-6);
        c.step = std::min(c.step, c.reach[a][side]);
      }
    c.step *= 0.45;
    return c;
  }

  // Values in a row of five cells along an axis, from the second before to the second behind the middle one.
  using Row = std::array<double, 5>;

  // Into unread cells the initial phi goes on straight. It does not change: phi that is relaxed by values which follow
  // it grows or shrinks without end.
  Row row(const BandCell<Dim>& c, int axis) const {
    const double* f = phi_.data() + c.site;
    const Site d = layout_.stride(axis);
    const unsigned next = c.unread >> 2 * axis & 3u, any = next | (c.unread_behind >> 2 * axis & 3u);
    Row r{f[-2 * d], f[-d], f[0], f[d], f[2 * d]};
    if (any == 0) return r;
    for (const int side : {0, 1}) {
      const Site in = side == 0 ? d : -d;
      double& near = r[side == 0 ? 1 : 3];
      if (next >> side & 1u) near = start_[c.site] + straight_slope(c.site, in, next >> (1 - side) & 1u);
      if (any >> side & 1u) r[side == 0 ? 0 : 4] = 2 * near - r[2];
    }
    return r;
  }

  // Slope of the initial phi from the direction `in` towards a cell; 0 between two walls.
  double straight_slope(Site s, Site in, bool between) const {
    const double slope = start_[s] - start_[s + in];
    return between ? 0 : std::clamp(minmod(slope, start_[s + in] - start_[s + 2 * in]), -1.0, 1.0);
  }

  // One-sided slopes along the axis, below and above. A difference ends at the interface (phi = 0) if it lies between.
  // Bends of a distance with radii of curvature above a cell are at most 1/2. At a steep peak of two cells larger ones
  // would turn slopes round, and the peak would grow through zero.
  static std::array<double, 2> slopes(const Row& f, const std::array<double, 2>& reach) {
    const double low = f[0] + f[2] - 2 * f[1], middle = f[1] + f[3] - 2 * f[2], high = f[2] + f[4] - 2 * f[3];
    const double bends[] = {std::clamp(0.5 * minmod(middle, low), -0.5, 0.5),
                            std::clamp(0.5 * minmod(middle, high), -0.5, 0.5)};
    std::array<double, 2> slope{f[1] - f[2] - bends[0], f[3] - f[2] - bends[1]};
    for (int side = 0; side < 2; ++side)
      if (reach[side] < 1) slope[side] = -f[2] / reach[side] - reach[side] * bends[side];
    return slope;
  }

  // Godunov's |grad phi| for a front moving away from the interface.
  struct Gradient {
    double norm = 0;
    bool enters = false;  // true if a part of it is upwind from beyond a side of the domain, or from an unread cell
  };
  Gradient gradient(const BandCell<Dim>& c) const {
    Gradient g;
    for (int a = 0; a < Dim; ++a) {
      const auto [below, above] = slopes(row(c, a), c.reach[a]);
      const double backward = -below * c.sign, forward = above * c.sign;
      const double steepest = std::max({backward, -forward, 0.0});
      g.norm += steepest * steepest;
      const unsigned bit = 1u << (2 * a + (steepest == backward ? 0 : 1));
      g.enters = g.enters || (steepest > 0 && ((c.sides | c.unread) & bit) != 0);
    }
    g.norm = std::sqrt(g.norm);
    return g;
  }

  // Upwind values from beyond a side or from an unread cell may make a distance grow but not shrink. They are extended
  // from inside: a lower phi at the wall makes the extended slope steeper, so that phi would shrink without end.
  double rate(const BandCell<Dim>& c) const {
    const Gradient g = gradient(c);
    return g.enters && g.norm > 1 ? 0 : 1 - g.norm;
  }

  void forward_step() {
    parallel_range_in_tasks(cells_.size(), 1024,
                            [&](std::size_t k) { change_[k] = cells_[k].step * cells_[k].sign * rate(cells_[k]); });
    for_each_cell([&](std::size_t k, double& p) { p = std::clamp(p + change_[k], -limit_, limit_); });
    fill_ghosts_of_cells();
  }

  static constexpr int differences = 2;  // cells that second differences reach

  const Layout<Dim>& layout_;
  const Halo<Dim>& halo_;
  double limit_;
  int entering_;
  const CellField<Dim, char>* kept_;
  CellField<Dim>& phi_;
  CellField<Dim> start_;
  std::vector<BandCell<Dim>> cells_;
  std::optional<Halo<Dim>> halo_of_cells_;
  std::vector<Line> lines_;  // to the sides that the cells' differences reach
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
  CellField<Dim, char> fixed(layout, 0);
  for (Site s = 0; kept && s < layout.size(); ++s) fixed[s] = (*kept)[s] != Kept::no;
  if (options.closest_point_cells > 0) {
    correct_by_closest_points(layout, options.closest_point_cells, phi, fixed);
    fill_ghosts(layout, halo, 1.0, phi);
  }
  Relaxation<Dim>(layout, halo, options, kept, fixed, phi).run(options.iterations);
  for_each_site(layout, layout.padded(), [&](Site s) { phi[s] *= h; });
}

template void redistance<2>(const Layout<2>&, const Halo<2>&, const RedistanceOptions&, CellField<2>&,
                            const CellField<2, char>*);
template void redistance<3>(const Layout<3>&, const Halo<3>&, const RedistanceOptions&, CellField<3>&,
                            const CellField<3, char>*);
template void fill_level_set_ghosts<2>(const Layout<2>&, const Halo<2>&, CellField<2>&);
template void fill_level_set_ghosts<3>(const Layout<3>&, const Halo<3>&, CellField<3>&);

}  // namespace seiche
