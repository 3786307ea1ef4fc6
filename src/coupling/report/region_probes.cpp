#include "coupling/report/region_probes.h"

#include <Eigen/Geometry>

#include "base/name_pattern.h"
#include "base/probe_spec.h"
#include "coupling/state/simulation.h"
#include "grid/interpolation.h"
#include "grid/loops.h"
#include "levelset/fractions.h"

namespace seiche {
namespace {

constexpr int parts = 4;  // along each axis of a cell or face that is looked at by points

// Length of [low, high] within [from, to].
double overlap(double low, double high, double from, double to) {
  return std::max(0.0, std::min(high, to) - std::max(low, from));
}

// The equal parts of a cell, or of a face without its axis: visit(middle, part of it within the box), as shares of the
// cell or face. `corner`: index of the cell.
template <int Dim, class Visit>
void visit_parts(const Geometry<Dim>& grid, const IVec<Dim>& corner, int flat, const Vec<Dim>& lower,
                 const Vec<Dim>& upper, const Visit& visit) {
  int count = 1;
  for (int a = 0; a < Dim; ++a) count *= a == flat ? 1 : parts;
  for (int n = 0; n < count; ++n) {
    Vec<Dim> middle = grid.lower + grid.h * corner.template cast<double>();
    double within = 1;
    for (int a = 0, left = n; a < Dim; ++a) {
      if (a == flat) continue;
      const double low = middle[a] + grid.h * (left % parts) / parts, high = low + grid.h / parts;
      within *= overlap(low, high, lower[a], upper[a]) / grid.h;
      middle[a] = 0.5 * (low + high);
      left /= parts;
    }
    visit(middle, within);
  }
}

// Share of liquid around a point, to a part of a cell: outside solids, below the surface.
template <int Dim>
class LiquidAround {
 public:
  LiquidAround(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi)
      : layout_(layout), phi_(phi), psi_(psi) {}
  double wet(const Vec<Dim>& x) const { return share(-at(phi_.data(), x, cell_offset<Dim>())); }
  double operator()(const Vec<Dim>& x) const { return wet(x) * share(at(psi_.data(), x, node_offset<Dim>())); }

 private:
  double at(const double* f, const Vec<Dim>& x, const Vec<Dim>& offset) const {
    return interpolate_linear<Dim>(layout_, f, index_coordinates<Dim>(layout_, x, offset));
  }
  double share(double depth) const { return std::clamp(0.5 + depth * parts / layout_.h(), 0.0, 1.0); }

  const Layout<Dim>& layout_;
  const CellField<Dim>& phi_;
  const NodeField<Dim>& psi_;
};

// Indices of the owned cells or faces that [lower, upper] reaches.
template <int Dim>
Box<Dim> reached(const Layout<Dim>& layout, const Box<Dim>& owned, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  Box<Dim> box = owned;
  const Geometry<Dim>& grid = layout.geometry();
  for (int a = 0; a < Dim; ++a) {
    box.lower[a] = std::max(box.lower[a], int(std::floor((lower[a] - grid.lower[a]) / grid.h)));
    box.upper[a] = std::min(box.upper[a], int(std::ceil((upper[a] - grid.lower[a]) / grid.h)));
  }
  return box;
}

template <int Dim>
bool holds_cell(const Geometry<Dim>& grid, const IVec<Dim>& i, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  const double rounding = 1e-9 * grid.h;
  const Vec<Dim> low = grid.lower + grid.h * i.template cast<double>();
  return (low.array() >= lower.array() - rounding).all() && (low.array() + grid.h <= upper.array() + rounding).all();
}

}  // namespace

template <int Dim>
double volume_in_box(const Setup<Dim>& s, const State<Dim>& state, const StepGeometry<Dim>& g, const ProbeSpec& probe) {
  const Layout<Dim>& l = s.domain.layout;
  const Vec<Dim> lower = truncate<Dim>(probe.lower), upper = truncate<Dim>(probe.upper);
  const CellField<Dim>& phi = state.liquid_phi.empty() ? state.phi : state.liquid_phi;
  const LiquidAround<Dim> liquid(l, phi, g.psi);
  const double cells = local_sum(l, reached(l, l.cells(), lower, upper), [&](Site c, const IVec<Dim>& i) {
    const double share = state.liquid.empty() ? liquid_share(l, phi, g.psi, c) : state.liquid[c];
    if (share == 0 || holds_cell(l.geometry(), i, lower, upper)) return share;
    double inside = 0, all = 0;
    visit_parts(l.geometry(), i, -1, lower, upper, [&](const Vec<Dim>& x, double within) {
      const double here = liquid(x) + 1e-12;  // a share whose place the level set does not know lies anywhere
      inside += within * here;
      all += here * std::pow(parts, -Dim);
    });
    return share * inside / all;
  });
  return s.domain.ranks.global_sum(cells) * l.geometry().cell_volume();
}

// The wet part is that where the box lies; the velocity there is linear between the faces of cells.
template <int Dim>
double flux_through_box(const Setup<Dim>& s, const State<Dim>& state, const StepGeometry<Dim>& g,
                        const FaceField<Dim>& u, const ProbeSpec& probe) {
  const Layout<Dim>& l = s.domain.layout;
  const Geometry<Dim>& grid = l.geometry();
  const Vec<Dim> lower = truncate<Dim>(probe.lower), upper = truncate<Dim>(probe.upper);
  int axis = 0;
  for (int a = 0; a < Dim; ++a)
    if (lower[a] == upper[a]) axis = a;
  const double at = (lower[axis] - grid.lower[axis]) / grid.h;
  const int low = std::clamp(int(std::floor(at)), 0, grid.cells[axis] - 1);
  Box<Dim> box = reached(l, l.cells(), lower, upper);
  box.lower[axis] = std::max(l.cells().lower[axis], low);
  box.upper[axis] = std::min(l.cells().upper[axis], low + 1);
  const LiquidAround<Dim> liquid(l, state.phi, g.psi);
  const double sum = local_sum(l, box, [&](Site c, const IVec<Dim>& i) {
    double wet = 0;
    visit_parts(grid, i, axis, lower, upper, [&](Vec<Dim> x, double within) {
      x[axis] = lower[axis];
      if (within > 0) wet += within * liquid.wet(x);
    });
    const Site high = c + l.stride(axis);
    return wet * ((low + 1 - at) * g.faces.open.at(axis, c) * u.at(axis, c) +
                  (at - low) * g.faces.open.at(axis, high) * u.at(axis, high));
  });
  return s.domain.ranks.global_sum(sum) * grid.face_area();
}

Vec3 sum_of_loads(const std::vector<SolidState>& solids, const ProbeSpec& probe) {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (const SolidState& solid : solids) {
    if (!fits_any(solid.name, probe.solids)) continue;
    force += solid.force;
    torque += solid.torque + (solid.position - probe.about).cross(solid.force);
  }
  return probe.kind == ProbeKind::torque ? torque : force;
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template double volume_in_box<D>(const Setup<D>&, const State<D>&, const StepGeometry<D>&, const ProbeSpec&);      \
  template double flux_through_box<D>(const Setup<D>&, const State<D>&, const StepGeometry<D>&, const FaceField<D>&, \
                                      const ProbeSpec&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
