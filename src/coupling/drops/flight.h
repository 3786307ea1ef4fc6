#pragma once
// Flight of drops through air: ballistic, stopped by walls and by the liquid's surface.
#include <string>

#include "coupling/drops/obstacles.h"
#include "coupling/state/force.h"

namespace seiche {

// Accelerations of liquid at points. Gravity is the mean of the step, m/s^2.
template <int Dim>
struct DropForces {
  Vec3 gravity;
  const std::vector<Force<Dim>>& forces;

  // Gain of velocity (m/s) within dt (s) of liquid with the velocity v at x. t: the middle of dt.
  Vec<Dim> gain(const Vec<Dim>& x, const Vec<Dim>& v, double t, double dt) const;
};

// True if the liquid's surface is within the radius of a drop, and a cell of phi < 0 (m) within one of its own.
template <int Dim>
bool reaches_liquid(const Layout<Dim>& layout, const CellField<Dim>& phi, const Drop<Dim>& drop);

// Drops that left through the sides, over all ranks: m^Dim, and the sum of V |v|^2/2.
struct DropsThatLeft {
  double volume = 0, energy = 0;
  bool is_finite = true;  // false: a force gives a drop no finite velocity
};

// Moves drops from one time to another (s), over parts of the way of at most half a cell:
//   x += v dt + a dt^2/2,   v += a dt.
// One that reaches liquid stays there; its velocity goes on to change. Drops end up on the ranks that own their cells,
// by id. phi must be valid in the halo. Collective.
template <int Dim>
DropsThatLeft fly(const Domain<Dim>& domain, const Obstacles<Dim>& obstacles, const DropForces<Dim>& forces,
                  const CellField<Dim>& phi, double from, double until, std::vector<Drop<Dim>>& drops);

// Makes one of all drops in a cell, with their volume and momentum, at their centre of mass. It has the id of the
// largest. Local.
template <int Dim>
void merge_drops(const Layout<Dim>& layout, std::vector<Drop<Dim>>& drops);

}  // namespace seiche
