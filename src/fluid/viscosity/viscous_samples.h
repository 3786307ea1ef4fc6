#pragma once
// Role of the velocity at each face centre in the viscous stress.
#include "fluid/viscosity/viscous_shares.h"

namespace seiche {

// none: the face touches no viscous liquid. unknown: velocity of the liquid. solid: velocity of a no-slip solid that
// contains the face centre or closes the face. given: known velocity (sides of the domain).
enum class SampleKind : char { none, unknown, solid, given };

// Valid on the low faces of the owned cells and of two layers around.
template <int Dim>
struct ViscousSamples {
  FaceField<Dim, char> kind;           // SampleKind
  FaceField<Dim, std::int16_t> solid;  // the nearest solid, -1: none
  FaceField<Dim> given;                // m/s
  FaceField<Dim> psi;                  // signed distance from that solid, m
  ViscousShares<Dim> share;
  FaceRows<Dim> rows;
  // True if viscosity is uniform and V = 1 in all cells and edges that touch an unknown, on all ranks. The operator is
  // then the Laplacian of each component, except next to rotating solids.
  bool plain = false;

  SampleKind kind_at(int axis, Site f) const { return SampleKind(kind.at(axis, f)); }
};

// Distance psi at a face's centre (m), and the solid of the corner with the smallest psi.
template <int Dim>
std::pair<double, std::int16_t> nearest_solid(const Layout<Dim>& layout, const NodeField<Dim>& psi,
                                              const NodeField<Dim, std::int16_t>& body, int axis, Site face);

// Collective.
template <int Dim>
ViscousSamples<Dim> sample_faces(const ViscousInput<Dim>& in);

// The side of the domain (0 lower, 1 upper) that contains nodes of index i along an axis; -1: none.
template <int Dim>
int side_at(const Layout<Dim>& layout, int axis, int i) {
  if (layout.geometry().periodic[axis]) return -1;
  return i == 0 ? 0 : i == layout.geometry().cells[axis] ? 1 : -1;
}

}  // namespace seiche
