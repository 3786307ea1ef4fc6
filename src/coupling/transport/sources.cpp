#include "coupling/transport/sources.h"

#include <fmt/format.h>

#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/transport.h"
#include "fluid/boundary/domain.h"
#include "fluid/volume/spill.h"
#include "grid/loops.h"
#include "levelset/fractions.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// Distance (m) to the liquid that a source brings: its shape moved with its own velocity, min over the ages a of
// shape(x - a v(x)). Ages are at most one cell's crossing apart. The sum of the domain's cells over all axes bounds
// their number. The shape is not moved to points at which the velocity's formula is not finite.
template <int Dim>
double distance_to_brought(const Layout<Dim>& layout, const Source<Dim>& source, const OpenTime& open,
                           const Vec<Dim>& x) {
  if (open.oldest == 0) return source.distance(x);
  const Vec<Dim> v = truncate<Dim>(source.velocity(extend<Dim>(x), open.begin));
  if (!v.allFinite()) return source.distance(x);
  const double crossed = v.norm() * (open.oldest - open.youngest) / layout.h();
  const int parts = int(std::ceil(std::min(crossed, double(layout.geometry().cells.sum()))));
  double distance = source.distance(x - open.youngest * v);
  for (int n = 1; n <= parts; ++n) {
    const double age = open.youngest + (open.oldest - open.youngest) * n / parts;
    distance = std::min(distance, source.distance(x - age * v));
  }
  return distance;
}

// |v|^2/2 of what a source brings into a cell; 0 where the velocity's formula is not finite.
template <int Dim>
double half_square_of(const Layout<Dim>& layout, const Source<Dim>& source, const OpenTime& open,
                      const IVec<Dim>& cell) {
  const Vec3 v = source.velocity(extend<Dim>(layout.position(cell, cell_offset<Dim>())), open.begin);
  return truncate<Dim>(v).allFinite() ? 0.5 * truncate<Dim>(v).squaredNorm() : 0;
}

// |u|^2/2 in a cell.
template <int Dim>
double half_square_at(const Layout<Dim>& layout, const FaceField<Dim>& u, Site c) {
  double square = 0;
  for (int a = 0; a < Dim; ++a) square += std::pow(0.5 * (u.at(a, c) + u.at(a, c + layout.stride(a))), 2);
  return 0.5 * square;
}

// Joins phi with the liquid of one source. Sets |v|^2/2 of its velocity where it may bring liquid, unless it is null.
// Liquid that reaches no cell's centre is left out: phi would not show it, and its distance beside a film would bend
// phi so that cells lose liquid. Collective.
template <int Dim>
void join(const Domain<Dim>& domain, const Source<Dim>& source, const OpenTime& open, CellField<Dim>& phi,
          CellField<Dim>* half_square) {
  const double near = std::sqrt(double(Dim)) * domain.layout.h();
  CellField<Dim> distance(domain.layout);
  bool reaches = false;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    distance[c] = distance_to_brought(domain.layout, source, open, domain.layout.position(i, cell_offset<Dim>()));
    reaches = reaches || distance[c] < 0;
  });
  if (!domain.ranks.any(reaches)) return;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    phi[c] = std::min(phi[c], distance[c]);
    if (half_square && distance[c] <= near) (*half_square)[c] = half_square_of(domain.layout, source, open, i);
  });
}

// Takes the liquid out of a drain. Sets |v|^2/2 of it, with the velocity u, unless half_square is null. A drain that
// holds no cell's centre takes nothing, as join() brings nothing. Collective.
template <int Dim>
void cut_out(const Domain<Dim>& domain, const Source<Dim>& drain, const FaceField<Dim>* u, CellField<Dim>& phi,
             CellField<Dim>* half_square) {
  const Layout<Dim>& l = domain.layout;
  CellField<Dim> distance(l);
  bool reaches = false;
  for_each_index_in_order(l, l.cells(), [&](Site c, const IVec<Dim>& i) {
    distance[c] = drain.distance(l.position(i, cell_offset<Dim>()));
    reaches = reaches || distance[c] < 0;
  });
  if (!domain.ranks.any(reaches)) return;
  const double near = std::sqrt(double(Dim)) * l.h();
  for_each_site(l, l.cells(), [&](Site c) {
    phi[c] = std::max(phi[c], -distance[c]);
    if (half_square && distance[c] <= near) (*half_square)[c] = half_square_at(l, *u, c);
  });
}

// The same for all sources and drains that are open in a step.
template <int Dim>
void join_all(const Domain<Dim>& domain, const Openings<Dim>& openings, double t0, double t1, const FaceField<Dim>* u,
              CellField<Dim>& phi, CellField<Dim>* half_square) {
  for (const Source<Dim>& source : openings.sources)
    if (const auto open = open_in_step(source.spec, t0, t1)) join(domain, source, *open, phi, half_square);
  for (const Source<Dim>& drain : openings.drains)
    if (open_in_step(drain.spec, t0, t1)) cut_out(domain, drain, u, phi, half_square);
}

// Share of a cell that a source fills, from the distances at equally spaced points of it.
template <int Dim>
double share_within(const Layout<Dim>& layout, const Source<Dim>& source, const OpenTime& open, const IVec<Dim>& cell) {
  constexpr int along = 4, count = Dim == 2 ? along * along : along * along * along;
  const double h = layout.h(),
               middle = distance_to_brought(layout, source, open, layout.position(cell, cell_offset<Dim>()));
  if (std::abs(middle) > h) return middle < 0;
  double sum = 0;
  for (int n = 0; n < count; ++n) {
    Vec<Dim> at;
    for (int a = 0, left = n; a < Dim; ++a, left /= along) at[a] = (left % along + 0.5) / along;
    const double distance = distance_to_brought(layout, source, open, layout.position(cell, at));
    sum += std::clamp(0.5 - along * distance / h, 0.0, 1.0);
  }
  return sum / count;
}

template <int Dim>
bool any_open(const Openings<Dim>& openings, double t0, double t1) {
  const auto is_open = [&](const Source<Dim>& x) { return open_in_step(x.spec, t0, t1).has_value(); };
  return std::ranges::any_of(openings.sources, is_open) || std::ranges::any_of(openings.drains, is_open);
}

// Share of each cell's volume that is liquid after but not before.
template <int Dim>
CellField<Dim> share_brought(const Domain<Dim>& domain, const CellField<Dim>& before, const CellField<Dim>& after,
                             const NodeField<Dim>& psi) {
  CellField<Dim> share(domain.layout);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    share[c] = liquid_share(domain.layout, after, psi, c) - liquid_share(domain.layout, before, psi, c);
  });
  domain.halo.fill_ghosts({share.data()});
  return share;
}

}  // namespace

std::optional<OpenTime> open_in_step(const LiquidSourceSpec& source, double t0, double t1) {
  const double begin = std::max(source.from, t0), end = std::min(source.until, t1);
  if (!(begin < end)) return {};
  return OpenTime{begin, end, t1 - end, source.from >= t0 ? t1 - begin : t1 - end};
}

template <int Dim>
Brought<Dim> add_sources(const Domain<Dim>& domain, const Solids<Dim>& solids, const Openings<Dim>& openings,
                         const State<Dim>& state, double t0, double t1, CellField<Dim>& phi) {
  if (!any_open(openings, t0, t1)) return {};
  const NodeField<Dim> psi = solids.geometry.measure(place_bodies(state), t0).psi;
  const double before = liquid_volume(domain, phi, psi);
  const CellField<Dim> phi_before = phi;
  CellField<Dim> half_square(domain.layout);
  join_all(domain, openings, t0, t1, &state.now->u, phi, &half_square);
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  CellField<Dim> share = share_brought(domain, phi_before, phi, psi);
  const double kinetic = domain.ranks.global_sum(local_sum(
      domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) { return share[c] * half_square[c]; }));
  for_each_site(domain.layout, domain.layout.padded(), [&](Site c) { share[c] = std::max(share[c], 0.0); });
  return {liquid_volume(domain, phi, psi) - before, kinetic * domain.layout.geometry().cell_volume(), std::move(share)};
}

template <int Dim>
Brought<Dim> add_source_shares(const Domain<Dim>& domain, const Openings<Dim>& openings, const NodeField<Dim>& psi,
                               const FaceField<Dim>& u, double t0, double t1, CellField<Dim>& share) {
  if (!any_open(openings, t0, t1)) return {};
  const Layout<Dim>& l = domain.layout;
  double cells = 0, kinetic = 0;
  CellField<Dim> brought(l);
  for (const Source<Dim>& source : openings.sources)
    if (const auto open = open_in_step(source.spec, t0, t1))
      for_each_index_in_order(l, l.cells(), [&](Site c, const IVec<Dim>& i) {
        const double within = share_within(l, source, *open, i);
        const double lacking = within > 0 ? std::max(0.0, within * open_share(l, psi, c) - share[c]) : 0;
        if (lacking == 0) return;
        share[c] += lacking;
        brought[c] += lacking;
        cells += lacking;
        kinetic += lacking * half_square_of(l, source, *open, i);
      });
  for (const Source<Dim>& drain : openings.drains)
    if (open_in_step(drain.spec, t0, t1))
      for_each_index_in_order(l, l.cells(), [&](Site c, const IVec<Dim>& i) {
        const double within = share[c] > 0 ? share_within_shape(l, drain, i) : 0;
        const double beyond = within > 0 ? std::max(0.0, share[c] - (1 - within) * open_share(l, psi, c)) : 0;
        if (beyond == 0) return;
        share[c] -= beyond;
        cells -= beyond;
        kinetic -= beyond * half_square_at(l, u, c);
      });
  fill_share_ghosts(l, domain.halo, share);
  domain.halo.fill_ghosts(brought);
  std::array<double, 2> sums{cells, kinetic};
  domain.ranks.global_sum(sums);
  return {sums[0] * l.geometry().cell_volume(), sums[1] * l.geometry().cell_volume(), std::move(brought)};
}

template <int Dim>
void join_sources(const Domain<Dim>& domain, const Openings<Dim>& openings, double t0, double t1, CellField<Dim>& phi) {
  join_all<Dim>(domain, openings, t0, t1, nullptr, phi, nullptr);
}

template <int Dim>
double share_within_shape(const Layout<Dim>& layout, const Source<Dim>& source, const IVec<Dim>& cell) {
  return share_within(layout, source, OpenTime{}, cell);
}

template <int Dim>
std::vector<FaceImpulse> set_source_velocity(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources,
                                             double t0, double t1, const std::function<double(int, Site)>& mass,
                                             FaceField<Dim>& u) {
  std::vector<FaceImpulse> impulses;
  for (const Source<Dim>& source : sources) {
    const auto open = open_in_step(source.spec, t0, t1);
    if (!open) continue;
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>& i) {
        const Vec<Dim> x = domain.layout.position(i, face_offset<Dim>(a));
        if (distance_to_brought(domain.layout, source, *open, x) > 0) return;
        const double v = source.velocity(extend<Dim>(x), open->begin)[a];
        impulses.push_back({a, f, mass(a, f) * (v - u.at(a, f))});
        u.at(a, f) = v;
      });
  }
  return impulses;
}

template <int Dim>
std::string fault_of_source(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources, std::size_t index,
                            double t) {
  const Source<Dim>& source = sources[index];
  std::string fault;
  if (source.is_uniform() && source.velocity(Vec3::Zero(), t).allFinite()) return fault;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(domain.layout, domain.layout.faces(a), [&](Site, const IVec<Dim>& i) {
      const Vec<Dim> x = domain.layout.position(i, face_offset<Dim>(a));
      if (!fault.empty() || source.distance(x) > 0) return;
      const double v = source.velocity(extend<Dim>(x), t)[a];
      if (std::isfinite(v)) return;
      fault = not_finite_text<Dim>(fmt::format("{}.velocity[{}]", source.name, a), source.spec.velocity[a], v, x, t);
    });
  return fault;
}

template <int Dim>
double mass_at_face(const Layout<Dim>& l, const Fluids& fluids, const CellField<Dim>& phi, const NodeField<Dim>& psi,
                    const CellField<Dim>* brought, int axis, Site face) {
  double share = 0;
  for (const Site c : {face - l.stride(axis), face}) {
    const int i = l.index(c)[axis];
    if (l.geometry().periodic[std::size_t(axis)] || (i >= 0 && i < l.geometry().cells[axis]))
      share += liquid_share(l, phi, psi, c) - (brought ? (*brought)[c] : 0);
  }
  return 0.5 * share * l.geometry().cell_volume() * fluids.density();
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template double mass_at_face<D>(const Layout<D>&, const Fluids&, const CellField<D>&, const NodeField<D>&,          \
                                  const CellField<D>*, int, Site);                                                    \
  template Brought<D> add_sources<D>(const Domain<D>&, const Solids<D>&, const Openings<D>&, const State<D>&, double, \
                                     double, CellField<D>&);                                                          \
  template Brought<D> add_source_shares<D>(const Domain<D>&, const Openings<D>&, const NodeField<D>&,                 \
                                           const FaceField<D>&, double, double, CellField<D>&);                       \
  template void join_sources<D>(const Domain<D>&, const Openings<D>&, double, double, CellField<D>&);                 \
  template double share_within_shape<D>(const Layout<D>&, const Source<D>&, const IVec<D>&);                          \
  template std::vector<FaceImpulse> set_source_velocity<D>(const Domain<D>&, const std::vector<Source<D>>&, double,   \
                                                           double, const std::function<double(int, Site)>&,           \
                                                           FaceField<D>&);                                            \
  template std::string fault_of_source<D>(const Domain<D>&, const std::vector<Source<D>>&, std::size_t, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
