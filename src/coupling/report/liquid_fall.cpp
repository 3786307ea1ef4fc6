#include "coupling/report/liquid_fall.h"

#include <algorithm>
#include <cmath>

#include "fluid/pressure/air_regions.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Cells of a room by layers across gravity, from below, and the sum of the layers of those with liquid.
struct RoomLayers {
  std::vector<double> cells;
  double liquid = 0, heights = 0;
};

// Sum of the layers of as many cells as have liquid, if they are the lowest ones.
double lowest_heights(const RoomLayers& room) {
  double left = room.liquid, sum = 0;
  for (std::size_t n = 0; n < room.cells.size() && left > 0; ++n) {
    const double filled = std::min(left, room.cells[n]);
    sum += filled * double(n);
    left -= filled;
  }
  return sum;
}

// Sums over the ranks.
void gather_rooms(std::vector<RoomLayers>& rooms, const Communicator& ranks) {
  std::vector<double> all;
  for (const RoomLayers& room : rooms) {
    all.insert(all.end(), room.cells.begin(), room.cells.end());
    all.insert(all.end(), {room.liquid, room.heights});
  }
  ranks.global_sum(all);
  const double* next = all.data();
  for (RoomLayers& room : rooms) {
    std::copy_n(next, room.cells.size(), room.cells.begin());
    next += room.cells.size();
    room.liquid = *next++, room.heights = *next++;
  }
}

// Faces as static solids alone leave them: gates open, and floats let liquid pass.
template <int Dim>
FaceGeometry<Dim> faces_among_static(const Solids<Dim>& solids, const StepGeometry<Dim>& geometry) {
  FaceGeometry<Dim> faces = geometry.faces;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
    if (!solids.bodies[k].moves() || !geometry.shares[k]) continue;
    for (const FaceShare& s : *geometry.shares[k]) {
      faces.open.add(s.axis, s.face, s.closed);
      if (faces.kind_at(s.axis, s.face) == FaceKind::closed) faces.kind.set(s.axis, s.face, char(FaceKind::open));
    }
  }
  return faces;
}

}  // namespace

template <int Dim>
double fall_of_liquid(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                      const State<Dim>& state, const StepGeometry<Dim>& geometry) {
  const Vec<Dim> g = truncate<Dim>(fluids.gravity.at(0));
  if (!(g.norm() > 0) || !domain.ranks.any(!geometry.psi.empty())) return 0;  // a rank may have no cells
  const auto& grid = domain.layout.geometry();
  const CellField<Dim> everywhere(domain.layout, 1.0);
  const AirRegions<Dim> parts =
      find_air_regions(domain.layout, domain.halo, domain.ranks, everywhere, faces_among_static(solids, geometry));
  // Layer of a cell: its height over the lowest corner of the domain, in cells.
  const Vec<Dim> up = -g.normalized(), size = grid.cells.template cast<double>();
  const double low = up.cwiseProduct(size).cwiseMin(0.0).sum(), high = up.cwiseProduct(size).cwiseMax(0.0).sum();
  std::vector<RoomLayers> rooms(std::size_t(parts.count()) + 1, {std::vector<double>(std::size_t(high - low) + 1)});
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    if (parts.label[c] == no_air) return;
    RoomLayers& room = rooms[std::size_t(parts.label[c] == open_air ? parts.count() : parts.label[c])];
    const Vec<Dim> middle = i.template cast<double>() + Vec<Dim>::Constant(0.5);
    const auto layer = std::size_t(std::max(0.0, up.dot(middle) - low));
    room.cells[std::min(layer, room.cells.size() - 1)] += 1;
    if (state.phi[c] >= 0) return;
    room.liquid += 1;
    room.heights += double(layer);
  });
  gather_rooms(rooms, domain.ranks);
  double liquid = 0, fall = 0;
  for (const RoomLayers& room : rooms) liquid += room.liquid, fall += room.heights - lowest_heights(room);
  return liquid > 0 ? domain.layout.h() * fall / liquid : 0;
}

template double fall_of_liquid<2>(const Domain<2>&, const Fluids&, const Solids<2>&, const State<2>&,
                                  const StepGeometry<2>&);
template double fall_of_liquid<3>(const Domain<3>&, const Fluids&, const Solids<3>&, const State<3>&,
                                  const StepGeometry<3>&);

}  // namespace seiche
