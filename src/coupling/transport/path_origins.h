#pragma once
// Transport paths that begin outside the known flow: in air and beyond inflow sides.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct TimeSpec;

// Paths of one step (dt, s) that end at the faces `near` one fluid.
template <int Dim>
struct FacePaths {
  const FaceField<Dim>& velocity;  // m/s, ghosts filled
  const FaceField<Dim, char>& near;
  double dt;
};

// Limits u (m/s) on faces off the interior to the range of the valid faces where their path begins. If none is valid
// there, the range is that where it ends. Values that come through air are extrapolated. Extrapolated and transported
// back into the liquid step after step, they would grow without bound along thin films.
template <int Dim>
void limit_at_surfaces(const Domain<Dim>& domain, const TimeLevel<Dim>& level, const FacePaths<Dim>& paths,
                       const FaceField<Dim, char>& interior, FaceField<Dim>& u);

// Sets u* on faces whose path entered through an inflow side during the step from t (s), so that the solve leads to
// u_in + tau A: the inflow velocity u_in plus the acceleration A over the time tau since the entry,
//   u* = u_in + dt g - (dt - tau) A + memory.
// `memory`: viscous_memory() of transport.cpp, m/s.
template <int Dim>
void let_liquid_in(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                   const OperatorPerturbation& perturbation, const TimeLevel<Dim>& level, const FacePaths<Dim>& paths,
                   double t, const FaceField<Dim>& memory, FaceField<Dim>& u);

}  // namespace seiche
