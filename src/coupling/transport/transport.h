#pragma once
// Transport: the surface along the flow, the velocity along its path with the acceleration it felt.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/transport/viscous_transport.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// phi, the surface at time t, at t + dt: transported by u, joined by inflow and sources. The state tells where solids
// are. Returns the volume that sources brought, m^Dim.
template <int Dim>
double transport_surface(const Setup<Dim>& setup, const State<Dim>& state, const FaceField<Dim>& u, double t, double dt,
                         CellField<Dim>& phi);

// Makes phi a distance again, after it has crossed at most ceil(cfl) + 1 cells (coupling/level_in_solids.h).
template <int Dim>
void make_distance(const Setup<Dim>& setup, const CellField<Dim, char>& closed, CellField<Dim>& phi);

// Cells from the surface that are taken to their distance from it by its nearest points (levelset/redistance.h).
// Curvature reads them, and where two fluids flow nothing tells their volumes apart but the surface.
double closest_point_band(const Fluids& fluids);

// u before the projection on all faces next to liquid: transported velocity plus dt f plus dt/2 (A(x_d) - A(x)), A = f
// - q. Where gas flows, each fluid is brought by its own flow, continued beyond the surface, so that neither takes up
// the other's velocity by interpolation; where the surface crosses, their momenta add up. `geometry` is that of the
// end of the step.
template <int Dim>
FaceField<Dim> transport_velocity(const Setup<Dim>& setup, const State<Dim>& state, const CellField<Dim>& phi,
                                  double dt, const ViscousPlan& plan, const StepGeometry<Dim>& geometry);

// 1 on the owned faces with liquid (phi < 0) on at least one side.
template <int Dim>
FaceField<Dim, char> faces_near_liquid(const Domain<Dim>& domain, const CellField<Dim>& phi);

// 1 on the owned faces with none on at least one side.
template <int Dim>
FaceField<Dim, char> faces_near_gas(const Domain<Dim>& domain, const CellField<Dim>& phi);

// Shifts phi so that the liquid has the expected volume, by at most `limit` (m). Returns the volume restored.
template <int Dim>
double control_volume(const Domain<Dim>& domain, const NodeField<Dim>& psi, double expected, double limit,
                      CellField<Dim>& phi);

// Liquid volume over all ranks, m^Dim.
template <int Dim>
double liquid_volume(const Domain<Dim>& domain, const CellField<Dim>& phi, const NodeField<Dim>& psi);

}  // namespace seiche
