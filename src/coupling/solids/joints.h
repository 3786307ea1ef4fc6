#pragma once
// Joints between solids as an interaction: constraints, forces, and places where they are closed.
#include "coupling/solids/joint_motion.h"
#include "coupling/state/interaction.h"

namespace seiche {

// Keeps a reference.
template <int Dim>
std::unique_ptr<const Interaction<Dim>> make_joint_interaction(const JointSet<Dim>& joints);

// Displaces the bodies as little as possible, weighted by mass, until all joints are closed at `time`: momenta
// and the centres of mass of free groups stay. Sets the rigid bodies' shown shift if `shown`, else their places; sets
// the coordinates of the joints. Returns the names of joints that do not close, or "".
template <int Dim>
std::string close_joints(const JointSet<Dim>& joints, const Communicator& ranks, double time, bool shown,
                         State<Dim>& state);

// Adds springs, dampers and motors without limits of the joints to mass and push, others to parts.potentials.
template <int Dim>
void add_joint_forces(const JointSet<Dim>& joints, const CoupledStep<Dim>& step, CouplingParts<Dim>& parts);

}  // namespace seiche
