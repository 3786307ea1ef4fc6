#include "fluid/volume/volume_transport.h"

#include <atomic>

#include "fluid/transport/advection.h"
#include "fluid/volume/liquid_in_cells.h"
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
CellField<Dim, char> near_surface(const Layout<Dim>& layout, const CellField<Dim>& share, int reach) {
  CellField<Dim, char> near(layout);
  const Box<Dim> all = layout.padded();
  for_each_index(layout, all, [&](Site c, const IVec<Dim>& i) {
    near[c] = is_mixed(share[c]);
    for (int a = 0; a < Dim && !near[c]; ++a)
      near[c] = i[a] > all.lower[a] && (share[c] > 0.5) != (share[c - layout.stride(a)] > 0.5);
  });
  for (int a = 0; a < Dim; ++a) {
    const CellField<Dim, char> old = near;
    for_each_index(layout, all, [&](Site c, const IVec<Dim>& i) {
      const int from = std::max(-reach, all.lower[a] - i[a]), to = std::min(reach, all.upper[a] - 1 - i[a]);
      for (int k = from; k <= to && !near[c]; ++k) near[c] = old[c + k * layout.stride(a)];
    });
  }
  return near;
}

// Origins of the nodes of marked cells, in cells.
template <int Dim>
class NodeOrigins {
 public:
  NodeOrigins(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, const CellField<Dim, char>& near)
      : index_(layout, -1) {
    Box<Dim> box = layout.cells();
    if (!box.empty()) box.upper.array() += 1;
    const std::vector<Site> nodes = listed_possible(
        layout, box, [](Site) { return true; }, [&](Site s) { return touches(layout, near, s); });
    for (std::size_t n = 0; n < nodes.size(); ++n) index_[nodes[n]] = std::int32_t(n);
    origin_.resize(nodes.size());
    const double longest = longest_path(layout);
    for_each_listed(nodes, [&](Site s) {
      const IVec<Dim> i = layout.index(s);
      const Vec<Dim> x = layout.position(i, node_offset<Dim>()), here = i.template cast<double>();
      const Vec<Dim> from = trace_third_order<Dim>(layout, u, sample_velocity<Dim>(layout, u, x), x, dt);
      const Vec<Dim> way = (from - layout.geometry().lower) / layout.h() - here;
      origin_[std::size_t(index_[s])] = here + way.cwiseMax(-longest).cwiseMin(longest);
      if (!(way.cwiseAbs().maxCoeff() <= longest + rounding)) ++too_far_;
    });
  }
  std::int64_t too_far() const { return too_far_; }
  const Vec<Dim>& operator[](Site node) const { return origin_[std::size_t(index_[node])]; }

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

  NodeField<Dim, std::int32_t> index_;
  std::vector<Vec<Dim>> origin_;
  std::atomic<std::int64_t> too_far_ = 0;
};

// Liquid that passes each face of the owned cells towards +axis in the step, in cells. Counts the paths cut short.
template <int Dim>
FaceField<Dim> fluxes(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, const CellField<Dim>& phi,
                      const CellField<Dim>& share, std::int64_t& too_far) {
  const CellField<Dim, char> near = near_surface(layout, share, layout.halo() - 2);
  const LiquidInCells<Dim> liquid(layout, phi, share);
  const NodeOrigins<Dim> origins(layout, u, dt, near);
  too_far = origins.too_far();
  FaceField<Dim> r(layout);
  for (int a = 0; a < Dim; ++a) {
    const auto steps = corner_steps<Dim>(a);
    for_each_index(layout, faces_of_cells(layout, a), [&](Site f, const IVec<Dim>& i) {
      const double volume = u.at(a, f) * dt / layout.h();
      if (!near[f] && !near[f - layout.stride(a)]) {
        if (share[f] > 0.5) r.at(a, f) = volume;
        return;
      }
      TracedFace<Dim> face{a, {}, {}};
      for (std::size_t k = 0; k < steps.size(); ++k) {
        face.now[k] = (i + steps[k]).template cast<double>();
        face.before[k] = origins[layout.site(i + steps[k])];
      }
      const SweptRegion<Dim> region(face, volume);
      double sum = 0;
      for (const Simplex<Dim>& s : region.simplices()) sum += liquid.within(s);
      r.at(a, f) = sum;
    });
  }
  return r;
}

// Gain of the liquid in a cell by the flow's divergence, in cells: full cells stay full.
template <int Dim>
double swelling(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, const CellField<Dim>& share, Site c) {
  constexpr double rounding = 1e-12;
  double net = 0;
  for (int a = 0; a < Dim; ++a) net += (u.at(a, c + layout.stride(a)) - u.at(a, c)) * dt / layout.h();
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

}  // namespace

template <int Dim>
VolumeStep carry_volume(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                        const FaceField<Dim>& u, double dt, const CellField<Dim>& phi, CellField<Dim>& share) {
  std::int64_t too_far = 0;
  const FaceField<Dim> flux = fluxes(layout, u, dt, phi, share, too_far);
  const CellField<Dim> old = share;
  for_each_site(layout, layout.cells(), [&](Site c) {
    for (int a = 0; a < Dim; ++a) share[c] += flux.at(a, c) - flux.at(a, c + layout.stride(a));
    share[c] += swelling(layout, u, dt, old, c);
  });
  fill_share_ghosts(layout, halo, share);
  const double swollen =
      local_sum(layout, layout.cells(), [&](Site c, const IVec<Dim>&) { return swelling(layout, u, dt, old, c); });
  std::array<double, 3> sums{entering(layout, flux), swollen, double(too_far)};
  ranks.global_sum(sums);
  return {sums[0], sums[1], hand_on_excess(layout, halo, ranks, share), std::int64_t(sums[2])};
}

template VolumeStep carry_volume<2>(const Layout<2>&, const Halo<2>&, const Communicator&, const FaceField<2>&, double,
                                    const CellField<2>&, CellField<2>&);
template VolumeStep carry_volume<3>(const Layout<3>&, const Halo<3>&, const Communicator&, const FaceField<3>&, double,
                                    const CellField<3>&, CellField<3>&);

}  // namespace seiche
