#pragma once
// Jointed bodies that leave the domain.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Throws Error(cannot_continue) where a rigid body is wholly outside of the domain and a joint still holds it to the
// world or to a solid that is not.
template <int Dim>
void refuse_leaving(const JointSet<Dim>& joints, const Domain<Dim>& domain, const State<Dim>& state);

// Throws Error(bad_input) with the line of the joint where that is so at the start.
template <int Dim>
void refuse_outside_at_start(const JointSet<Dim>& joints, const Domain<Dim>& domain, const State<Dim>& state);

}  // namespace seiche
