#include "coupling/transport/filling.h"

#include <algorithm>
#include <map>

#include "coupling/transport/drifting.h"
#include "coupling/transport/restore.h"
#include "fluid/volume/neighbours.h"
#include "fluid/volume/volume_transport.h"
#include "grid/groups.h"
#include "grid/interpolation.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

constexpr double margin = 0.05;         // share of a cell beyond its room that does not count
constexpr double farthest = 2;          // cells from the surface
constexpr double counted_level = -0.5;  // cells

struct FillingCell {
  Site cell;
  double air;  // what fills it, as a share of it
};

template <int Dim>
bool is_beside_liquid(const Layout<Dim>& layout, const CellField<Dim>& phi, Site c) {
  for (int a = 0; a < Dim; ++a)
    if (phi[c - layout.stride(a)] < 0 || phi[c + layout.stride(a)] < 0) return true;
  return false;
}

template <int Dim>
constexpr int points_along = Dim == 2 ? 6 : 4;
template <int Dim>
constexpr int points_of_cell = Dim == 2 ? 36 : 64;

// Centre of one of the equal parts of a cell, from its lower corner, in cells.
template <int Dim>
Vec<Dim> point_of_cell(int number) {
  Vec<Dim> offset;
  for (int a = 0; a < Dim; ++a, number /= points_along<Dim>)
    offset[a] = (number % points_along<Dim> + 0.5) / points_along<Dim>;
  return offset;
}

// The cell around x.
template <int Dim>
Site cell_at(const Layout<Dim>& layout, const Vec<Dim>& x) {
  const Vec<Dim> g = (x - layout.geometry().lower) / layout.h();
  IVec<Dim> cell;
  for (int a = 0; a < Dim; ++a) cell[a] = int(std::floor(g[a]));
  return layout.site(cell);
}

// Place of the liquid in cells: phi up to the level that gives a cell its share. phi alone misses gaps below a cell.
template <int Dim>
class LiquidAtPoints {
 public:
  LiquidAtPoints(const Layout<Dim>& layout, const FillingStep<Dim>& step, const CellField<Dim>& phi)
      : layout_(layout), share_(step.share), room_(step.room), phi_(phi), width_(layout.h() / points_along<Dim>) {}

  // Share of liquid around a point.
  double operator()(const Vec<Dim>& x) {
    const Site c = cell_at(layout_, x);
    const double room = room_.of(c);
    if (room < little) return liquid(phi_at(x), 0);
    const double share = share_[c] / room;
    if (share >= 1 - rounding || share <= rounding) return share > 0.5;
    return liquid(phi_at(x), level(c, share));
  }

 private:
  static constexpr double rounding = 1e-6, little = 0.1;  // room that tells nothing
  static constexpr int halvings = 10;

  double liquid(double phi, double level) const { return std::clamp(0.5 + (level - phi) / width_, 0.0, 1.0); }
  double phi_at(const Vec<Dim>& x) const {
    return interpolate_linear<Dim>(layout_, phi_.data(), index_coordinates<Dim>(layout_, x, cell_offset<Dim>()));
  }
  double level(Site c, double wanted) {
    const auto known = levels_.find(c);
    if (known != levels_.end()) return known->second;
    Eigen::Array<double, points_of_cell<Dim>, 1> values;
    const IVec<Dim> i = layout_.index(c);
    for (int k = 0; k < values.size(); ++k) values[k] = phi_at(layout_.position(i, point_of_cell<Dim>(k)));
    double low = values.minCoeff() - width_, high = values.maxCoeff() + width_;
    for (int n = 0; n < halvings; ++n) {
      const double middle = 0.5 * (low + high);
      const double share = (0.5 + (middle - values) / width_).max(0.0).min(1.0).mean();
      (share < wanted ? low : high) = middle;
    }
    return levels_[c] = 0.5 * (low + high);
  }

  const Layout<Dim>& layout_;
  const CellField<Dim>& share_;
  Room<Dim> room_;
  const CellField<Dim>& phi_;
  double width_;
  std::map<Site, double> levels_;
};

// Share of liquid where points of a cell come from, with the velocity linear between its faces.
template <int Dim>
double share_where_from(const Layout<Dim>& layout, const FillingStep<Dim>& step, const CellField<Dim>& phi,
                        const FaceField<Dim>& u, Site c) {
  LiquidAtPoints<Dim> liquid(layout, step, phi);
  const double longest = longest_path(layout) * layout.h();
  const IVec<Dim> i = layout.index(c);
  double wet = 0;
  for (int k = 0; k < points_of_cell<Dim>; ++k) {
    const Vec<Dim> at = point_of_cell<Dim>(k);
    Vec<Dim> x = layout.position(i, at);
    for (int a = 0; a < Dim; ++a) {
      const double way = step.dt * ((1 - at[a]) * u.at(a, c) + at[a] * u.at(a, c + layout.stride(a)));
      x[a] -= std::clamp(way, -longest, longest);
    }
    wet += liquid(x);
  }
  return wet / points_of_cell<Dim>;
}

// Air that what flows into a cell brings along, as a share of the cell, if there is too much liquid in it for the cell;
// else none. It comes from a region of the volume K - dt/h sum +- w u. Solids leave the cell K + dt/h sum +- s v; K
// where `faces` is null.
template <int Dim>
std::optional<double> air_if_overfull(const Layout<Dim>& layout, const FaceGeometry<Dim>* faces,
                                      const FillingStep<Dim>& step, const CellField<Dim>& phi, const FaceField<Dim>& u,
                                      Site c) {
  double region = step.room.of(c), room = region;
  for (int a = 0; a < Dim; ++a) {
    const Site high = c + layout.stride(a);
    const double scale = step.dt / layout.h();
    region += scale * (step.room.through(a, c) * u.at(a, c) - step.room.through(a, high) * u.at(a, high));
    if (faces) room += scale * (faces->closed_flux.at(a, high) - faces->closed_flux.at(a, c));
  }
  if (region <= room + margin && step.share[c] <= room + margin) return {};
  const double liquid = region * share_where_from(layout, step, phi, u, c);
  if (liquid <= room + margin || step.room.host_of(layout, c)) return {};
  return std::max(0.0, region - liquid);
}

// Cells of air beside liquid, those first beyond the owned ones too, since their faces may be owned. `counted`: phi of
// the solve. Cells that count as liquid already may have less room than was thought.
template <int Dim>
std::vector<Site> cells_at_surface(const Layout<Dim>& layout, const CellField<Dim>& phi,
                                   const CellField<Dim>& counted) {
  const auto may_matter = [&](Site c) {
    bool any = false;
    for (int a = 0; a < Dim; ++a)
      any = any || any_negative(counted.data() + c - layout.stride(a)) ||
            any_negative(counted.data() + c + layout.stride(a));
    return any;
  };
  return listed_possible(layout, cells_around(layout, 1), may_matter, [&](Site c) {
    return phi[c] >= 0 && phi[c] <= farthest * layout.h() && is_beside_liquid(layout, counted, c);
  });
}

// True if an owned cell of the surface is none of the filling ones. Both lists are in order. Collective.
template <int Dim>
bool has_other_surface(const Domain<Dim>& domain, const CellField<Dim>& counted, const std::vector<Site>& surface,
                       const std::vector<FillingCell>& filling) {
  std::size_t next = 0;
  bool other = false;
  for (const Site c : surface) {
    const bool fills = next < filling.size() && filling[next].cell == c;
    if (fills) ++next;
    other = other || (!fills && counted[c] >= 0 && domain.layout.cells().contains(domain.layout.index(c)));
  }
  return domain.ranks.any(other);
}

// Faces between cells of air have no u* yet: they fall freely.
template <int Dim>
void predict_faces(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const FillingStep<Dim>& step,
                   const std::vector<FillingCell>& filling, const CellField<Dim>& phi, FaceField<Dim>& u_star) {
  const Layout<Dim>& l = domain.layout;
  for (const FillingCell& cell : filling)
    for (int a = 0; a < Dim; ++a)
      for (const Site f : {cell.cell, cell.cell + l.stride(a)}) {
        if (!faces.is_unknown(a, f) || phi[f] < 0 || phi[f - l.stride(a)] < 0) continue;
        u_star.at(a, f) = falling_velocity(l, step.before, step.gravity, step.dt, a, f);
      }
  fill_velocity_ghosts(l, domain.halo, domain.sides, u_star);
}

}  // namespace

template <int Dim>
std::vector<Site> overfull_cells(const Domain<Dim>& domain, const FillingStep<Dim>& step, const FaceField<Dim>& u,
                                 const CellField<Dim>& phi) {
  std::vector<Site> cells = cells_at_surface(domain.layout, phi, phi);
  std::erase_if(cells, [&](Site c) { return !air_if_overfull<Dim>(domain.layout, nullptr, step, phi, u, c); });
  return cells;
}

template <int Dim>
bool add_filling_cells(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const FillingStep<Dim>& step,
                       const FaceField<Dim>& u, CellField<Dim>& phi, FaceField<Dim>& u_star, Filling<Dim>& filling) {
  const Layout<Dim>& l = domain.layout;
  const CellField<Dim>& level = filling.empty() ? phi : filling.phi;
  const std::vector<Site> surface = cells_at_surface(l, level, phi);
  std::vector<FillingCell> cells;
  const auto may_fill = [&](Site c) { return !step.exterior || !step.exterior->has_pressure(c); };
  for (const Site c : surface)
    if (const auto air = may_fill(c) ? air_if_overfull(l, &faces, step, level, u, c) : std::nullopt)
      cells.push_back({c, *air});
  if (!domain.ranks.any(!cells.empty()) || !has_other_surface(domain, phi, surface, cells)) return false;
  predict_faces(domain, faces, step, cells, phi, u_star);
  if (filling.empty()) filling = {CellField<Dim>(l), phi};
  for (const FillingCell& f : cells) {
    filling.inflow[f.cell] = f.air * l.h() / step.dt;
    phi[f.cell] = counted_level * l.h();
  }
  fill_level_set_ghosts(l, domain.halo, phi);
  return true;
}

#define SEICHE_INSTANTIATE(D)                                                                                \
  template std::vector<Site> overfull_cells<D>(const Domain<D>&, const FillingStep<D>&, const FaceField<D>&, \
                                               const CellField<D>&);                                         \
  template bool add_filling_cells<D>(const Domain<D>&, const FaceGeometry<D>&, const FillingStep<D>&,        \
                                     const FaceField<D>&, CellField<D>&, FaceField<D>&, Filling<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
