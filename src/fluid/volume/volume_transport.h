#pragma once
// The volume of liquid, carried through the faces of cells along the flow: unsplit, geometric, conserved to rounding.
#include "fluid/volume/spill.h"

namespace seiche {

using CellValues = std::vector<std::pair<Site, double>>;  // of owned cells

// Volumes that a step moved, in cells, over all ranks.
struct VolumeStep {
  double entered = 0;        // through the sides of the domain, net
  double swollen = 0;        // by the flow's divergence
  double fed = 0;            // by VolumeFlow::brought
  Spill spill;               // moved by hand
  std::int64_t too_far = 0;  // nodes whose path is longer than longest_path(), and was cut there

  VolumeStep& operator+=(const VolumeStep& other) {
    entered += other.entered, swollen += other.swollen, fed += other.fed;
    spill.moved += other.spill.moved, spill.worst = std::max(spill.worst, other.spill.worst);
    too_far += other.too_far;
    return *this;
  }
};

// Velocities that carry volumes, m/s. Paths follow u. The volume that passes a face is `through` times its open share.
// Both are the same but where u is continued: across faces that solids all but close, and beyond inflow sides.
template <int Dim>
struct VolumeFlow {
  const FaceField<Dim>&u, &through;
  bool enters = false;         // liquid may enter through sides: the same on all ranks
  std::vector<Site> fed = {};  // cells beyond the sides, full of liquid that enters
  // Liquid that is added to owned cells in the step, as shares of them, evenly in time; less than 0: taken, as far as
  // there is any.
  CellValues brought = {};

  VolumeFlow(const FaceField<Dim>& path) : u(path), through(path) {}  // NOLINT: alone in closed boxes u will do
  VolumeFlow(const FaceField<Dim>& path, const FaceField<Dim>& solved, bool may_enter, std::vector<Site> full)
      : u(path), through(solved), enters(may_enter), fed(std::move(full)) {}
};

// Cells along each axis that a path may cross: what a halo holds less the layers that planes and regions take.
template <int Dim>
double longest_path(const Layout<Dim>& layout) {
  return layout.halo() - 2.5;
}

// Carries `share`, the liquid's share of each cell, over dt (s) along the frozen flow:
//   V(t + dt) = V(t) - sum of the liquid in the regions that pass the faces.
// phi (m) gives the normals of smooth surfaces. Steps with paths beyond
// longest_path() are taken in parts. Ghosts of all fields must be filled; those of `share` are filled afterwards.
// Results do not depend on the ranks. Collective.
template <int Dim>
VolumeStep carry_volume(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                        const std::type_identity_t<VolumeFlow<Dim>>& flow, double dt, const CellField<Dim>& phi,
                        const Ledger<Dim>& ledger, CellField<Dim>& share);

}  // namespace seiche
