#pragma once
// Energy that a time step itself adds to an elastic body, and its removal.
#include "solid/elastic/minimize.h"

namespace seiche {

// What a step of the scheme made of a body's displacements and velocities.
struct ElasticEnds {
  const Eigen::VectorXd &u0, &v0;  // before, m, m/s
  const Eigen::VectorXd& u;        // after
};

// Second-order multistep schemes take energy over many steps and may add some in one. A body that nothing but its load
// f and pins at rest act on has E = K + Psi - f.u, K of the motion relative to its mean along axes without pins, and
// what E rose by in the step is taken from its deformation rate d (relative to its rigid motion, or of its free nodes
// if pinned), as projection methods do (Hairer, Lubich, Wanner 2006, IV.4), but to less energy only:
//   v = V + s d,   K(V + s d) = K(V + d) - max(E1 - E0, 0),   0 <= s <= 1.
// E1 - E0 is O(dt^3) and so is 1 - s: the order stays; V keeps both momenta. A body that liquid, contact or moving pins
// act on is left as it is. `step` is what the step minimised; v becomes V + s d.
template <int Dim>
void remove_excess_energy(const IncrementalPotential<Dim>& step, const Pins& pins, const ElasticEnds& ends,
                          Eigen::VectorXd& v);

}  // namespace seiche
