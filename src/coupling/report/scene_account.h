#pragma once
// Account of a scene at its start: liquid, solids, and losses of both.
#include <string>
#include <vector>

#include "coupling/geometry/step_geometry.h"
#include "coupling/state/setup.h"
#include "coupling/state/start_account.h"
#include "coupling/state/state.h"

namespace seiche {

struct DomainSpec;

struct SceneAccount {
  StartAccount start;                 // `floating` of solids unset
  std::vector<std::string> warnings;  // regions without liquid, sources without room or effect, solids outside
};

// Account of the initial state. Collective; equal on all ranks.
template <int Dim>
SceneAccount account_scene(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                           const DomainSpec& extent, const State<Dim>& state, const StepGeometry<Dim>& geometry);

// Lines for the log: liquid, solids, others.
template <int Dim>
std::vector<std::string> lines_of(const StartAccount& start);

}  // namespace seiche
