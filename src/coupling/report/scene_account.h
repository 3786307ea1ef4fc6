#pragma once
// What a scene turned out to be at its start: liquid, solids, and what is lost of them.
#include <string>
#include <vector>

#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

struct SceneAccount {
  std::vector<std::string> lines;     // volume of liquid; mass, size and place of the solids
  std::vector<std::string> warnings;  // regions and solids of which nothing is left
};

// Of the initial state, psi the solids' distance at its nodes. Collective; equal on all ranks.
template <int Dim>
SceneAccount account_scene(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                           const DomainSpec& extent, const State<Dim>& state, const NodeField<Dim>& psi);

}  // namespace seiche
