#include "fluid/pressure/air_regions.h"

#include "fluid/pressure/labelling.h"
#include "grid/loops.h"

namespace seiche {
namespace {

template <int Dim>
bool touches_kind(const ProjectionInput<Dim>& in, Site cell, bool outflow) {
  bool any = false;
  for_each_face_of(in.layout, cell, [&](int a, Site f, int, Site) {
    any = any || (outflow ? in.faces.kind_at(a, f) == FaceKind::outflow && in.faces.open.at(a, f) > 0
                          : in.faces.is_unknown(a, f));
  });
  return any;
}

// Numbers the air cells as number_rows() numbers the liquid ones.
template <int Dim>
PressureRows<Dim> number_air_cells(const ProjectionInput<Dim>& in) {
  PressureRows<Dim> rows;
  rows.row = CellField<Dim, std::int64_t>(in.layout, -1);
  for_each_index_in_order(in.layout, in.layout.cells(), [&](Site c, const IVec<Dim>&) {
    if (in.phi[c] >= 0 && touches_kind(in, c, false)) rows.cells.push_back(c);
  });
  rows.liquid = rows.cells.size();
  rows.first = in.ranks.exclusive_prefix_sum(std::int64_t(rows.liquid));
  for (std::size_t n = 0; n < rows.liquid; ++n) rows.row[rows.cells[n]] = rows.first + Row(n);
  in.halo.fill_ghosts({rows.row.data()});
  return rows;
}

}  // namespace

template <int Dim>
AirRegions<Dim> find_air_regions(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                                 const CellField<Dim>& phi, const FaceGeometry<Dim>& faces) {
  const ProjectionInput<Dim> in{layout, halo, ranks, phi, faces, 1, 1};
  const PressureRows<Dim> cells = number_air_cells(in);
  Labelling<Dim> labelling(in, cells);
  std::map<std::int64_t, bool> is_open;
  for (std::size_t n = 0; n < cells.liquid; ++n) {
    bool& open = is_open[labelling.label(int(n))];
    open = open || touches_kind(in, cells.cells[n], true);
  }
  AirRegions<Dim> air;
  std::map<std::int64_t, std::int64_t> number;
  std::int64_t count = 0;
  for (const auto& [label, open] : any_of_labels(is_open, ranks)) {
    number[label] = open ? open_air : count++;
    air.any_open = air.any_open || open;
  }
  air.volume.assign(std::size_t(count), 0.0);
  air.label = CellField<Dim, std::int64_t>(layout, no_air);
  for (std::size_t n = 0; n < cells.liquid; ++n) {
    const std::int64_t label = labelling.label(int(n)), mine = number.at(label);
    air.label[cells.cells[n]] = mine;
    if (mine >= 0 && label == cells.first + Row(n)) air.home.emplace_back(mine, cells.cells[n]);
  }
  halo.fill_ghosts({air.label.data()});
  return air;
}

template AirRegions<2> find_air_regions<2>(const Layout<2>&, const Halo<2>&, const Communicator&, const CellField<2>&,
                                           const FaceGeometry<2>&);
template AirRegions<3> find_air_regions<3>(const Layout<3>&, const Halo<3>&, const Communicator&, const CellField<3>&,
                                           const FaceGeometry<3>&);

}  // namespace seiche
