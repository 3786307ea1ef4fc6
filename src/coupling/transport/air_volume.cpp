#include "coupling/transport/air_volume.h"

#include <cstring>
#include <map>
#include <numeric>

#include "coupling/transport/transport.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "levelset/fractions.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// Per cell: its own region, or that of the nearest air cells, spread layer by layer over the band. The first two layers
// pass only faces of unknown velocity (all if `faces` is null). Open air has the number air.count(); -1: none near.
// Collective.
template <int Dim>
CellField<Dim, std::int64_t> nearest_regions(const Domain<Dim>& domain, const AirRegions<Dim>& air,
                                             const CellField<Dim>& phi, const FaceGeometry<Dim>* faces) {
  constexpr int own_side = 2;
  CellField<Dim, std::int64_t> near = air.label;
  for_each_site(domain.layout, domain.layout.padded(), [&](Site c) {
    if (near[c] == open_air) near[c] = air.count();
  });
  const int layers = int(std::ceil(domain.band() / domain.layout.h())) + 1;
  for (int layer = 0; layer < layers; ++layer) {
    const CellField<Dim, std::int64_t> old = near;
    for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
      if (old[c] >= 0) return;
      double largest = -std::numeric_limits<double>::infinity();
      for_each_face_of(domain.layout, c, [&](int a, Site f, int, Site across) {
        if (old[across] < 0 || phi[across] <= largest) return;
        if (layer < own_side && faces && !faces->is_unknown(a, f)) return;
        near[c] = old[across];
        largest = phi[across];
      });
    });
    domain.halo.fill_ghosts({near.data()});
  }
  return near;
}

// Air volume near each region, last that near open air, m^Dim, with phi raised by `shift` (m). Summed over the ranks.
// Collective.
template <int Dim>
std::vector<double> volumes_of(const Domain<Dim>& domain, const CellField<Dim, std::int64_t>& near, std::int64_t count,
                               const NodeField<Dim>& psi, const CellField<Dim>& phi, double shift) {
  CellField<Dim> depth(domain.layout);  // below zero in the air
  for_each_site(domain.layout, domain.layout.padded(),
                [&](Site c) { depth[c] = -phi[c] - (std::abs(phi[c]) < domain.band() ? shift : 0); });
  std::vector<double> volume(std::size_t(count + 1));
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) {
    if (near[c] >= 0) volume[std::size_t(near[c])] += liquid_share(domain.layout, depth, psi, c);
  });
  domain.ranks.global_sum(volume);
  for (double& v : volume) v *= domain.layout.geometry().cell_volume();
  return volume;
}

// Number of cells that went from a region before to a region now. Either may be open_air.
using Overlaps = std::map<std::pair<std::int64_t, std::int64_t>, double>;

struct Overlap {
  std::int64_t before, now;
  double cells;
};

// Cell in which the air of cell c was dt (s) ago, within the halo.
template <int Dim>
Site origin(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, Site c) {
  Site from = c;
  for (int a = 0; a < Dim; ++a) {
    const double moved = 0.5 * (u.at(a, c) + u.at(a, c + layout.stride(a))) * dt / layout.h();
    from -= Site(std::lround(std::clamp<double>(moved, 1 - layout.halo(), layout.halo() - 1))) * layout.stride(a);
  }
  return from;
}

// Overlaps over all ranks. Collective.
template <int Dim>
Overlaps overlaps(const Domain<Dim>& domain, const AirRegions<Dim>& before, const AirRegions<Dim>& now,
                  const FaceField<Dim>& u, double dt) {
  Overlaps mine, all;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) {
    if (now.label[c] == no_air) return;
    std::int64_t from = dt > 0 ? before.label[origin(domain.layout, u, dt, c)] : no_air;
    if (from == no_air) from = before.label[c];
    if (from != no_air) mine[{from, now.label[c]}] += 1;
  });
  std::string bytes;
  for (const auto& [pair, cells] : mine) {
    const Overlap o{pair.first, pair.second, cells};
    bytes.append(reinterpret_cast<const char*>(&o), sizeof o);
  }
  for (const std::string& part : domain.ranks.all_gather(bytes))
    for (std::size_t n = 0; n < part.size(); n += sizeof(Overlap)) {
      Overlap o;
      std::memcpy(&o, part.data() + n, sizeof o);
      all[{o.before, o.now}] += o.cells;
    }
  return all;
}

// Drops overlaps that are noise. At a rim that cuts off the surface, cells alternate between both sides, and each would
// carry a cell of air along. So up to 2^Dim cells between a persisting region and the open air do not count. Splinters
// smaller than one cell (`cell`, m^Dim) leave their volume to the larger part and vanish.
template <int Dim>
Overlaps without_blur(Overlaps cells, const std::vector<double>& measured, std::size_t before, double cell) {
  constexpr double blur = 1 << Dim;
  std::vector<char> stays(before), comes(measured.size()), has_large(before);
  for (const auto& [pair, n] : cells) {
    if (pair.first < 0 || pair.second < 0) continue;
    stays[std::size_t(pair.first)] = comes[std::size_t(pair.second)] = 1;
    if (measured[std::size_t(pair.second)] >= cell) has_large[std::size_t(pair.first)] = 1;
  }
  for (auto& [pair, n] : cells) {
    if (pair.first >= 0 && pair.second >= 0) {
      if (has_large[std::size_t(pair.first)] && measured[std::size_t(pair.second)] < cell) n = 0;
    } else if (n <= blur && (pair.first >= 0 ? stays[std::size_t(pair.first)]
                                             : pair.second >= 0 && comes[std::size_t(pair.second)])) {
      n = 0;
    }
  }
  return cells;
}

// V_n = sum_b V_b m_bn / sum_n m_bn, with m_bn the part of the measured volume of n that came from b. Parts that were
// open count as measured. Adds the volumes of vanished regions to `lost`.
template <int Dim>
void hand_on_volumes(const Domain<Dim>& domain, const AirRegions<Dim>& before, const Overlaps& found,
                     const std::vector<double>& measured, AirRegions<Dim>& now, double& lost) {
  const double cell = domain.layout.geometry().cell_volume();
  const Overlaps cells = without_blur<Dim>(found, measured, before.volume.size(), cell);
  std::vector<double> in_all(now.volume.size()), kept(before.volume.size());
  std::vector<char> known(now.volume.size());
  for (const auto& [pair, n] : found)
    if (pair.second >= 0) known[std::size_t(pair.second)] = 1;
  for (const auto& [pair, n] : cells)
    if (pair.second >= 0) in_all[std::size_t(pair.second)] += n;
  // Regions in cut cells may measure no volume: use a lower bound.
  const auto part = [&](const auto& pair, double n) {
    if (pair.second < 0 || n == 0) return n * cell;
    return std::max(measured[std::size_t(pair.second)], 1e-3 * cell) * n / in_all[std::size_t(pair.second)];
  };
  for (const auto& [pair, n] : cells)
    if (pair.first >= 0) kept[std::size_t(pair.first)] += part(pair, n);
  for (const auto& [pair, n] : cells) {
    if (pair.second < 0 || n == 0) continue;
    const auto k = std::size_t(pair.second);
    now.volume[k] += pair.first < 0
                         ? measured[k] * n / in_all[k]
                         : before.volume[std::size_t(pair.first)] * (part(pair, n) / kept[std::size_t(pair.first)]);
  }
  for (std::size_t n = 0; n < now.volume.size(); ++n)
    if (!known[n]) now.volume[n] = measured[n];
  for (std::size_t b = 0; b < kept.size(); ++b)
    if (kept[b] == 0) lost += before.volume[b];
}

}  // namespace

template <int Dim>
std::vector<double> air_volumes(const Domain<Dim>& domain, const AirRegions<Dim>& air, const NodeField<Dim>& psi,
                                const CellField<Dim>& phi) {
  return volumes_of(domain, nearest_regions<Dim>(domain, air, phi, nullptr), air.count(), psi, phi, 0);
}

template <int Dim>
AirRegions<Dim> initial_air(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const CellField<Dim>& phi) {
  AirRegions<Dim> air = find_air_regions(domain.layout, domain.halo, domain.ranks, phi, g.faces);
  std::vector<double> measured =
      volumes_of(domain, nearest_regions(domain, air, phi, &g.faces), air.count(), g.psi, phi, 0);
  measured.pop_back();
  air.volume = std::move(measured);
  return air;
}

template <int Dim>
AirRegions<Dim> follow_air(const Domain<Dim>& domain, const AirRegions<Dim>& before, const FaceField<Dim>& u, double dt,
                           const StepGeometry<Dim>& g, const CellField<Dim>& phi, double& lost) {
  AirRegions<Dim> now = find_air_regions(domain.layout, domain.halo, domain.ranks, phi, g.faces);
  hand_on_volumes(domain, before, overlaps(domain, before, now, u, dt), air_volumes(domain, now, g.psi, phi), now,
                  lost);
  return now;
}

template <int Dim>
double control_volumes(const Domain<Dim>& domain, const StepGeometry<Dim>& g, double expected, double limit,
                       AirRegions<Dim>& air, CellField<Dim>& phi) {
  const double probe = 1e-3 * domain.layout.h(), liquid = liquid_volume(domain, phi, g.psi);
  const auto near = nearest_regions(domain, air, phi, &g.faces);
  const std::vector<double> volume = volumes_of(domain, near, air.count(), g.psi, phi, 0);
  const std::vector<double> grown = volumes_of(domain, near, air.count(), g.psi, phi, probe);
  const std::size_t open = air.volume.size();
  double enclosed = 0, lacking = 0;  // volume of the regions, and the part of it that they lack
  for (std::size_t k = 0; k < open; ++k) enclosed += air.volume[k], lacking += air.volume[k] - volume[k];
  const double excess = liquid - expected;  // of liquid volume
  if (!air.any_open && enclosed > 0)
    for (double& v : air.volume) v *= 1 + (excess - lacking) / enclosed;
  std::vector<double> shift(open + 1);
  for (std::size_t k = 0; k <= open; ++k) {
    const double area = (grown[k] - volume[k]) / probe,
                 wanted = k < open ? air.volume[k] - volume[k] : excess - lacking;
    shift[k] = area > 0 ? std::clamp(wanted / area, -limit, limit) : 0;
  }
  for_each_site(domain.layout, domain.layout.padded(), [&](Site c) {
    if (near[c] >= 0 && std::abs(phi[c]) < domain.band()) phi[c] += shift[std::size_t(near[c])];
  });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  return liquid_volume(domain, phi, g.psi) - liquid;
}

template <int Dim>
std::vector<double> excess_of_air(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const CellField<Dim>& phi,
                                  const CellField<Dim>& share, const Room<Dim>& room, const AirRegions<Dim>& air) {
  const auto near = nearest_regions(domain, air, phi, &g.faces);
  std::vector<double> volume(air.volume.size() + 1);
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) {
    if (near[c] >= 0) volume[std::size_t(near[c])] += room.of(c) - share[c];
  });
  volume.pop_back();
  domain.ranks.global_sum(volume);
  for (std::size_t k = 0; k < volume.size(); ++k)
    volume[k] = volume[k] * domain.layout.geometry().cell_volume() - air.volume[k];
  return volume;
}

template <int Dim>
std::vector<double> inflow_of_air(const ProjectionInput<Dim>& in, const AirRegions<Dim>& air) {
  const double per_volume = in.layout.h() / (in.layout.geometry().cell_volume() * in.excess_time);
  std::vector<double> inflow;
  for (const double excess : air.excess) inflow.push_back(per_volume * excess);
  const double enclosed = std::accumulate(air.volume.begin(), air.volume.end(), 0.0);
  if (air.any_open || enclosed == 0) return inflow;
  const double into_liquid = in.ranks.global_sum(local_sum(in.layout, in.layout.cells(), [&](Site c, const IVec<Dim>&) {
    return in.is_liquid(c) ? in.missing_flux(c) : 0.0;
  }));
  const double left = into_liquid + std::accumulate(inflow.begin(), inflow.end(), 0.0);
  for (std::size_t k = 0; k < inflow.size(); ++k) inflow[k] -= left * air.volume[k] / enclosed;
  return inflow;
}

#define SEICHE_INSTANTIATE(D)                                                                                  \
  template std::vector<double> air_volumes<D>(const Domain<D>&, const AirRegions<D>&, const NodeField<D>&,     \
                                              const CellField<D>&);                                            \
  template AirRegions<D> initial_air<D>(const Domain<D>&, const StepGeometry<D>&, const CellField<D>&);        \
  template AirRegions<D> follow_air<D>(const Domain<D>&, const AirRegions<D>&, const FaceField<D>&, double,    \
                                       const StepGeometry<D>&, const CellField<D>&, double&);                  \
  template std::vector<double> excess_of_air<D>(const Domain<D>&, const StepGeometry<D>&, const CellField<D>&, \
                                                const CellField<D>&, const Room<D>&, const AirRegions<D>&);    \
  template std::vector<double> inflow_of_air<D>(const ProjectionInput<D>&, const AirRegions<D>&);              \
  template double control_volumes<D>(const Domain<D>&, const StepGeometry<D>&, double, double, AirRegions<D>&, \
                                     CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
