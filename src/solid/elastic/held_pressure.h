#pragma once
// Second-order part of the work against the liquid's pressure around an elastic body (follower-load stiffness).
#include "solid/material/invariants.h"

namespace seiche {

template <int Dim>
struct ElasticBody;

// The solve applies the pressure p on the surface at the start of a step (displacement u_n, F_0), but the body's stress
// at the end. Both have stiffness: p that of the enclosed volume, p d2V/du2, and the stress it causes the opposite.
// Evaluated at different times they add -dt p w'(d2V/du2) w per second to the energy, so a body whose bending stiffness
// is below p gains energy from its own motion. Hence the pressure follows the volume to the end of the step, too: each
// quadrature point gets the energy density
//   p (det F - det F_0 - cof F_0 : (F - F_0)),   p = min(most, -tr sigma(F_0)/Dim) >= 0.
// It vanishes with its slope at F_0. p is the stress that the outside can cause, at most its highest pressure. A body
// that closed liquid surrounds is given the liquid's pressure instead (coupling/solids/pressure_around).
template <int Dim>
struct HeldPressure {
  std::vector<double> pressure;      // Pa, one a quadrature point; empty: none
  std::vector<Gradient<Dim>> start;  // F_0

  bool acts(int point) const { return !pressure.empty() && pressure[std::size_t(point)] != 0; }
  double energy(int point, const Gradient<Dim>& F) const;           // J/m^3
  Gradient<Dim> stress(int point, const Gradient<Dim>& F) const;    // Pa
  Hessian<Dim> stiffness(int point, const Gradient<Dim>& F) const;  // Pa
};

// `most`: the highest pressure beside the body, Pa; if not positive, nothing is held.
template <int Dim>
HeldPressure<Dim> hold_pressure(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, double most);

// The pressure is given, Pa, one a quadrature point; it may be negative.
template <int Dim>
HeldPressure<Dim> hold_pressure(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, std::vector<double> pressure);

}  // namespace seiche
