#pragma once
// Enclosed air that keeps its volume: each connected region of air cells is one pressure unknown (Goldade, Aanjaneya,
// Batty 2020).
#include <cstdint>
#include <utility>
#include <vector>

#include "fluid/boundary/face_geometry.h"
#include "grid/halo.h"

namespace seiche {

constexpr std::int64_t no_air = -1, open_air = -2;

template <int Dim>
struct AirRegions {
  // By cell: the number of its enclosed region, open_air if the region reaches an outflow side, no_air in liquid and in
  // solids. Ghosts filled.
  CellField<Dim, std::int64_t> label;
  std::vector<std::pair<std::int64_t, Site>> home;  // number and first cell of the regions whose row this rank owns
  std::vector<double> volume;                       // target volume of each region, m^Dim, equal on all ranks
  // Volume of each region beyond its target, m^Dim, equal on all ranks. Only where volumes are carried in cells.
  std::vector<double> excess;
  bool any_open = false;  // over all ranks

  std::int64_t count() const { return std::int64_t(volume.size()); }
};

// Finds the connected regions of cells with phi >= 0 and a face of unknown velocity, joined by open faces. Sets all
// volumes to zero. Collective.
template <int Dim>
AirRegions<Dim> find_air_regions(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                                 const CellField<Dim>& phi, const FaceGeometry<Dim>& faces);

}  // namespace seiche
