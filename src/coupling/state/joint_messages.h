#pragma once
// Joints in messages.
#include "coupling/state/joint_rows.h"

namespace seiche {

// Names of joints that cannot close, each with those of the shortest loop that it is part of.
template <int Dim>
std::string names_of_loops(const JointSet<Dim>& joints, const Participants<Dim>& solids, const std::vector<int>& open);

}  // namespace seiche
