#include "coupling/transport/level_in_solids.h"

#include <algorithm>

#include "coupling/geometry/cell_distance.h"
#include "coupling/state/solids.h"
#include "coupling/thin/gap_flow.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "levelset/extrapolate.h"

namespace seiche {
namespace {

constexpr double filled_depth = 1.5;  // cells; psi of deforming bodies is exact to two
constexpr int layers = 4;             // a wall moves less in a step
constexpr double near_zero = 2;       // cells

template <int Dim>
bool is_in_deformed(const StepGeometry<Dim>& g, Site cell) {
  return g.body[cell] >= 0 && g.deforms(g.body[cell]);
}

// 1 in the cells of the domain, except those deeper than `filled_depth` in deforming bodies.
template <int Dim>
FieldValues<char> cells_near_outside(const Domain<Dim>& domain, const StepGeometry<Dim>& g) {
  FieldValues<char> near(std::size_t(domain.layout.size()), 0);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    const bool deep =
        is_in_deformed(g, c) && distance_at_cell(domain.layout, g.psi, c).first <= -filled_depth * domain.layout.h();
    near[std::size_t(c)] = deep ? 0 : 1;
  });
  return near;
}

// True if the pose is that of the start, up to round-off for a body that joints hold: a billionth of a cell. Bodies
// that deform may have moved all the same.
template <int Dim>
bool is_as_at_start(const Body<Dim>& body, const Placement& placed, double h, bool held) {
  if (body.deforms()) return false;
  const Pose start = body.pose(0), &now = placed.pose;
  if (!held)
    return start.displacement == now.displacement && start.rotation == now.rotation && placed.twist.at_rest() &&
           !body.is_free();
  const double way =
      (now.displacement - start.displacement).norm() + (now.rotation - start.rotation).norm() * body.radius();
  return way <= 1e-9 * h;
}

// 1 for the bodies that have not moved since the start; 0 for all that forces move, unless joints hold them still.
template <int Dim>
std::vector<char> unmoved_bodies(const Layout<Dim>& layout, const Solids<Dim>& solids, const StepGeometry<Dim>& g) {
  const std::vector<char> held = held_still(solids.joints, solids.bodies);
  std::vector<char> unmoved;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k)
    unmoved.push_back(is_as_at_start(solids.bodies[k], g.placed[k], layout.h(), held[k] != 0));
  return unmoved;
}

// True if unmoved solids fill a cell entirely.
template <int Dim>
bool is_closed(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const std::vector<char>& unmoved, Site cell) {
  bool closed = true;
  for_each_face_of(domain.layout, cell,
                   [&](int a, Site f, int, Site) { closed = closed && g.faces.open.at(a, f) == 0; });
  for (int k = 0; k < (1 << Dim) && closed; ++k) {
    Site node = cell;
    for (int a = 0; a < Dim; ++a) node += ((k >> a) & 1) * domain.layout.stride(a);
    closed = g.psi[node] <= 0 && unmoved[std::size_t(g.body[node])];
  }
  return closed;
}

// True if a wall of one or two closed cells along an axis goes through a cell, with open cells on both sides: phi there
// may have been continued from either.
template <int Dim>
bool is_in_thin_wall(const Layout<Dim>& layout, const CellField<Dim, char>& closed, Site cell, const IVec<Dim>& index) {
  constexpr int most = 2;
  const Geometry<Dim>& g = layout.geometry();
  for (int a = 0; a < Dim; ++a) {
    const Site d = layout.stride(a);
    int low = 0, high = 0;
    while (low < most && closed[cell - low * d]) ++low;
    while (high < most && closed[cell + high * d]) ++high;
    const bool ends = g.periodic[a] || (index[a] - low >= 0 && index[a] + high < g.cells[a]);
    if (ends && low + high - 1 <= most && !closed[cell - low * d] && !closed[cell + high * d]) return true;
  }
  return false;
}

// True if phi in a closed cell differs so much from an open one beside it that it belongs to the wall's other side.
template <int Dim>
bool belongs_elsewhere(const Layout<Dim>& layout, const CellField<Dim, char>& closed, const CellField<Dim>& phi,
                       Site cell) {
  constexpr double steepest = 1.5;
  bool differs = false;
  for (int a = 0; a < Dim; ++a)
    for (const Site n : {cell - layout.stride(a), cell + layout.stride(a)})
      differs = differs || (!closed[n] && std::abs(phi[n] - phi[cell]) > steepest * layout.h());
  return differs;
}

// Marks of the cells in thin walls.
template <int Dim>
FieldValues<char> cells_in_thin_walls(const Domain<Dim>& domain, const CellField<Dim, char>& closed) {
  FieldValues<char> thin(std::size_t(domain.layout.size()), 0);
  for_each_index(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    thin[std::size_t(c)] = closed[c] && is_in_thin_wall(domain.layout, closed, c, i);
  });
  return thin;
}

// Marks of the cells for redistancing outside, by phi as it is continued into the closed cells.
template <int Dim>
CellField<Dim, char> kept_outside(const Domain<Dim>& domain, const CellField<Dim, char>& closed,
                                  const FieldValues<char>& thin, const CellField<Dim>& phi) {
  CellField<Dim, char> kept(domain.layout, Kept::no);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    if (!closed[c]) return;
    const bool unread = thin[std::size_t(c)] || belongs_elsewhere(domain.layout, closed, phi, c);
    kept[c] = unread ? Kept::unread : Kept::yes;
  });
  domain.halo.fill_ghosts({kept.data()});
  return kept;
}

// d phi / d(axis) times h, of second order, from open cells alone; 0 where closed cells lie on both sides.
template <int Dim>
double open_difference(const CellField<Dim, char>& closed, const CellField<Dim>& phi, Site cell, Site d) {
  if (!closed[cell - d] && !closed[cell + d]) return 0.5 * (phi[cell + d] - phi[cell - d]);
  if (closed[cell - d] && closed[cell + d]) return 0;
  const Site away = closed[cell - d] ? d : -d;
  const double first = phi[cell + away] - phi[cell];
  const double second = closed[cell + 2 * away] ? 0 : phi[cell + 2 * away] - 2 * phi[cell + away] + phi[cell];
  return (away > 0 ? 1 : -1) * (first - 0.5 * second);
}

// True if any cell of any rank is closed. Collective.
template <int Dim>
bool any_closed(const Domain<Dim>& domain, const CellField<Dim, char>& closed) {
  const char* end = closed.data() + domain.layout.size();
  return domain.ranks.any(std::any_of(closed.data(), end, [](char c) { return c != 0; }));
}

// Least difference of phi from its straight extrapolation that counts as a bend, cells. phi in closed cells creeps to
// its distance step by step, and a bend that fell below the bound would set liquid at rest in motion.
template <int Dim>
double least_bend(const Domain<Dim>& domain, const CellField<Dim>& phi, const FaceField<Dim>& u, double dt) {
  const double h = domain.layout.h();
  double way = 0;
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    if (std::abs(phi[c]) >= near_zero * h) return;
    for (int a = 0; a < Dim; ++a)
      way = std::max({way, std::abs(u.at(a, c)), std::abs(u.at(a, c + domain.layout.stride(a)))});
  });
  return std::clamp(domain.ranks.global_max(way) * dt / h, slow_way, fast_way);
}

// True if a closed cell lies within two of a cell along an axis. Interpolation reads so far at the least way.
template <int Dim>
bool is_near_closed(const Layout<Dim>& layout, const CellField<Dim, char>& closed, Site cell) {
  bool near = false;
  for (int a = 0; a < Dim; ++a)
    for (const int n : {-2, -1, 1, 2}) near = near || closed[cell + n * layout.stride(a)];
  return near;
}

}  // namespace

template <int Dim>
CellField<Dim, char> closed_cells(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g) {
  CellField<Dim, char> closed(domain.layout, 0);
  if (solids.bodies.empty()) return closed;
  const std::vector<char> unmoved = unmoved_bodies(domain.layout, solids, g);
  for_each_site(domain.layout, domain.layout.cells(),
                [&](Site c) { closed[c] = is_closed(domain, g, unmoved, c) ? 1 : 0; });
  domain.halo.fill_ghosts({closed.data()});
  return closed;
}

template <int Dim>
void continue_level_set(const Domain<Dim>& domain, const Solids<Dim>& solids, const CellField<Dim, char>& closed,
                        CellField<Dim>& phi) {
  if (solids.bodies.empty()) return;
  FieldValues<char> known(std::size_t(domain.layout.size()), 0);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) { known[std::size_t(c)] = closed[c] ? 0 : 1; });
  FieldValues<double> f(phi.data(), phi.data() + domain.layout.size());
  extrapolate_straight(domain.layout, domain.halo, domain.layout.cells(), layers, (1 - 1e-9) * domain.band(), f, known);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) { phi[c] = f[std::size_t(c)]; });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
}

template <int Dim>
CellField<Dim, char> cells_to_continue(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
                                       CellField<Dim, char> closed, const CellField<Dim>& phi, const FaceField<Dim>& u,
                                       double dt) {
  if (solids.bodies.empty()) return closed;
  const double h = domain.layout.h(), least = least_bend(domain, phi, u, dt) * h;
  CellField<Dim> straight = phi;
  continue_level_set(domain, solids, closed, straight);
  std::vector<double> differing(solids.bodies.size(), 0);
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) {
    if (!closed[c] || std::min(std::abs(phi[c]), std::abs(straight[c])) >= near_zero * h) return;
    if (std::abs(phi[c] - straight[c]) > least) ++differing[std::size_t(g.body[c])];
  });
  domain.ranks.global_sum(differing);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    if (closed[c] && differing[std::size_t(g.body[c])] == 0) closed[c] = 0;
  });
  domain.halo.fill_ghosts({closed.data()});
  return closed;
}

template <int Dim>
void redistance_beside_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const CellField<Dim, char>& closed,
                              const RedistanceOptions& options, int passes, CellField<Dim>& phi) {
  const Site cells = domain.layout.size();
  if (!any_closed(domain, closed)) return redistance(domain.layout, domain.halo, options, phi);
  const CellField<Dim> within = phi;
  RedistanceOptions outside = options;
  outside.iterations /= passes;
  const FieldValues<char> thin = cells_in_thin_walls(domain, closed);
  for (int n = 0; n < passes; ++n) {
    continue_level_set(domain, solids, closed, phi);
    const CellField<Dim, char> kept = kept_outside(domain, closed, thin, phi);
    redistance(domain.layout, domain.halo, outside, phi, &kept);
  }
  CellField<Dim, char> open(domain.layout, Kept::no);
  for (Site c = 0; c < cells; ++c) {
    open[c] = closed[c] ? Kept::no : Kept::yes;
    if (closed[c]) phi[c] = within[c];
  }
  redistance(domain.layout, domain.halo, options, phi, &open);
}

// phi(x - s) = phi - s . grad phi with the way s = u dt, for |s| <= slow_way; as transported for |s| >= fast_way.
template <int Dim>
void carry_slow_near_closed(const Domain<Dim>& domain, const CellField<Dim, char>& closed, const State<Dim>& state,
                            FaceField<Dim> u, double dt, const CellField<Dim>& before, CellField<Dim>& phi) {
  const Layout<Dim>& layout = domain.layout;
  if (!any_closed(domain, closed)) return;
  if (!state.exterior->flows()) let_surface_through_gaps(domain, state.gap_flow, before, state.now->valid, dt, u);
  for_each_site(layout, layout.cells(), [&](Site c) {
    if (closed[c] || std::abs(before[c]) >= domain.band() || !is_near_closed(layout, closed, c)) return;
    double way = 0, carried = before[c];
    for (int a = 0; a < Dim; ++a) {
      const Site d = layout.stride(a);
      const double s = 0.5 * (u.at(a, c) + u.at(a, c + d)) * dt / layout.h();
      way = std::max(way, std::abs(s));
      carried -= s * open_difference(closed, before, c, d);
    }
    phi[c] += share_of_slow(way) * (carried - phi[c]);
  });
}

template <int Dim>
void keep_inertia_near_closed(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces,
                              const CellField<Dim, char>& closed, const State<Dim>& state, const CellField<Dim>& phi,
                              const Vec3& g, double dt, FaceField<Dim>& u) {
  constexpr double reach = 2;  // cells
  const Layout<Dim>& layout = domain.layout;
  if (state.exterior->flows()) return;
  const auto wanted = [&](int a, Site f) {
    const Site low = f - layout.stride(a);
    if (std::min(std::abs(phi[f]), std::abs(phi[low])) >= reach * layout.h()) return false;
    return !state.now->valid.at(a, f) && (is_near_closed(layout, closed, f) || is_near_closed(layout, closed, low));
  };
  keep_inertia_in_gaps<Dim>(domain, faces, state.gap_flow, wanted, g, dt, u);
}

template <int Dim>
void keep_sides_of_walls(const Domain<Dim>& domain, const StepGeometry<Dim>& g, CellField<Dim>& phi) {
  if (std::none_of(g.face_weights.begin(), g.face_weights.end(), [](const auto& list) { return list != nullptr; }))
    return;
  FieldValues<char> known = cells_near_outside(domain, g);
  FieldValues<double> outside(phi.data(), phi.data() + domain.layout.size());
  extrapolate(domain.layout, domain.halo, domain.layout.cells(), {layers, 0}, outside, known);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    const double value = outside[std::size_t(c)];
    if (known[std::size_t(c)] > 1 && (value < 0) != (phi[c] < 0)) phi[c] = value;
  });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
}

template CellField<2, char> closed_cells<2>(const Domain<2>&, const Solids<2>&, const StepGeometry<2>&);
template CellField<3, char> closed_cells<3>(const Domain<3>&, const Solids<3>&, const StepGeometry<3>&);
template CellField<2, char> cells_to_continue<2>(const Domain<2>&, const Solids<2>&, const StepGeometry<2>&,
                                                 CellField<2, char>, const CellField<2>&, const FaceField<2>&, double);
template CellField<3, char> cells_to_continue<3>(const Domain<3>&, const Solids<3>&, const StepGeometry<3>&,
                                                 CellField<3, char>, const CellField<3>&, const FaceField<3>&, double);
template void carry_slow_near_closed<2>(const Domain<2>&, const CellField<2, char>&, const State<2>&, FaceField<2>,
                                        double, const CellField<2>&, CellField<2>&);
template void carry_slow_near_closed<3>(const Domain<3>&, const CellField<3, char>&, const State<3>&, FaceField<3>,
                                        double, const CellField<3>&, CellField<3>&);
template void keep_inertia_near_closed<2>(const Domain<2>&, const FaceGeometry<2>&, const CellField<2, char>&,
                                          const State<2>&, const CellField<2>&, const Vec3&, double, FaceField<2>&);
template void keep_inertia_near_closed<3>(const Domain<3>&, const FaceGeometry<3>&, const CellField<3, char>&,
                                          const State<3>&, const CellField<3>&, const Vec3&, double, FaceField<3>&);
template void continue_level_set<2>(const Domain<2>&, const Solids<2>&, const CellField<2, char>&, CellField<2>&);
template void continue_level_set<3>(const Domain<3>&, const Solids<3>&, const CellField<3, char>&, CellField<3>&);
template void redistance_beside_solids<2>(const Domain<2>&, const Solids<2>&, const CellField<2, char>&,
                                          const RedistanceOptions&, int, CellField<2>&);
template void redistance_beside_solids<3>(const Domain<3>&, const Solids<3>&, const CellField<3, char>&,
                                          const RedistanceOptions&, int, CellField<3>&);
template void keep_sides_of_walls<2>(const Domain<2>&, const StepGeometry<2>&, CellField<2>&);
template void keep_sides_of_walls<3>(const Domain<3>&, const StepGeometry<3>&, CellField<3>&);

}  // namespace seiche
