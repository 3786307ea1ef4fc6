#pragma once
// Viscosity in the solve of a step: split or coupled.
#include "coupling/solve/solve_parts.h"
#include "coupling/solve/viscous_coupling.h"

namespace seiche {

// Split: viscosity first, with the pressure of the last step:
//   F u + G v = f,   G'u + (M + H_vv) v = push + dt A_f J'p + g,
// with u* - dt grad p/rho for u* in f = M u* + ... (ViscousSystem). M of the second equation: the bodies' mass. Keeps
// references.
template <int Dim>
class SplitViscosity {
 public:
  SplitViscosity(const CoupledInput<Dim>& input, const SolidCoupling<Dim>& coupling, const CoupledSolution<Dim>& r);
  SplitViscosity(const SplitViscosity&) = delete;
  SplitViscosity& operator=(const SplitViscosity&) = delete;

  // Adds the effect of viscosity to r.u_star and coupling.push; the solve for pressure follows.
  void act(const PressureProblem<Dim>& liquid, SolidCoupling<Dim>& coupling, CoupledSolution<Dim>& r);
  // Sets r.viscous: the power of the stress that acted on the velocities that the solve for pressure found. Collective.
  void measure(CoupledSolution<Dim>& r) const;

 private:
  const CoupledInput<Dim>& in_;
  FaceGeometry<Dim> faces_;  // side pressures are part of the slope
  ProjectionInput<Dim> unpressed_;
  FaceField<Dim> pressed_;  // u* - dt grad p/rho, m/s
  ViscousStep<Dim> viscous_;
  // Velocities of the bodies' unknowns: those that the stress belongs to, and those before the step.
  Eigen::VectorXd solids_, solids_before_;
};

// Coupled: pressure, viscosity and bodies in one solve.
template <int Dim>
void solve_with_viscosity(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                          SolidCoupling<Dim>& coupling, CoupledSolution<Dim>& r);

}  // namespace seiche
