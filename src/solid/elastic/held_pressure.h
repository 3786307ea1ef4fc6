#pragma once
// The second-order part of the work against the liquid's pressure around an elastic body.
#include "solid/material/invariants.h"

namespace seiche {

template <int Dim>
struct ElasticBody;

// The solve lets the pressure p act on the surface as it is at the start of a step (displacement u_n, F_0) and the
// stress on the body as it is at the end. Both have stiffness: p that of the enclosed volume, p d2V/du2, the stress
// that it causes the opposite. Taken at different times they add -dt p w'(d2V/du2) w a second to the energy: a body
// whose stiffness against bending is below p then gains energy from its own motion. So the pressure follows the volume
// to the end of the step, too. At each quadrature point the body has the energy density
//   p (det F - det F_0 - cof F_0 : (F - F_0)),   p = min(most, -tr sigma(F_0)/Dim) >= 0,
// zero with its slope at F_0; p is the stress that the outside may cause, at most its highest pressure.
template <int Dim>
struct HeldPressure {
  std::vector<double> pressure;      // Pa, of each quadrature point; empty: none
  std::vector<Gradient<Dim>> start;  // F_0

  bool acts(int point) const { return !pressure.empty() && pressure[std::size_t(point)] > 0; }
  double energy(int point, const Gradient<Dim>& F) const;           // J/m^3
  Gradient<Dim> stress(int point, const Gradient<Dim>& F) const;    // Pa
  Hessian<Dim> stiffness(int point, const Gradient<Dim>& F) const;  // Pa
};

// `most`: the highest pressure beside the body, Pa; none where it is not above zero.
template <int Dim>
HeldPressure<Dim> hold_pressure(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, double most);

}  // namespace seiche
