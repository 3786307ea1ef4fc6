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
  // Fluid that enters through an outflow side comes from rest: at the side it has the pressure p - rho u^2/2. Over the
  // half cell behind the side, with u_in the speed before the step:
  //   rho (h/2) (u - u*)/dt = p_side - rho u_in u/2 - p_i,  (1 + u_in dt/h) u = u* + dt (p_side - p_i)/(rho h/2).
  // Returns 1/(1 + u_in dt/h); 1 on other faces.
  double entry_factor(int axis, Site s, double dt_over_h) const { return 1 / (1 + entering.at(axis, s) * dt_over_h); }
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
