#include "coupling/tension/contact_angle.h"

#include "coupling/geometry/cell_distance.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "grid/interpolation.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

constexpr int wall_layers = 3;  // layers (cells) behind a wall that curvature stencils next to it read

double cotangent(double degrees) {
  return degrees == 90 ? 0 : 1 / std::tan(degrees * 3.14159265358979323846 / 180);
}

// Weight from 0, the surface runs along the wall, to 1, it meets the wall. It depends on the fraction of grad phi along
// the wall. The flattest contact angle, 20 degrees, has the fraction 0.34.
double meets(double along, double norm) {
  const double t = std::clamp((along / norm - 0.1) / 0.2, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Unit vector e of the part of grad phi perpendicular to `normal`. `weight`: meets() there; 0 if that part vanishes.
template <int Dim>
struct Tangent {
  Vec<Dim> e = Vec<Dim>::Zero();
  double weight = 0;
};

// x: index coordinates of cell centres. f: phi.
template <int Dim>
Tangent<Dim> tangent_at(const Layout<Dim>& layout, const double* f, const Vec<Dim>& x, const Vec<Dim>& normal) {
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) {
    const Vec<Dim> step = Vec<Dim>::Unit(a);
    g[a] = 0.5 * (interpolate_linear<Dim>(layout, f, x + step) - interpolate_linear<Dim>(layout, f, x - step));
  }
  const Vec<Dim> t = g - g.dot(normal) * normal;
  const double norm = g.norm(), along = t.norm();
  if (!(along > 1e-12 * norm)) return {};
  return {t / along, meets(along, norm)};
}

// Fills one layer of cells beyond a side from the layer before it, shifted by cot(angle) cells. Layer 1 reads the
// outermost layer inside.
template <int Dim>
class BeyondSide {
 public:
  BeyondSide(const Layout<Dim>& layout, int axis, int side, double shift, CellField<Dim>& phi)
      : layout_(layout), axis_(axis), out_(side == 0 ? -1 : 1), shift_(shift), phi_(phi) {}

  void fill(int layer) {
    Box<Dim> box = layout_.cells();
    if (box.empty() || !(out_ < 0 ? layout_.at_lower(axis_) : layout_.at_upper(axis_))) return;
    for (int b = 0; b < axis_; ++b) {
      box.lower[b] = layout_.authority().lower[b];
      box.upper[b] = layout_.authority().upper[b];
    }
    const int first = out_ < 0 ? -1 : layout_.geometry().cells[axis_];
    box.lower[axis_] = first + out_ * (layer - 1);
    box.upper[axis_] = box.lower[axis_] + 1;
    const CellField<Dim> old = phi_;
    for_each_index(layout_, box, [&](Site s, const IVec<Dim>& i) { phi_[s] = value(old, s, i); });
  }

 private:
  double value(const CellField<Dim>& old, Site s, const IVec<Dim>& i) const {
    const Vec<Dim> x = i.template cast<double>() - out_ * Vec<Dim>::Unit(axis_);
    const Vec<Dim> normal = Vec<Dim>::Unit(axis_);
    const Vec<Dim> inside = x - out_ * normal;  // here differences along the normal use cells of the flow only
    const Tangent<Dim> t = tangent_at<Dim>(layout_, old.data(), inside, normal);
    const double met = interpolate_cubic<Dim>(layout_, old.data(), x - shift_ * t.e);
    return (1 - t.weight) * old[s] + t.weight * met;
  }

  const Layout<Dim>& layout_;
  int axis_, out_;
  double shift_;
  CellField<Dim>& phi_;
};

bool is_wall(SideType type) {
  return type == SideType::free_slip || type == SideType::no_slip || type == SideType::moving_wall;
}

template <int Dim>
void continue_beyond_walls(const Domain<Dim>& domain, const Fluids& fluids, CellField<Dim>& phi) {
  const double shift = cotangent(fluids.liquid.contact_angle);
  for (int a = 0; a < Dim; ++a)
    for (int layer = 1; layer <= wall_layers; ++layer) {
      for (int side = 0; side < 2; ++side)
        if (is_wall(domain.sides.type(a, side))) BeyondSide<Dim>(domain.layout, a, side, shift, phi).fill(layer);
      domain.halo.fill_ghosts(phi);
    }
}

// A cell inside a solid, the point (index coordinates) whose phi it takes, and the weight of that value.
template <int Dim>
struct Buried {
  Site site;
  Vec<Dim> from;
  double weight;
};

template <int Dim>
double shift_at(const Fluids& fluids, const Solids<Dim>& solids, const StepGeometry<Dim>& g, Site cell) {
  const SolidSpec& solid = solids.bodies[std::size_t(g.body[cell])].spec();
  return cotangent(solid.contact_angle.value_or(fluids.liquid.contact_angle));
}

// Cells inside solids near the surface of the liquid. At depth d (cells) below the solid's surface, phi comes from
// min(2 d, 1) cells towards the flow. Up to d = 1/2 that mirrors phi; deeper cells continue it along straight lines.
template <int Dim>
std::vector<Buried<Dim>> buried_cells(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                      const StepGeometry<Dim>& g, const CellField<Dim>& phi) {
  std::vector<Buried<Dim>> cells;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    if (std::abs(phi[c]) > (wall_layers + 2) * domain.layout.h()) return;
    const auto [psi, slope] = distance_at_cell<Dim>(domain.layout, g.psi, c);
    const double d = -psi / domain.layout.h();
    if (d <= 0 || d > wall_layers || slope.norm() == 0 || g.body[c] < 0) return;
    const Vec<Dim> out = slope.normalized(), x = i.template cast<double>();
    const double up = std::min(2 * d, 1.0);
    const Tangent<Dim> t = tangent_at<Dim>(domain.layout, phi.data(), x + (std::min(d, 1.0) + 1) * out, out);
    cells.push_back({c, x + up * (out - shift_at(fluids, solids, g, c) * t.e), t.weight});
  });
  return cells;
}

// Each pass carries phi about one cell deeper. Cells next to the solid's surface read each other, hence the iteration.
template <int Dim>
void continue_into_solids(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                          const StepGeometry<Dim>& g, CellField<Dim>& phi) {
  constexpr int passes = 2 * wall_layers;
  const std::vector<Buried<Dim>> cells = buried_cells(domain, fluids, solids, g, phi);
  std::vector<double> straight(cells.size()), next(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) straight[n] = phi[cells[n].site];
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t n = 0; n < cells.size(); ++n)
      next[n] = (1 - cells[n].weight) * straight[n] +
                cells[n].weight * interpolate_cubic<Dim>(domain.layout, phi.data(), cells[n].from);
    for (std::size_t n = 0; n < cells.size(); ++n) phi[cells[n].site] = next[n];
    domain.halo.fill_ghosts(phi);
  }
}

}  // namespace

template <int Dim>
CellField<Dim> continue_at_contact_angle(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                         const StepGeometry<Dim>& g, const CellField<Dim>& phi) {
  CellField<Dim> continued = phi;
  fill_level_set_ghosts(domain.layout, domain.halo, continued);
  if (!solids.bodies.empty()) continue_into_solids(domain, fluids, solids, g, continued);
  continue_beyond_walls(domain, fluids, continued);
  return continued;
}

template CellField<2> continue_at_contact_angle<2>(const Domain<2>&, const Fluids&, const Solids<2>&,
                                                   const StepGeometry<2>&, const CellField<2>&);
template CellField<3> continue_at_contact_angle<3>(const Domain<3>&, const Fluids&, const Solids<3>&,
                                                   const StepGeometry<3>&, const CellField<3>&);

}  // namespace seiche
