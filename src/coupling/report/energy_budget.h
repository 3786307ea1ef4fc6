#pragma once
// Upper bound on the kinetic energy at the end of a step: initial, stored and supplied energy.
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Sources of kinetic energy in a step, |v|^2 = v'Mv = 2 E. A force f has the power f.v <= |M^-1 f| |v|, so |v| grows by
// at most |M^-1 f| T in a time T. Pressure only works on prescribed motion. For the volume rate b of that motion, the
// solve u = u* - dt/rho grad p has |u|^2 = u.u* + dt p.b, so |u| <= |u*| + sqrt(dt p.b).
struct EnergyBudget {
  double kinetic = 0;   // the larger one of the last two time levels, J
  double elastic = 0;   // at the start, J
  double surface = 0;   // 2 sigma times the area of the faces that the surface crosses, J
  double mass = 0;      // of fluids and bodies, kg
  double gain = 0;      // speed by gravity, m/s
  double given = 0;     // speed that sides, sources, prescribed bodies and pins may impart, m/s
  double momentum = 0;  // |M^-1 f| T of forces on elastic bodies, sqrt(J)
  double pushed = 0;    // dt p.b of sides and prescribed bodies, J
};

// Allowed growth of |v| by semi-Lagrangian transport, cut cells and forces carried on in time, as a factor.
constexpr double speed_margin = 2;

// E <= margin^2/2 (sqrt(2 (E_kin + E_el + E_surf)) + sqrt(M) (gain + given) + |M^-1 f| T + sqrt(dt p.b))^2, J.
double most_kinetic_energy(const EnergyBudget& budget);

// Budget of the attempt that started from `before`. `start`: measured of that state; psi (m): of its solids. Forces act
// for T = dt + horizon. Collective.
template <int Dim>
EnergyBudget energy_budget(const Setup<Dim>& setup, const State<Dim>& before, const StepStats& start,
                           const NodeField<Dim>& psi, const Attempt<Dim>& attempt);

// Message if the attempt's kinetic energy exceeds its budget, else empty. Collective.
template <int Dim>
std::string fault_of_energy(const Setup<Dim>& setup, const State<Dim>& before, const StepStats& start,
                            const NodeField<Dim>& psi, const Attempt<Dim>& attempt);

// Message if Work::lost_numerical falls in the attempt by more than E_kin + E_el of `start` and by more than
//   E_kin + E_el + sum |W| + m g h + 2 sigma A + m (1e-3 h/dt)^2/2.
// W: changes of the other members of Work. The last three terms are the uncertainty of a surface known to a cell. Else
// empty. Empty in the first four steps, too: a sudden start has no work of its own. Reads Attempt::state.work.
// Collective.
template <int Dim>
std::string fault_of_works(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                           const State<Dim>& before, const StepStats& start, const Attempt<Dim>& attempt);

}  // namespace seiche
