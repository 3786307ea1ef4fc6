#pragma once
// What transport knows of viscous liquid that fills the domain: fourth order between walls, and flow that goes on into
// solids that it sticks to.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "fluid/viscosity/wall_layer.h"

namespace seiche {

// How the coming step takes viscous liquid along.
struct ViscousPlan {
  // Whether it fills the domain: only then to fourth order. Beside surfaces the order is two anyway, and in coarse flow
  // with one (32 cells, Reynolds number of a cell 3000) kinetic energy rose in single steps by up to 0.3 %.
  bool full = false;
  // How much of the viscous stress of the step is that of its end. With 9/16, 3/8 at its start and 1/16 a step before
  // the error in time is a quarter of that of 1 and a trend. Bodies would not feel the shares before, and with the
  // explicit terms of fourth order it is stable only up to mu dt/(rho h^2) of about 1: full domains without bodies, up
  // to 1/2.
  double implicit = 1;
};

// phi that of the end of the step. Collective.
template <int Dim>
ViscousPlan plan_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                           const Features& features, const State<Dim>& state, const CellField<Dim>& phi, double dt);

// Whether any cell holds no liquid. Collective.
template <int Dim>
bool has_surface(const Domain<Dim>& domain, const CellField<Dim>& phi);

// Whether liquid sticks to solids that are static or move as prescribed.
template <int Dim>
bool sticks_to_known_solids(const Fluids& fluids, const Solids<Dim>& solids);

// The valid faces and those that such solids close: velocity passes through the solid's at its surface there, so that
// transport needs no other order beside it. Halo filled.
template <int Dim>
FaceField<Dim, char> faces_known_to_transport(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                              const StepGeometry<Dim>& geometry, const FaceField<Dim, char>& valid);

// The valid faces that no solid cuts. Halo filled.
template <int Dim>
FaceField<Dim, char> uncut_faces(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry,
                                 const FaceField<Dim, char>& valid);

// Continues f from the valid faces into the others, straight for two layers. Ghosts are filled.
template <int Dim>
void continue_into_solids(const Domain<Dim>& domain, const FaceField<Dim, char>& valid, FaceField<Dim>& f);

// Velocities at face centres from means over the faces, on whole faces; all with ghosts filled.
template <int Dim>
FaceField<Dim> points_of_means(const Domain<Dim>& domain, const FaceField<Dim, char>& whole, const FaceField<Dim>& u,
                               double t);

// u += dt nu times what the viscous operator lacks to fourth order, of the velocities `now` at the start of the step
// continued beyond walls, where nu is the same everywhere.
template <int Dim>
void add_missing_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                           const FaceField<Dim, char>& whole, const FaceField<Dim>& now, double dt, FaceField<Dim>& u);

}  // namespace seiche
