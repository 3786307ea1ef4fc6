#pragma once
// Time levels of the flow of one fluid.
#include <memory>

#include "grid/fields.h"

namespace seiche {

// One time level of the flow.
template <int Dim>
struct TimeLevel {
  FaceField<Dim> u;            // m/s, extrapolated beyond the fluid, ghosts filled
  FaceField<Dim, char> valid;  // not 0 where u was solved for or prescribed next to the fluid (codes: restore.h)
  FaceField<Dim> q;            // grad p / rho of the step that led here, m/s^2, where valid
  FaceField<Dim> n;            // viscous acceleration at this time, m/s^2, where valid; empty in inviscid scenes
};

// Time levels of one fluid's flow, extrapolated beyond its own region. Null: no such level. `before` and `earlier` are
// null at the start.
template <int Dim>
struct Flow {
  std::shared_ptr<const TimeLevel<Dim>> now, before, earlier;
};

// Moves each level one step into the past. `now` stays until a solve replaces it.
template <int Dim>
void age(Flow<Dim>& flow) {
  flow.earlier = flow.before;
  flow.before = flow.now;
}

// Velocities on the two faces of a cell along an axis, m/s. A face that the fluid does not touch has the velocity of
// the other face. If it touches neither, both are extrapolated.
struct FacePair {
  double low = 0, high = 0;
};
template <int Dim>
FacePair solved_faces(const Layout<Dim>& layout, const TimeLevel<Dim>& level, int axis, Site cell) {
  const Site up = cell + layout.stride(axis);
  const bool low = level.valid.at(axis, cell), high = level.valid.at(axis, up);
  return {level.u.at(axis, high && !low ? up : cell), level.u.at(axis, low && !high ? cell : up)};
}

// A level at rest, without valid faces.
template <int Dim>
TimeLevel<Dim> empty_level(const Layout<Dim>& layout, bool viscous) {
  return {FaceField<Dim>(layout), FaceField<Dim, char>(layout), FaceField<Dim>(layout),
          viscous ? FaceField<Dim>(layout) : FaceField<Dim>()};
}

}  // namespace seiche
