#include "coupling/transport/initial_surface.h"

#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/transport/level_in_solids.h"
#include "coupling/transport/transport.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// True for shapes whose values are not distances near their zero.
bool needs_redistancing(const ShapeSpec& s) {
  return s.kind == "expression";
}

template <int Dim>
class Regions {
 public:
  Regions(double band, const std::vector<std::unique_ptr<ShapeField<Dim>>>& shapes) : band_(band), shapes_(shapes) {}

  double operator()(const Vec<Dim>& x) const {
    double d = band_;
    for (const auto& shape : shapes_) d = std::min(d, (*shape)(x));
    return std::max(d, -band_);
  }

  // True if linear interpolation between two cell centres places the surface within a tenth of a cell of the shapes'
  // own. `low`, `high`: phi at x and x + step.
  bool is_straight(const Vec<Dim>& x, const Vec<Dim>& step, double low, double high) const {
    constexpr double margin = 0.1;
    const double share = low / (low - high);
    const bool before = share < margin || is_inside(x + (share - margin) * step) == (low < 0);
    const bool behind = share > 1 - margin || is_inside(x + (share + margin) * step) == (high < 0);
    return before && behind;
  }

  // Fraction of the way from x to x + step at which liquid begins or ends, by bisection. `inside`: x is in liquid.
  double crossing(const Vec<Dim>& x, const Vec<Dim>& step, bool inside) const {
    double low = 0, high = 1;
    for (int n = 0; n < 20; ++n) {
      const double middle = 0.5 * (low + high);
      (is_inside(x + middle * step) == inside ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  bool is_inside(const Vec<Dim>& x) const { return (*this)(x) < 0; }

  double band_;
  const std::vector<std::unique_ptr<ShapeField<Dim>>>& shapes_;
};

// body(axis, neighbour, step to it) for the neighbours of a cell within the domain on the surface's other side. Neither
// cell is closed: a formula that jumps inside a solid does not locate the surface outside.
template <int Dim, class Body>
void for_each_across(const Layout<Dim>& layout, const CellField<Dim>& phi, const CellField<Dim, char>& closed, Site c,
                     const IVec<Dim>& i, const Body& body) {
  if (closed[c]) return;
  for (int a = 0; a < Dim; ++a)
    for (const int way : {-1, 1}) {
      const Site other = c + way * layout.stride(a);
      const int there = i[a] + way;
      if (there < 0 || there >= layout.geometry().cells[a] || closed[other]) continue;
      if ((phi[c] < 0) == (phi[other] < 0)) continue;
      Vec<Dim> step = Vec<Dim>::Zero();
      step[a] = way * layout.h();
      body(a, other, step);
    }
}

// True if a formula jumps and its values at cell centres misplace its zero. Distances change by at most a cell between
// neighbours; a change of more than two is a jump. Collective.
template <int Dim>
bool misplaces_zero(const Domain<Dim>& domain, const Regions<Dim>& regions, const CellField<Dim, char>& closed,
                    const CellField<Dim>& phi) {
  bool misplaced = false;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    if (misplaced) return;
    const Vec<Dim> x = domain.layout.position(i, cell_offset<Dim>());
    for_each_across(domain.layout, phi, closed, c, i, [&](int, Site other, const Vec<Dim>& step) {
      const bool jumps = std::abs(phi[c] - phi[other]) > 2 * domain.layout.h();
      misplaced = misplaced || (jumps && !regions.is_straight(x, step, phi[c], phi[other]));
    });
  });
  return domain.ranks.any(misplaced);
}

// Sets cells beside the zero to their distance from the plane through the zeros theta_a h away along the axes,
//   d = h / sqrt(sum 1/theta_a^2).
// All other cells get +-band: values that a jump leaves farther off would displace the zero. Collective.
template <int Dim>
void place_zero(const Domain<Dim>& domain, const Regions<Dim>& regions, const CellField<Dim, char>& closed,
                CellField<Dim>& phi) {
  constexpr double least = 1e-3;
  const CellField<Dim> old = phi;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    const Vec<Dim> x = domain.layout.position(i, cell_offset<Dim>());
    Vec<Dim> inverse = Vec<Dim>::Zero();
    for_each_across(domain.layout, old, closed, c, i, [&](int a, Site, const Vec<Dim>& step) {
      inverse[a] = std::max(inverse[a], 1 / std::max(least, regions.crossing(x, step, old[c] < 0)));
    });
    phi[c] = std::copysign(inverse.isZero(0) ? domain.band() : domain.layout.h() / inverse.norm(), old[c]);
  });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
}

}  // namespace

template <int Dim>
CellField<Dim> initial_surface(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                               const StepGeometry<Dim>& g,
                               const std::vector<std::unique_ptr<ShapeField<Dim>>>& shapes) {
  CellField<Dim> phi(domain.layout, domain.band());
  const Regions<Dim> distance(domain.band(), shapes);
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    phi[c] = distance(domain.layout.position(i, cell_offset<Dim>()));
  });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  const auto& regions = fluids.liquid.regions;
  const CellField<Dim, char> closed = closed_cells(domain, solids, g);
  if (std::any_of(regions.begin(), regions.end(), [](const auto& r) { return needs_redistancing(r.shape); })) {
    if (misplaces_zero(domain, distance, closed, phi)) place_zero(domain, distance, closed, phi);
    const RedistanceOptions options{domain.band() / domain.layout.h(), 40, domain.layout.halo(),
                                    closest_point_band(fluids)};
    redistance_beside_solids(domain, solids, closed, options, 20, phi);
  }
  return phi;
}

template <int Dim>
bool fill_domain(const Domain<Dim>& domain, const std::vector<std::unique_ptr<ShapeField<Dim>>>& shapes) {
  const Regions<Dim> distance(domain.band(), shapes);
  bool dry = false;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site, const IVec<Dim>& i) {
    dry = dry || !(distance(domain.layout.position(i, cell_offset<Dim>())) < 0);
  });
  return !domain.ranks.any(dry);
}

template CellField<2> initial_surface<2>(const Domain<2>&, const Fluids&, const Solids<2>&, const StepGeometry<2>&,
                                         const std::vector<std::unique_ptr<ShapeField<2>>>&);
template CellField<3> initial_surface<3>(const Domain<3>&, const Fluids&, const Solids<3>&, const StepGeometry<3>&,
                                         const std::vector<std::unique_ptr<ShapeField<3>>>&);
template bool fill_domain<2>(const Domain<2>&, const std::vector<std::unique_ptr<ShapeField<2>>>&);
template bool fill_domain<3>(const Domain<3>&, const std::vector<std::unique_ptr<ShapeField<3>>>&);

}  // namespace seiche
