#pragma once
// Paths of transport that begin where the flow tells nothing: in air and beyond inflow sides.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The paths of one step that end at the faces near one fluid.
template <int Dim>
struct FacePaths {
  const FaceField<Dim>& velocity;  // m/s, ghosts filled
  const FaceField<Dim, char>& near;
  double dt;
};

// A value brought through air is a guess: continued straight on and carried back into the liquid step after step, it
// grows along a thin film without bound. Off the interior it keeps to the range of the valid faces where the path
// begins, or, where none is there, where it ends.
template <int Dim>
void limit_at_surfaces(const Domain<Dim>& domain, const TimeLevel<Dim>& level, const FacePaths<Dim>& paths,
                       const FaceField<Dim, char>& interior, FaceField<Dim>& u);

// u before the projection where liquid came in through a side during the step from t on: its velocity there, plus what
// the time since then has added. `memory` is the viscous one of transport.
template <int Dim>
void let_liquid_in(const Setup<Dim>& setup, const TimeLevel<Dim>& level, const FacePaths<Dim>& paths, double t,
                   const FaceField<Dim>& memory, FaceField<Dim>& u);

}  // namespace seiche
