#pragma once
// Removes energy that a time step has added to an elastic body.
#include "solid/elastic/minimize.h"

namespace seiche {

// A body's displacements and velocities before and after a step.
struct ElasticEnds {
  const Eigen::VectorXd &u0, &v0;  // before, m, m/s
  const Eigen::VectorXd& u;        // after
};

// Second-order multistep schemes dissipate energy over many steps but may add some in one. A body under its load f and
// resting pins alone has the energy E = K + Psi - f.u, with K of the motion relative to its mean along axes without
// pins. The rise of E in the step is taken from the deformation rate d: the velocity relative to the rigid motion, or
// of the free nodes if pinned. This is a projection (Hairer, Lubich, Wanner 2006, IV.4) that only ever lowers the
// energy:
//   v = V + s d,   K(V + s d) = K(V + d) - max(E1 - E0, 0),   0 <= s <= 1.
// E1 - E0 is O(dt^3) and so is 1 - s, so the order is kept; V keeps both momenta. Bodies under liquid, contact or
// moving pins are left unchanged. `step` is the minimised potential; v becomes V + s d.
template <int Dim>
void remove_excess_energy(const IncrementalPotential<Dim>& step, const Pins& pins, const ElasticEnds& ends,
                          Eigen::VectorXd& v);

}  // namespace seiche
