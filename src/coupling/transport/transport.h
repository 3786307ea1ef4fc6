#pragma once
// Semi-Lagrangian transport: the surface along the flow, the velocity along its path with the acceleration it felt.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/transport/placed_sources.h"
#include "coupling/transport/sources.h"
#include "coupling/transport/viscous_transport.h"
#include "fluid/boundary/domain.h"
#include "fluid/viscosity/load_sums.h"

namespace seiche {

struct TimeSpec;

// Transports phi from time t to t + dt (s) with the velocity `path` (m/s). Joins it with inflow and sources. `state`
// gives the positions of the solids, `closed` the cells of closed_cells(). `sources`: at the end. Returns what they
// brought. Throws as check_forces_of_step() does. Fills ghosts. Collective.
template <int Dim>
Brought<Dim> transport_surface(const Setup<Dim>& setup, const State<Dim>& state, FaceField<Dim> path, double t,
                               double dt, const PlacedSources<Dim>& sources, const CellField<Dim, char>& closed,
                               CellField<Dim>& phi);

// Makes phi a distance again, after it has crossed at most ceil(cfl) + 1 cells. `closed`: see
// redistance_beside_solids(). Collective.
template <int Dim>
void make_distance(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const TimeSpec& time,
                   const CellField<Dim, char>& closed, CellField<Dim>& phi);

// Distance from the surface (cells) within which redistancing takes the nearest point of the surface
// (RedistanceOptions::closest_point_cells). Not 0 with surface tension, whose curvature reads these cells, and with
// gas, where only the surface separates the volumes. Also in prescribed flows.
double closest_point_band(const Fluids& fluids);

// Velocity before the projection (m/s, ghosts filled), and the acceleration that each fluid carried along its paths
// (m/s^2). gas_acceleration: empty without gas, and where both fluids move as one.
template <int Dim>
struct Transported {
  FaceField<Dim> u, acceleration, gas_acceleration;
  double viscous_power = 0;               // of viscosity of fourth order beyond the viscous operator, W
  FaceField<Dim> through_walls{};         // velocity before the step, continued through walls; empty: no such walls
  KnownLoads wall_loads{};                // wall_viscosity.h
  std::vector<FaceImpulse> by_sources{};  // on what was where sources set the velocity
};

// u before the projection on all faces next to liquid: the transported velocity plus
//   dt f + dt/2 (A(x_d) - A(x)) on interior faces,   A = f - G of carried_acceleration(),
// and dt f on others.
// The exterior adds its own flow (Exterior::transported_velocity). `phi` and `geometry` are those of the solve.
// `sources`: at the solve. `brought`: share of each cell that they have brought since `state`; null: none. Collective.
template <int Dim>
Transported<Dim> transport_velocity(const Setup<Dim>& setup, const State<Dim>& state, const CellField<Dim>& phi,
                                    double dt, const ViscousPlan& plan, const StepGeometry<Dim>& geometry,
                                    const PlacedSources<Dim>& sources, const CellField<Dim>* brought = nullptr);

// The same for one fluid with the levels `flow`, on the faces `near` it, without sources. Sets `acceleration` to its
// own. Collective.
template <int Dim>
Transported<Dim> transport_flow(const Setup<Dim>& setup, const State<Dim>& state, const Flow<Dim>& flow,
                                const FaceField<Dim, char>& near, double dt, const ViscousPlan& plan,
                                const StepGeometry<Dim>& geometry);

// 1 on the owned faces with liquid (phi < 0) on at least one side.
template <int Dim>
FaceField<Dim, char> faces_near_liquid(const Domain<Dim>& domain, const CellField<Dim>& phi);

// 1 on the owned faces with a cell without liquid (phi >= 0) on at least one side.
template <int Dim>
FaceField<Dim, char> faces_near_gas(const Domain<Dim>& domain, const CellField<Dim>& phi);

// Shifts phi so that the liquid has the expected volume (m^Dim), by at most `limit` (m). Returns the volume restored,
// m^Dim. Fills ghosts. Collective.
template <int Dim>
double control_volume(const Domain<Dim>& domain, const NodeField<Dim>& psi, double expected, double limit,
                      CellField<Dim>& phi);

// Liquid volume over all ranks, m^Dim. Collective.
template <int Dim>
double liquid_volume(const Domain<Dim>& domain, const CellField<Dim>& phi, const NodeField<Dim>& psi);

}  // namespace seiche
