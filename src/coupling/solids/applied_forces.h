#pragma once
// Forces of the scene on solids that forces move.
#include "coupling/state/force.h"
#include "coupling/state/interaction.h"

namespace seiche {

// Adds the forces to the solids' momentum over a step, and what resists motion to their mass. Fields give a body m a at
// its centre of mass and the torque of its change over the body, each node of an elastic one its own. Keeps
// references.
template <int Dim>
std::unique_ptr<const Interaction<Dim>> make_applied_forces(const Domain<Dim>& domain,
                                                            const std::vector<Force<Dim>>& forces);

// Force (N) and torque about the centre of mass (N m) by which fields and loads act at time t (s) on a rigid solid,
// were it at `pose`.
template <int Dim>
Eigen::Matrix<double, 6, 1> steady_load(const std::vector<Force<Dim>>& forces, const Participant<Dim>& solid,
                                        const Pose& pose, double t);

}  // namespace seiche
