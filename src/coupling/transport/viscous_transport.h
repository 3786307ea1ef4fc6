#pragma once
// Transport in viscous liquid that fills the domain: fourth order between walls.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "fluid/viscosity/wall_layer.h"

namespace seiche {

struct TimeSpec;

// Treatment of viscous liquid in the coming step.
struct ViscousPlan {
  // True if liquid fills the domain; only then transport is of fourth order. Beside surfaces the order is two anyway.
  // With fourth order, coarse flow with a surface (32 cells, cell Reynolds number 3000) gained up to 0.3 % kinetic
  // energy in single steps.
  bool full = false;
  // Share of the viscous stress that is taken at the end of the step. With 9/16, 3/8 at the start and 1/16 a step
  // earlier, the error in time is a quarter of that of 1 with a trend. Bodies would not feel the explicit shares. With
  // the explicit terms of fourth order, stability ends at mu dt/(rho h^2) of about 1. So 9/16 is used only in full
  // domains without bodies, up to 1/2.
  double implicit = 1;
  // Time from the places of solids that the flow fits to those of the solve, s.
  double way = 0;
};

// `phi` (m): of the solve. Collective.
template <int Dim>
ViscousPlan plan_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                           const Features& features, const State<Dim>& state, const CellField<Dim>& phi, double dt);

// True if any cell holds no liquid. Collective.
template <int Dim>
bool has_surface(const Domain<Dim>& domain, const CellField<Dim>& phi);

// The valid faces that no solid cuts. Halo filled. Collective.
template <int Dim>
FaceField<Dim, char> uncut_faces(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry,
                                 const FaceField<Dim, char>& valid);

// Velocities (m/s) at face centres from face means u, on the `whole` faces; others keep u. `t` (s): time of the
// velocities of walls and inflow. Ghosts filled. Collective.
template <int Dim>
FaceField<Dim> points_of_means(const Domain<Dim>& domain, const FaceField<Dim, char>& whole, const FaceField<Dim>& u,
                               double t);

// u += dt nu times the part of the Laplacian that the viscous operator lacks to fourth order, on the `whole` faces.
// `now`: velocities at the start of the step, extrapolated beyond walls. Does nothing if viscosity varies. Returns its
// power, W. Collective.
template <int Dim>
double add_missing_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                             const FaceField<Dim, char>& whole, const FaceField<Dim>& now, double dt,
                             FaceField<Dim>& u);

}  // namespace seiche
