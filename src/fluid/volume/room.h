#pragma once
// The part of cells and faces that solids leave to the liquid.
#include <optional>

#include "grid/halo.h"
#include "grid/paged_fields.h"

namespace seiche {

// Open shares of cells and faces, 0..1, equal on all ranks and at periodic images.
template <int Dim>
struct OpenParts {
  PagedCellField<Dim> cells;
  PagedFaceField<Dim> faces;

  OpenParts() = default;
  explicit OpenParts(const Layout<Dim>& layout) : cells(layout, 1), faces(layout, 1) {}
};
// psi: distance to the solids at nodes (m). open: share of the faces. Collective.
template <int Dim>
OpenParts<Dim> measure_open_parts(const Layout<Dim>& layout, const Halo<Dim>& halo, const NodeField<Dim>& psi,
                                  const PagedFaceField<Dim>& open);
// Takes ghosts from the ranks that own them. Collective.
template <int Dim>
void fill_open_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, OpenParts<Dim>& parts);

// Beside solids thicker than a cell.
template <int Dim>
class Room {
 public:
  Room() = default;  // no solids
  explicit Room(const OpenParts<Dim>& parts) : Room(parts, parts) {}
  // Cells and faces at two times, where solids move. Keeps the references.
  Room(const OpenParts<Dim>& cells, const OpenParts<Dim>& faces) : cells_(&cells.cells), faces_(&faces.faces) {}

  bool operator==(const Room&) const = default;  // of the same solids at the same time
  bool is_whole() const { return !cells_; }
  // K of a cell, w of a face.
  double of(Site cell) const { return cells_ ? (*cells_)[cell] : 1; }
  double through(int axis, Site face) const { return faces_ ? faces_->at(axis, face) : 1; }

  // Calls visit(cell, K) in order: for all cells with K < 1, and some more.
  template <class Visit>
  void each_stored(const Visit& visit) const {
    if (cells_) cells_->for_each_stored(visit);
  }

  // True if a path of open faces, one for each axis with offset[axis] != 0, leads from a cell to the cell at `offset`
  // (-1, 0 or 1 along each axis). Neighbouring cells may lie on two sides of a wall.
  bool joins(const Layout<Dim>& layout, Site cell, const IVec<Dim>& offset) const;

  // Calls visit(cell, host) in order for the cells of a box that have little room. The host is the neighbour that such
  // a cell shares its liquid with: the one behind the most open face of those with more room.
  template <class Visit>
  void each_with_host(const Layout<Dim>& layout, const Box<Dim>& box, const Visit& visit) const {
    if (!cells_) return;
    cells_->for_each_stored([&](Site c, double room) {
      if (room == 0 || room >= little || !box.contains(layout.index(c))) return;
      if (const std::optional<Site> host = host_of(layout, c)) visit(c, *host);
    });
  }
  std::optional<Site> host_of(const Layout<Dim>& layout, Site cell) const;

 private:
  static constexpr double little = 0.3;

  const PagedCellField<Dim>* cells_ = nullptr;
  const PagedFaceField<Dim>* faces_ = nullptr;
};

}  // namespace seiche
