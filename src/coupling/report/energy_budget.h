#pragma once
// The most kinetic energy that a step can end with: what was there, was stored, and was put in.
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Sources of kinetic energy in a step of a mass M. |v|^2 = v'Mv = 2 E. A force f has the power f.v <= |M^-1 f| |v|, so
// |v| grows by |M^-1 f| dt at most, whatever the flow. Pressure does work on given motion alone: the solve u = u* -
// dt/rho grad p with the volume rate b pushed in has |u|^2 = u.u* + dt p.b, so |u| <= |u*| + sqrt(dt p.b).
struct EnergyBudget {
  double kinetic = 0;   // the larger one of the last two time levels, J
  double elastic = 0;   // at the start, J
  double surface = 0;   // sigma times the area of the surface, J
  double mass = 0;      // of fluids and bodies, kg
  double gain = 0;      // of speed by gravity, m/s
  double given = 0;     // speed that sides, sources, prescribed bodies and pins may impart, m/s
  double momentum = 0;  // |M^-1 f| dt of forces on elastic bodies, sqrt(J)
  double pushed = 0;    // dt p.b of what sides and prescribed bodies push, J
};

// Growth of |v| that semi-Lagrangian transport, cut cells and forces carried on in time are allowed, as a factor.
constexpr double speed_margin = 2;

// E <= margin^2/2 (sqrt(2 (E_kin + E_el + E_surf)) + sqrt(M) (gain + given) + |M^-1 f| dt + sqrt(dt p.b))^2, J.
double most_kinetic_energy(const EnergyBudget& budget);

// Budget of the attempt that led from the state `before`. `start` was measured of that state, psi (m) is that of its
// solids. Collective.
template <int Dim>
EnergyBudget energy_budget(const Setup<Dim>& setup, const State<Dim>& before, const StepStats& start,
                           const NodeField<Dim>& psi, const Attempt<Dim>& attempt);

// Empty, or by how much the attempt's kinetic energy is more than the step can have given. Collective.
template <int Dim>
std::string fault_of_energy(const Setup<Dim>& setup, const State<Dim>& before, const StepStats& start,
                            const NodeField<Dim>& psi, const Attempt<Dim>& attempt);

}  // namespace seiche
