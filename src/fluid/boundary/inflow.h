#pragma once
// Liquid that enters through inflow sides: what it brings along, and its velocity beyond the side.
#include <optional>

#include "fluid/boundary/domain_boundary.h"

namespace seiche {

// Where and when a path crossed an inflow side that lets liquid in.
template <int Dim>
struct Entry {
  int axis, side;
  Vec<Dim> x;
  double time;    // s
  double inside;  // s, from the crossing to the end of the path
};

// Of the straight path that ends at `to` at time t + dt and begins at `from` at t; empty where it crosses none. The
// faces of a side let liquid in as a whole, by the velocity at their centres. Paths at the rim of a jet that cross a
// face beside count as from the nearest face that does.
template <int Dim>
std::optional<Entry<Dim>> find_entry(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, const Vec<Dim>& from,
                                     const Vec<Dim>& to, double t, double dt);

// Velocity that the side prescribes at an entry, m/s.
template <int Dim>
Vec<Dim> velocity_of(const DomainBoundary<Dim>& sides, const Entry<Dim>& entry);

// Continues u (m/s, ghosts filled) beyond faces of inflow sides that let liquid in: odd about the velocity prescribed
// there at time t for two layers, constant beyond. All components, so that interpolation finds that velocity at the
// side. Local.
template <int Dim>
void continue_beyond_inflows(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t, FaceField<Dim>& u);

// Gives dry faces of inflow sides next to those that let liquid in the velocity of the air before them (ghosts of u and
// valid filled): the stream takes it along, and would be held back by a wall beside its rim. For paths. Local.
template <int Dim>
void let_air_follow(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t,
                    const FaceField<Dim, char>& valid, FaceField<Dim>& u);

// Makes the level set know the liquid that comes through inflow sides at time t. Ghosts of phi must be filled; fills
// them. Collective.
template <int Dim>
void join_inflow(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                 const DomainBoundary<Dim>& sides, double t, CellField<Dim>& phi);

}  // namespace seiche
