#pragma once
// What the velocity at each face centre is to the viscous stress.
#include "fluid/viscosity/viscous_shares.h"

namespace seiche {

// none: no viscous liquid touches it. unknown: of the liquid. solid: the velocity of a no-slip solid in which the face
// centre lies or which closes the face. given: known beforehand (sides of the domain).
enum class SampleKind : char { none, unknown, solid, given };

// On the faces of the owned cells and two layers around.
template <int Dim>
struct ViscousSamples {
  FaceField<Dim, char> kind;           // SampleKind
  FaceField<Dim, std::int16_t> solid;  // the nearest solid, -1 without
  FaceField<Dim> given;                // m/s
  FaceField<Dim> psi;                  // distance to that solid, m
  ViscousShares<Dim> share;
  FaceRows<Dim> rows;
  // V = 1 and the same viscosity wherever liquid velocities differ, on all ranks: then the operator is the plain
  // Laplacian of each component but for solids that turn.
  bool plain = false;

  SampleKind kind_at(int axis, Site f) const { return SampleKind(kind.at(axis, f)); }
};

template <int Dim>
ViscousSamples<Dim> sample_faces(const ViscousInput<Dim>& in);

// The side of the domain in whose plane index i of a node line lies along an axis: 0, 1, or -1.
template <int Dim>
int side_at(const Layout<Dim>& layout, int axis, int i) {
  if (layout.geometry().periodic[axis]) return -1;
  return i == 0 ? 0 : i == layout.geometry().cells[axis] ? 1 : -1;
}

}  // namespace seiche
