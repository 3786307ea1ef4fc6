#pragma once
// Open fraction, kind and prescribed flux of each face of the grid during one step.
#include "grid/paged_fields.h"

namespace seiche {

// closed: entirely solid. open: unknown velocity. prescribed: on a wall or inflow side, given velocity. outflow: on a
// side with a given pressure, unknown velocity.
enum class FaceKind : char { closed, open, prescribed, outflow };

template <int Dim>
struct FaceGeometry {
  PagedFaceField<Dim> open;           // w, open fraction, 0..1
  PagedFaceField<Dim, char> kind;     // FaceKind
  PagedFaceField<Dim> closed_flux;    // (1 - w) v_solid: flux through the solid part, per face area, m/s
  PagedFaceField<Dim> prescribed;     // velocity of prescribed faces, m/s
  PagedFaceField<Dim> side_pressure;  // Pa, on outflow faces
  PagedFaceField<Dim> entering;       // m/s, on outflow faces: speed of what came in before the step
  PagedCellField<Dim> cell_flux;      // flux out of a cell due to solids, not included in its faces, per face area, m/s

  FaceGeometry() = default;
  explicit FaceGeometry(const Layout<Dim>& layout)
      : open(layout, 1.0),
        kind(layout, char(FaceKind::open)),
        closed_flux(layout),
        prescribed(layout),
        side_pressure(layout),
        entering(layout),
        cell_flux(layout) {}

  FaceKind kind_at(int axis, Site s) const { return FaceKind(kind.at(axis, s)); }
  bool is_unknown(int axis, Site s) const {
    return kind_at(axis, s) == FaceKind::open || kind_at(axis, s) == FaceKind::outflow;
  }
};

// Calls visit(axis, face, sign, neighbour) for the faces of a cell. sign: -1 on the low face, +1 on the high one;
// neighbour: the cell across.
template <int Dim, class Visit>
void for_each_face_of(const Layout<Dim>& layout, Site cell, const Visit& visit) {
  for (int a = 0; a < Dim; ++a) {
    const Site d = layout.stride(a);
    visit(a, cell, -1, cell - d);
    visit(a, cell + d, +1, cell + d);
  }
}

}  // namespace seiche
