#include "coupling/drops/landing.h"

#include <algorithm>
#include <map>

#include "coupling/drops/deposit.h"
#include "coupling/thin/gap_flow.h"
#include "fluid/volume/neighbours.h"
#include "fluid/volume/spill.h"

namespace seiche {
namespace {

constexpr double resting = 0.55, whole = 1;  // cells: least volume of liquid on a wall, and in the air

template <int Dim>
bool is_landing(const Domain<Dim>& domain, const Obstacles<Dim>& obstacles, const CellField<Dim>& phi,
                const Drop<Dim>& drop) {
  const double cells = drop.volume / domain.layout.geometry().cell_volume();
  return reaches_liquid(domain.layout, phi, drop) || cells > whole || (cells > resting && obstacles.touches(drop));
}

// The cell that takes a drop's momentum: its own if there is liquid, else the deepest beside it. Cells across a corner
// come after as deep ones across a face.
template <int Dim>
Site host_of(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell) {
  constexpr double apart = 0.1;  // cells
  if (phi[cell] < 0) return cell;
  Site host = cell;
  double least = 0;
  for (int n = 0; n < neighbour_count<Dim>(); ++n) {
    const IVec<Dim> o = neighbour_offset<Dim>(n);
    const Site c = cell + step_of(layout, o);
    const double level = phi[c] + apart * layout.h() * o.squaredNorm();
    if (phi[c] < 0 && (host == cell || level < least)) host = c, least = level;
  }
  return host;
}

// Gains of faces: shares of a cell, and these times velocities.
using FaceGains = std::map<std::pair<int, Site>, std::array<double, 2>>;

// Shares `share` and `momentum` of a cell among its open faces along an axis.
template <int Dim>
void give_to_faces(const Layout<Dim>& layout, const FaceGeometry<Dim>& faces, int axis, Site cell, double share,
                   double momentum, FaceGains& gains) {
  std::vector<Site> open;
  for (const Site f : {cell, cell + layout.stride(axis)})
    if (faces.is_unknown(axis, f) && faces.open.at(axis, f) >= least_open) open.push_back(f);
  for (const Site f : open) {
    std::array<double, 2>& gain = gains[{axis, f}];
    gain[0] += share / double(open.size());
    gain[1] += momentum / double(open.size());
  }
}

// Landed drops of all cells within two of this rank's: shares, and momentum by axis. Collective.
template <int Dim>
class LandedFields {
 public:
  LandedFields(const Domain<Dim>& domain, const std::vector<LandedDrop<Dim>>& landed) : share(domain.layout) {
    for (CellField<Dim>& p : momentum) p = CellField<Dim>(domain.layout);
    for (const LandedDrop<Dim>& d : landed) {
      share[d.cell] += d.share;
      for (int a = 0; a < Dim; ++a) momentum[std::size_t(a)][d.cell] += d.share * d.velocity[a];
    }
    domain.halo.fill_ghosts(share);
    for (CellField<Dim>& p : momentum) domain.halo.fill_ghosts(p);
  }
  CellField<Dim> share;
  std::array<CellField<Dim>, std::size_t(Dim)> momentum;
};

}  // namespace

template <int Dim>
std::vector<LandedDrop<Dim>> land_drops(const Domain<Dim>& domain, const Obstacles<Dim>& obstacles,
                                        const Ledger<Dim>& ledger, State<Dim>& state) {
  const Layout<Dim>& l = domain.layout;
  std::vector<LandedDrop<Dim>> landed;
  std::erase_if(state.drops.list, [&](const Drop<Dim>& d) {
    if (!is_landing(domain, obstacles, state.phi, d)) return false;
    const Site cell = l.site(cell_around(l.geometry(), d.place));
    landed.push_back({cell, d.volume / l.geometry().cell_volume(), d.place, d.velocity, d.id});
    return true;
  });
  if (!domain.ranks.any(!landed.empty())) return landed;
  CellValues volumes;
  for (const LandedDrop<Dim>& d : landed) volumes.emplace_back(d.cell, d.share);
  add_by_room(l, domain.halo, ledger.room, state.phi, volumes, state.liquid);
  const Spill spill = hand_on_excess(l, domain.halo, domain.ranks, state.phi, ledger, {}, state.liquid);
  state.spilled_volume += spill.moved * l.geometry().cell_volume();
  return landed;
}

template <int Dim>
void give_momentum(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const CellField<Dim>& phi,
                   const CellField<Dim>& share, const std::vector<LandedDrop<Dim>>& landed, FaceField<Dim>& u_star) {
  const Layout<Dim>& l = domain.layout;
  if (!domain.ranks.any(!landed.empty())) return;
  const LandedFields<Dim> all(domain, landed);
  FaceGains gains;
  const std::vector<Site> cells = listed_possible(
      l, cells_around(l, 2), [&](Site c) { return !all_zero(all.share.data() + c); },
      [&](Site c) { return all.share[c] > 0; });
  for (const Site c : cells) {
    const Site host = host_of(l, phi, c);
    if (!cells_around(l, 1).contains(l.index(host))) continue;
    for (int a = 0; a < Dim; ++a)
      give_to_faces(l, faces, a, host, all.share[c], all.momentum[std::size_t(a)][c], gains);
  }
  for (const auto& [at, gain] : gains) {
    const auto [a, f] = at;
    if (!l.faces(a).contains(l.index(f))) continue;
    const Site low = f - l.stride(a);
    const double before = std::max(0.5 * (share[low] + share[f] - all.share[low] - all.share[f]), 0.0);
    u_star.at(a, f) = (before * u_star.at(a, f) + gain[1]) / (before + gain[0]);
  }
  fill_velocity_ghosts(l, domain.halo, domain.sides, u_star);
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template std::vector<LandedDrop<D>> land_drops<D>(const Domain<D>&, const Obstacles<D>&, const Ledger<D>&,         \
                                                    State<D>&);                                                      \
  template void give_momentum<D>(const Domain<D>&, const FaceGeometry<D>&, const CellField<D>&, const CellField<D>&, \
                                 const std::vector<LandedDrop<D>>&, FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
