#pragma once
// Restitution of rigid solids by Poisson's hypothesis. Contact brings solids that meet to rest against each other; the
// impulses with which it did so are kept, and those times the coefficient act once more in the next solve:
//   v+ = v_c + e M^-1 N lambda,   v_c = v- + M^-1 N lambda,
// with M the inertia of solids and liquid. Both momenta are kept. Energy: E(v+) = E(v_c) + e^2 (E(v-) - E(v_c)), as v_c
// minimises E over v- + M^-1 N lambda.
#include "coupling/state/interaction.h"
#include "coupling/state/setup.h"

namespace seiche {

// Impacts under way after a solve that led from `before` to `after`. `pairs`: impulses of contact in it, over the step
// of dt (s) that led to `after`.
template <int Dim>
Impacts impacts_after(const Setup<Dim>& setup, const State<Dim>& before, const State<Dim>& after,
                      const std::vector<PairImpulse>& pairs, double dt);

// Adds the rebounds that are due.
template <int Dim>
std::unique_ptr<const Interaction<Dim>> make_rebounds();

}  // namespace seiche
