#pragma once
// Joints in messages.
#include "coupling/state/joint_rows.h"
#include "coupling/state/state.h"

namespace seiche {

// Names of joints that cannot close, each with those of the shortest loop of joints, not broken, that it is part of.
template <int Dim>
std::string names_of_loops(const JointSet<Dim>& joints, const State<Dim>& state, const std::vector<int>& open);

}  // namespace seiche
