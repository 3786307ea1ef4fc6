#include "fluid/volume/room.h"

#include "fluid/volume/neighbours.h"
#include "levelset/fractions.h"

namespace seiche {

// psi is not stored above the last cells.
template <int Dim>
OpenParts<Dim> measure_open_parts(const Layout<Dim>& layout, const Halo<Dim>& halo, const NodeField<Dim>& psi,
                                  const PagedFaceField<Dim>& open) {
  Box<Dim> box = layout.padded();
  box.upper.array() -= 1;
  CellField<Dim> cells(layout, 1);
  for_each_site(layout, box, [&](Site c) { cells[c] = open_share(layout, psi, c); });
  halo.fill_ghosts(cells);
  FaceField<Dim> faces(layout, 1);
  for (int a = 0; a < Dim; ++a) for_each_site(layout, layout.padded(), [&](Site f) { faces.at(a, f) = open.at(a, f); });
  halo.fill_ghosts(faces);
  OpenParts<Dim> parts{PagedCellField<Dim>(layout, 1), PagedFaceField<Dim>(layout, 1)};
  for_each_index_in_order(layout, layout.padded(), [&](Site s, const IVec<Dim>&) {
    parts.cells.set(s, cells[s]);
    for (int a = 0; a < Dim; ++a) parts.faces.set(a, s, faces.at(a, s));
  });
  return parts;
}

template <int Dim>
bool Room<Dim>::joins(const Layout<Dim>& layout, Site cell, const IVec<Dim>& offset) const {
  if (!parts_) return true;
  bool there = true;
  for (int a = 0; a < Dim; ++a) {
    if (offset[a] == 0) continue;
    there = false;
    const Site next = cell + offset[a] * layout.stride(a);
    if (through(a, std::max(cell, next)) == 0) continue;
    IVec<Dim> rest = offset;
    rest[a] = 0;
    if (joins(layout, next, rest)) return true;
  }
  return there;
}

template <int Dim>
std::optional<Site> Room<Dim>::host_of(const Layout<Dim>& layout, Site cell) const {
  const double own = of(cell);
  std::optional<Site> host;
  if (own == 0 || own >= little) return host;
  double widest = 0;
  for (int a = 0; a < Dim; ++a)
    for (const int way : {-1, 1}) {
      const Site next = cell + way * layout.stride(a);
      const double open = through(a, std::max(cell, next));
      if (!(open > widest && of(next) > own)) continue;
      if (!lies_in_domain(layout.geometry(), IVec<Dim>(layout.index(cell) + way * IVec<Dim>::Unit(a)))) continue;
      widest = open, host = next;
    }
  return host;
}

template OpenParts<2> measure_open_parts<2>(const Layout<2>&, const Halo<2>&, const NodeField<2>&,
                                            const PagedFaceField<2>&);
template OpenParts<3> measure_open_parts<3>(const Layout<3>&, const Halo<3>&, const NodeField<3>&,
                                            const PagedFaceField<3>&);
template class Room<2>;
template class Room<3>;

}  // namespace seiche
