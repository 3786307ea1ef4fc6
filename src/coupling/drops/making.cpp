#include "coupling/drops/making.h"

#include <algorithm>

#include "coupling/thin/gap_flow.h"
#include "coupling/transport/drifting.h"
#include "fluid/volume/neighbours.h"
#include "fluid/volume/spill.h"

namespace seiche {
namespace {

// Mean velocity of the faces of a cell that are open, m/s; 0 along axes with none.
template <int Dim>
Vec<Dim> velocity_in_cell(const Layout<Dim>& layout, const CarryingFlow<Dim>& flow, Site cell) {
  Vec<Dim> v = Vec<Dim>::Zero();
  for (int a = 0; a < Dim; ++a) {
    int open = 0;
    for (const Site f : {cell, cell + layout.stride(a)}) {
      if (!flow.faces.is_unknown(a, f) || flow.faces.open.at(a, f) < least_open) continue;
      v[a] += flow.u.at(a, f);
      ++open;
    }
    if (open == 2) v[a] *= 0.5;
  }
  return v;
}

// True if a cell has little, near cells with a host (Room): behind thin walls these lend each other what is not there.
template <int Dim>
bool is_lent(const Layout<Dim>& layout, const Room<Dim>& room, double share, Site cell) {
  constexpr double little = 1e-3;
  constexpr int reach = 2;
  if (share > little || room.is_whole()) return false;
  for (int n = 0; n < neighbour_count<Dim>(reach); ++n)
    if (room.host_of(layout, cell + step_of(layout, neighbour_offset<Dim>(n, reach)))) return true;
  return false;
}

// Number of a cell in the domain, first axis fastest.
template <int Dim>
std::int64_t number_of(const Geometry<Dim>& grid, const IVec<Dim>& cell) {
  std::int64_t n = 0;
  for (int a = Dim - 1; a >= 0; --a) n = n * grid.cells[a] + cell[a];
  return n;
}

template <int Dim>
Drop<Dim> drop_of_cell(const Layout<Dim>& layout, const CarryingFlow<Dim>& flow, std::int64_t step, double share,
                       Site cell) {
  const IVec<Dim> i = layout.index(cell);
  const Vec<Dim> x = layout.position(i, cell_offset<Dim>()), u = velocity_in_cell(layout, flow, cell);
  const std::int64_t id = step * layout.geometry().box().size() + number_of(layout.geometry(), i);
  return {x, u + flow.forces.gain(x, u, flow.time, flow.span), share * layout.geometry().cell_volume(), id};
}

// Gives the part of a drop that landed in its cell the velocity that it had.
template <int Dim>
void keep_velocity_of(const LandedDrop<Dim>& landed, double share, Drop<Dim>& drop) {
  const double part = std::min(landed.share / share, 1.0);
  drop.velocity += part * (landed.velocity - drop.velocity);
  if (part > 0.5) drop.id = landed.id, drop.place = landed.place;
}

}  // namespace

template <int Dim>
void make_drops(const Domain<Dim>& domain, const Obstacles<Dim>& obstacles, const CarryingFlow<Dim>& flow, bool keeps,
                std::vector<LandedDrop<Dim>>& landed, State<Dim>& state) {
  const Layout<Dim>& l = domain.layout;
  state.drops.made = 0;
  std::vector<Site> cells = drifting_cells(domain, state.phi, state.liquid);
  std::erase_if(
      cells, [&](Site c) { return !l.cells().contains(l.index(c)) || is_lent(l, state.room(), state.liquid[c], c); });
  if (!domain.ranks.any(!cells.empty())) return;
  std::array<double, 2> sums{};  // volume, energy
  for (const Site c : cells) {
    Drop<Dim> drop = drop_of_cell(l, flow, state.step, state.liquid[c], c);
    const auto same = std::find_if(landed.begin(), landed.end(), [&](const auto& d) { return d.cell == c; });
    if (same != landed.end()) {
      keep_velocity_of(*same, state.liquid[c], drop);
      landed.erase(same);
    }
    obstacles.keep_out(drop);
    state.liquid[c] = 0;
    sums[0] += drop.volume;
    sums[1] += 0.5 * drop.volume * drop.velocity.squaredNorm();
    if (keeps) state.drops.list.push_back(drop);
  }
  domain.ranks.global_sum(sums);
  fill_share_ghosts(l, domain.halo, state.liquid);
  if (keeps) {
    state.drops.made = sums[1];
    return sort_drops(state.drops.list);
  }
  state.drops.left_out += sums[0];
  state.expected_volume -= sums[0];
}

template void make_drops<2>(const Domain<2>&, const Obstacles<2>&, const CarryingFlow<2>&, bool,
                            std::vector<LandedDrop<2>>&, State<2>&);
template void make_drops<3>(const Domain<3>&, const Obstacles<3>&, const CarryingFlow<3>&, bool,
                            std::vector<LandedDrop<3>>&, State<3>&);

}  // namespace seiche
