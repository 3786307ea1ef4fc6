#pragma once
// Liquid that enters through inflow sides: its values at the side, its velocity and level set beyond the side.
#include <optional>

#include "fluid/boundary/domain_boundary.h"

namespace seiche {

// Place and time at which a path crosses an inflow side that lets liquid in.
template <int Dim>
struct Entry {
  int axis, side;
  Vec<Dim> x;
  double time;    // s
  double inside;  // s, from the crossing to the end of the path
};

// Last entry of the straight path from `from` at time t to `to` at t + dt; empty if the path crosses no inflow. A face
// of a side lets liquid in if the velocity at its centre points inward. A path that crosses a face next to a jet is
// assigned to the nearest face of the jet.
template <int Dim>
std::optional<Entry<Dim>> find_entry(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, const Vec<Dim>& from,
                                     const Vec<Dim>& to, double t, double dt);

// Prescribed velocity at an entry, m/s.
template <int Dim>
Vec<Dim> velocity_of(const DomainBoundary<Dim>& sides, const Entry<Dim>& entry);

// Extends u (m/s, ghosts filled) beyond faces of inflow sides that let liquid in: odd about the velocity prescribed
// there at time t for two layers, constant beyond. Applies to all components, so that interpolation returns the
// prescribed velocity at the side. At sides with waves the component across is odd about the velocity of the face.
// Local.
template <int Dim>
void continue_beyond_inflows(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t, FaceField<Dim>& u);

// Sets invalid faces of inflow sides next to faces that let liquid in, and the layers beyond them, to the velocity one
// cell inside. The stream drags this air along; with the wall's velocity beside its rim it would be held back. Ghosts
// of u and valid must be filled. For paths. Local.
template <int Dim>
void let_air_follow(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t,
                    const FaceField<Dim, char>& valid, FaceField<Dim>& u);

// Cells beyond the faces of inflow sides that let liquid in at time t, all layers that are stored. Local.
template <int Dim>
std::vector<Site> cells_beyond_inflows(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t);

// Adds the liquid that enters through inflow sides at time t to the level set, beyond the sides and next to them.
// Ghosts of phi must be filled; fills them. Collective.
template <int Dim>
void join_inflow(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                 const DomainBoundary<Dim>& sides, double t, CellField<Dim>& phi);

}  // namespace seiche
