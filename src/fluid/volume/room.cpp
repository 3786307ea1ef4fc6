#include "fluid/volume/room.h"

#include <algorithm>

#include "fluid/volume/neighbours.h"
#include "grid/groups.h"
#include "grid/loops.h"
#include "levelset/fractions.h"

namespace seiche {

namespace {

// 1 - K on the owned cells. Groups of cells whose nodes all have psi >= 0 are passed over.
template <int Dim>
CellField<Dim> closed_cells_of(const Layout<Dim>& layout, const NodeField<Dim>& psi) {
  constexpr int corners = 1 << Dim;
  std::array<Site, corners> corner{};
  for (int k = 0; k < corners; ++k)
    for (int a = 0; a < Dim; ++a) corner[std::size_t(k)] += (k >> a & 1) * layout.stride(a);
  CellField<Dim> closed(layout);
  const auto may_matter = [&](Site c) {
    return std::any_of(corner.begin(), corner.end(), [&](Site o) { return any_negative(psi.data() + c + o); });
  };
  for_each_possible(layout, layout.cells(), may_matter, [&](Site c) {
    if (const double k = open_share(layout, psi, c); k != 1) closed[c] = 1 - k;
  });
  return closed;
}

// to = 1 - closed, wherever sites are stored.
template <int Dim>
void set_open(const Layout<Dim>& layout, const double* closed, PagedValues<double>& to) {
  for (const Site s : listed_possible(
           layout, layout.padded(), [&](Site c) { return !all_zero(closed + c); },
           [&](Site c) { return closed[c] != 0; }))
    to.set(s, 1 - closed[s]);
}

}  // namespace

template <int Dim>
void fill_open_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, OpenParts<Dim>& parts) {
  CellField<Dim> cells(layout);
  FaceField<Dim> faces(layout);
  parts.cells.for_each_stored([&](Site c, double open) {
    if (open != 1 && layout.cells().contains(layout.index(c))) cells[c] = 1 - open;
  });
  for (int a = 0; a < Dim; ++a)
    parts.faces[a].for_each_stored([&](Site f, double open) {
      if (open != 1 && layout.faces(a).contains(layout.index(f))) faces.at(a, f) = 1 - open;
    });
  halo.fill_ghosts(cells);
  halo.fill_ghosts(faces);
  parts = OpenParts<Dim>(layout);
  set_open(layout, cells.data(), parts.cells);
  for (int a = 0; a < Dim; ++a) set_open(layout, faces[a].data(), parts.faces[a]);
}

template <int Dim>
OpenParts<Dim> measure_open_parts(const Layout<Dim>& layout, const Halo<Dim>& halo, const NodeField<Dim>& psi,
                                  const PagedFaceField<Dim>& open) {
  OpenParts<Dim> parts(layout);
  set_open(layout, closed_cells_of(layout, psi).data(), parts.cells);
  parts.faces = open;
  fill_open_ghosts(layout, halo, parts);
  return parts;
}

template <int Dim>
bool Room<Dim>::joins(const Layout<Dim>& layout, Site cell, const IVec<Dim>& offset) const {
  if (is_whole()) return true;
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

template void fill_open_ghosts<2>(const Layout<2>&, const Halo<2>&, OpenParts<2>&);
template void fill_open_ghosts<3>(const Layout<3>&, const Halo<3>&, OpenParts<3>&);
template OpenParts<2> measure_open_parts<2>(const Layout<2>&, const Halo<2>&, const NodeField<2>&,
                                            const PagedFaceField<2>&);
template OpenParts<3> measure_open_parts<3>(const Layout<3>&, const Halo<3>&, const NodeField<3>&,
                                            const PagedFaceField<3>&);
template class Room<2>;
template class Room<3>;

}  // namespace seiche
