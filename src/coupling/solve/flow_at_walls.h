#pragma once
// Flow that the fluxes of cut no-slip faces are taken from (fluid/viscosity/no_slip_flux). The flow at the start of the
// step serves, unless viscosity stops it within the step. The step is then solved again.
#include <memory>

#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Velocities of the fluids, and rigid (or mean) motions of the solids.
template <int Dim>
struct FlowAtWalls {
  std::shared_ptr<const TimeLevel<Dim>> flow;
  std::vector<RigidField> motion;  // one a solid
};

template <int Dim>
std::vector<RigidField> motions_at_walls(const Participants<Dim>& solids, const StepGeometry<Dim>& geometry);

template <int Dim>
class FlowAtWallsIteration {
 public:
  // Starts with the flow of `before`, the start of the step, and `solids`, which the solves start with. Keeps
  // references to setup and geometry.
  FlowAtWallsIteration(const Setup<Dim>& setup, const State<Dim>& before, const Participants<Dim>& solids,
                       const StepGeometry<Dim>& geometry);
  // The last solve's flow if another solve is due, else none. The criterion sums over faces beside cut ones: the change
  // of the velocities relative to the solids, and their size after the solve. The first repetition is due if the change
  // exceeds the size, a later one if it exceeds a tenth of it. At most eight; none without viscosity or without no-slip
  // solids. Collective.
  std::optional<FlowAtWalls<Dim>> due_after(const State<Dim>& solved);

 private:
  bool is_beside_cut_wall(int axis, Site f) const;

  const Setup<Dim>& setup_;
  const StepGeometry<Dim>& geometry_;
  FlowAtWalls<Dim> last_;  // without a flow: never due
  int solves_ = 0;         // that were due
};

}  // namespace seiche
