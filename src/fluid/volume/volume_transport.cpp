#include "fluid/volume/volume_transport.h"

#include <atomic>

#include "fluid/transport/advection.h"
#include "fluid/volume/ledger.h"
#include "fluid/volume/liquid_in_cells.h"
#include "fluid/volume/moved_solids.h"
#include "fluid/volume/neighbours.h"
#include "fluid/volume/swept_region.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Steps from a face's site to its corners, in the order of TracedFace.
template <int Dim>
std::array<IVec<Dim>, TracedFace<Dim>::count> corner_steps(int axis) {
  std::array<IVec<Dim>, TracedFace<Dim>::count> r;
  for (IVec<Dim>& o : r) o = IVec<Dim>::Zero();
  const int b = (axis + 1) % Dim;
  r[1][b] = 1;
  if constexpr (Dim == 3) {
    const int c = (axis + 2) % Dim;
    r[2][b] = r[2][c] = r[3][c] = 1;
  }
  return r;
}

// Owned cells and the first ones beyond them along an axis: their low faces are those of the owned cells.
template <int Dim>
Box<Dim> faces_of_cells(const Layout<Dim>& layout, int axis) {
  Box<Dim> box = layout.cells();
  if (!box.empty()) ++box.upper[axis];
  return box;
}

// Cells that are mixed, or full beside an empty one, and all within `reach` cells of these.
template <int Dim>
CellField<Dim, char> near_surface(const Layout<Dim>& layout, const CountedShares<Dim>& share, int reach) {
  const auto full = [&](Site c) { return share[c] > 0.5; };
  const std::vector<Site> surface = listed_possible(
      layout, layout.grown(layout.halo() - 1), [&](Site c) { return !share.all_empty(c); },
      [&](Site c) {
        if (is_mixed(share[c])) return true;
        if (!full(c)) return false;
        for (int a = 0; a < Dim; ++a)
          if (!full(c - layout.stride(a)) || !full(c + layout.stride(a))) return true;
        return false;
      });
  CellField<Dim, char> near(layout);
  mark_around(layout, surface, reach, near);
  return near;
}

// Mean over the faces around a node. Second order is enough for the first half of a midpoint step.
template <int Dim>
Vec<Dim> mean_at_node(const Layout<Dim>& layout, const FaceField<Dim>& u, Site node) {
  Vec<Dim> v = Vec<Dim>::Zero();
  for (int a = 0; a < Dim; ++a) {
    for (int k = 0; k < 1 << Dim; ++k) {
      if (k >> a & 1) continue;
      Site f = node;
      for (int b = 0; b < Dim; ++b) f -= (k >> b & 1) * layout.stride(b);
      v[a] += u.at(a, f);
    }
    v[a] /= 1 << (Dim - 1);
  }
  return v;
}

// Origins of the nodes of marked cells, in cells.
template <int Dim>
class NodeOrigins {
 public:
  NodeOrigins(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, const CellField<Dim, char>& near,
              Trace trace)
      : number_(layout) {
    Box<Dim> box = layout.cells();
    if (!box.empty()) box.upper.array() += 1;
    const std::vector<Site> nodes = listed_possible(
        layout, box, [](Site) { return true; }, [&](Site s) { return touches(layout, near, s); });
    for (std::size_t n = 0; n < nodes.size(); ++n) number_[nodes[n]] = std::int32_t(n + 1);
    origin_.resize(nodes.size());
    const double longest = longest_path(layout);
    for_each_listed(nodes, [&](Site s) {
      const IVec<Dim> i = layout.index(s);
      const Vec<Dim> x = layout.position(i, node_offset<Dim>()), here = i.template cast<double>();
      const Vec<Dim> from = trace == Trace::third_order
                                ? trace_third_order<Dim>(layout, u, sample_velocity<Dim>(layout, u, x), x, dt)
                                : trace_midpoint<Dim>(layout, u, mean_at_node(layout, u, s), x, dt);
      const Vec<Dim> way = (from - layout.geometry().lower) / layout.h() - here;
      origin_[std::size_t(number_[s] - 1)] = here + way.cwiseMax(-longest).cwiseMin(longest);
      if (!(way.cwiseAbs().maxCoeff() <= longest + rounding)) ++too_far_;
    });
  }
  std::int64_t too_far() const { return too_far_; }
  const Vec<Dim>& operator[](Site node) const { return origin_[std::size_t(number_[node] - 1)]; }

 private:
  static bool touches(const Layout<Dim>& layout, const CellField<Dim, char>& near, Site node) {
    bool any = false;
    for (int k = 0; k < 1 << Dim; ++k) {
      Site c = node;
      for (int a = 0; a < Dim; ++a) c -= (k >> a & 1) * layout.stride(a);
      any = any || near[c];
    }
    return any;
  }

  static constexpr double rounding = 1e-6;  // cells

  NodeField<Dim, std::int32_t> number_;  // place in the list + 1; 0: not listed
  std::vector<Vec<Dim>> origin_;
  std::atomic<std::int64_t> too_far_ = 0;
};

// The flow of a step, frozen, and the cells near the surface.
template <int Dim>
struct FrozenFlow {
  const VolumeFlow<Dim>& velocity;
  double dt, part;  // part: of the whole step
  const CellField<Dim, char>& near;
  const NodeOrigins<Dim>& origins;
  const CellField<Dim, char>& fed;  // 1 on velocity.fed; empty if there are none
};

// Liquid that passes each face of the owned cells towards +axis in the step, in cells.
template <int Dim>
FaceField<Dim> fluxes(const Layout<Dim>& layout, const Room<Dim>& room, const FrozenFlow<Dim>& flow,
                      const LiquidInCells<Dim>& liquid, const CountedShares<Dim>& share) {
  FaceField<Dim> r(layout);
  for (int a = 0; a < Dim; ++a) {
    const auto steps = corner_steps<Dim>(a);
    const Site low = layout.stride(a);
    const char* near = flow.near.data();
    const auto may_matter = [&](Site f) {
      return any_marked(near + f) || any_marked(near + f - low) || !share.all_empty(f);
    };
    for_each_possible(layout, faces_of_cells(layout, a), may_matter, [&](Site f) {
      const double volume = flow.velocity.through.at(a, f) * flow.dt / layout.h(), open = room.through(a, f);
      if (open == 0 || (volume == 0 && (!room.is_whole() || flow.velocity.enters))) return;  // paths lead out of walls
      const bool enters = !flow.fed.empty() && flow.fed[volume > 0 ? f - low : f];
      if (enters || (!near[f] && !near[f - low])) {
        if (enters || share[f] > 0.5) r.at(a, f) = open * volume;
        return;
      }
      const IVec<Dim> i = layout.index(f);
      TracedFace<Dim> face{a, {}, {}};
      for (std::size_t k = 0; k < steps.size(); ++k) {
        face.now[k] = (i + steps[k]).template cast<double>();
        face.before[k] = flow.origins[layout.site(i + steps[k])];
      }
      const int uniform = liquid.uniform(range_of(face));
      r.at(a, f) = open * (uniform >= 0 ? uniform * volume : liquid.within(SweptRegion<Dim>(face, volume)));
    });
  }
  return r;
}

// Cuts what leaves a cell to what is there and comes in. Beside solids, regions of several faces may overlap. Later
// rounds cover cells that get less by earlier ones. Collective.
template <int Dim>
void keep_to_what_is_there(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                           const CellField<Dim>& share, FaceField<Dim>& flux) {
  constexpr double rounding = 1e-13;
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    CellField<Dim> part(layout, 1);
    bool any = false;
    for_each_index_in_order(layout, layout.cells(), [&](Site c, const IVec<Dim>&) {
      double in = 0, out = 0;
      for (int a = 0; a < Dim; ++a) {
        const double low = flux.at(a, c), high = flux.at(a, c + layout.stride(a));
        in += std::max(low, 0.0) - std::min(high, 0.0);
        out += std::max(high, 0.0) - std::min(low, 0.0);
      }
      if (out <= share[c] + in + rounding) return;
      part[c] = std::max(share[c] + in, 0.0) / out;
      any = true;
    });
    if (!ranks.any(any)) return;
    halo.fill_ghosts(part);
    for (int a = 0; a < Dim; ++a)
      for_each_site(layout, faces_of_cells(layout, a), [&](Site f) {
        double& through = flux.at(a, f);
        if (through != 0) through *= part[through > 0 ? f - layout.stride(a) : f];
      });
  }
}

// Gain of the liquid in a cell by the flow's divergence, in cells: full cells stay full.
template <int Dim>
double swelling(const Layout<Dim>& layout, const Room<Dim>& room, const FrozenFlow<Dim>& flow,
                const CountedShares<Dim>& share, Site c) {
  constexpr double rounding = 1e-12;
  double net = 0;
  for (int a = 0; a < Dim; ++a) {
    const Site high = c + layout.stride(a);
    net += (room.through(a, high) * flow.velocity.through.at(a, high) -
            room.through(a, c) * flow.velocity.through.at(a, c)) *
           flow.dt / layout.h();
  }
  return std::abs(net) > rounding ? share[c] * net : 0;
}

// Volume that passes the sides of the domain inwards, in cells.
template <int Dim>
double entering(const Layout<Dim>& layout, const FaceField<Dim>& flux) {
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1})
      sum += (side == 0 ? 1 : -1) *
             local_sum(layout, faces_of_side(layout, a, side), [&](Site f, const IVec<Dim>&) { return flux.at(a, f); });
  return sum;
}

// Adds what is brought in the part of a step. Returns it, in cells, on this rank.
template <int Dim>
double add_brought(const FrozenFlow<Dim>& flow, CellField<Dim>& share) {
  double sum = 0;
  for (const auto& [c, whole] : flow.velocity.brought) {
    const double value = std::max(flow.part * whole, -std::max(share[c], 0.0));
    share[c] += value;
    sum += value;
  }
  return sum;
}

// Cells that the fastest path crosses: reaches from a face to the surface that passes it. Collective.
template <int Dim>
int cells_of_paths(const Layout<Dim>& layout, const Communicator& ranks, const FaceField<Dim>& u, double dt) {
  constexpr double rounding = 0.1;
  double fastest = 0;
  for (int a = 0; a < Dim; ++a)
    fastest = std::max(fastest, local_max_of_possible(
                                    layout, layout.faces(a), 0.0, [&](Site f) { return !all_zero(u[a].data() + f); },
                                    [&](Site f) { return std::abs(u.at(a, f)); }));
  return int(std::ceil(ranks.global_max(fastest) * dt / layout.h() - rounding));
}

// One part of a step. What is beyond the room of cells is handed on at its end, where solids are known to be.
template <int Dim>
VolumeStep carry_part(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                      const FrozenFlow<Dim>& flow, const CellField<Dim>& phi, const Ledger<Dim>& ledger,
                      const RoomChange<Dim>& change, bool is_last, CellField<Dim>& share) {
  const CountedShares<Dim> counted(layout, ledger, phi, share, flow.velocity.fed);
  const LiquidInCells<Dim> liquid(layout, phi, counted, ledger.divergence == Divergence::stays);
  FaceField<Dim> flux = fluxes(layout, ledger.room, flow, liquid, counted);
  if (!ledger.room.is_whole()) keep_to_what_is_there(layout, halo, ranks, share, flux);
  double swollen = 0;
  if (ledger.divergence == Divergence::swells) {
    CellField<Dim> gain(layout);
    for_each_site(layout, layout.cells(), [&](Site c) { gain[c] = swelling(layout, ledger.room, flow, counted, c); });
    for_each_site(layout, layout.cells(), [&](Site c) { share[c] += gain[c]; });
    swollen = local_sum(layout, layout.cells(), [&](Site c, const IVec<Dim>&) { return gain[c]; });
  }
  const auto passes = [&](Site c) {
    bool any = false;
    for (int a = 0; a < Dim; ++a)
      any = any || !all_zero(flux[a].data() + c) || !all_zero(flux[a].data() + c + layout.stride(a));
    return any;
  };
  for_each_possible(layout, layout.cells(), passes, [&](Site c) {
    double change = 0;
    for (int a = 0; a < Dim; ++a) change += flux.at(a, c) - flux.at(a, c + layout.stride(a));
    if (change != 0) share[c] += change;
  });
  const double brought = add_brought(flow, share);
  fill_share_ghosts(layout, halo, share);
  std::array<double, 3> sums{entering(layout, flux), swollen, brought};
  ranks.global_sum(sums);
  const bool hands_on = is_last || !ledger.has_moved();
  return {sums[0], sums[1], sums[2],
          hands_on ? hand_on_excess(layout, halo, ranks, phi, ledger, change, share) : Spill{}, 0};
}

}  // namespace

template <int Dim>
VolumeStep carry_volume(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                        const std::type_identity_t<VolumeFlow<Dim>>& flow, double dt, const CellField<Dim>& phi,
                        const Ledger<Dim>& ledger, CellField<Dim>& share) {
  constexpr int most_parts = 4;
  const Trace trace = ledger.divergence == Divergence::stays ? Trace::midpoint : Trace::third_order;
  CellField<Dim, char> fed;
  if (!flow.fed.empty()) fed = CellField<Dim, char>(layout);
  for (const Site c : flow.fed) fed[c] = 1;
  const RoomChange<Dim> change =
      ledger.has_moved() ? change_of_room(layout, ledger, flow.through, dt) : RoomChange<Dim>();
  VolumeStep all;
  for (int parts = 1, done = 0; done < parts;) {
    const double part = dt / parts;
    for (const Site c : flow.fed) share[c] = 1;
    const int reach = std::min(layout.halo() - 2, cells_of_paths(layout, ranks, flow.u, part));
    const CellField<Dim, char> near =
        near_surface(layout, CountedShares<Dim>(layout, ledger, phi, share, flow.fed), reach);
    const NodeOrigins<Dim> origins(layout, flow.u, part, near, trace);
    const std::int64_t too_far = ranks.global_sum(origins.too_far());
    if (too_far > 0 && done == 0 && parts < most_parts) {
      parts *= 2;
      continue;
    }
    all += carry_part(layout, halo, ranks, {flow, part, 1.0 / parts, near, origins, fed}, phi, ledger, change,
                      done + 1 == parts, share);
    all.too_far += too_far;
    ++done;
  }
  return all;
}

template VolumeStep carry_volume<2>(const Layout<2>&, const Halo<2>&, const Communicator&, const VolumeFlow<2>&, double,
                                    const CellField<2>&, const Ledger<2>&, CellField<2>&);
template VolumeStep carry_volume<3>(const Layout<3>&, const Halo<3>&, const Communicator&, const VolumeFlow<3>&, double,
                                    const CellField<3>&, const Ledger<3>&, CellField<3>&);

}  // namespace seiche
