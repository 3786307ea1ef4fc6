// St. Venant-Kirchhoff: Psi = mu E:E + lambda/2 tr^2 E with Green's strain E = (F'F - 1)/2.
#include "solid/material/invariants.h"
#include "solid/material/rows.h"

namespace seiche::elastic {
namespace {

// E = (D + D' + D'D)/2 with D = F - 1
template <int Dim>
Gradient<Dim> green_strain(const Gradient<Dim>& F) {
  const Gradient<Dim> D = F - Gradient<Dim>::Identity();
  return (D + D.transpose() + D.transpose() * D) / 2;
}

// S = 2 mu E + lambda tr E
template <int Dim>
Gradient<Dim> second_stress(const Lame& m, const Gradient<Dim>& E) {
  return 2 * m.mu * E + m.lambda * E.trace() * Gradient<Dim>::Identity();
}

template <int Dim>
double svk_energy(const Lame& m, const Gradient<Dim>& F) {
  const Gradient<Dim> E = green_strain<Dim>(F);
  return m.mu * E.squaredNorm() + m.lambda / 2 * E.trace() * E.trace();
}

// P = F S
template <int Dim>
Gradient<Dim> svk_stress(const Lame& m, const Gradient<Dim>& F) {
  return F * second_stress<Dim>(m, green_strain<Dim>(F));
}

// dP = dF S + F S(dE), dE = sym(F' dF), one column for each entry of dF
template <int Dim>
Hessian<Dim> svk_stiffness(const Lame& m, const Gradient<Dim>& F) {
  const Gradient<Dim> S = second_stress<Dim>(m, green_strain<Dim>(F));
  Hessian<Dim> H;
  for (int k = 0; k < Dim * Dim; ++k) {
    Gradient<Dim> dF = Gradient<Dim>::Zero();
    dF(k % Dim, k / Dim) = 1;
    const Gradient<Dim> dE = (F.transpose() * dF + dF.transpose() * F) / 2;
    H.col(k) = flat<Dim>(dF * S + F * second_stress<Dim>(m, dE));
  }
  return H;
}

}  // namespace

template <int Dim>
ElasticMaterial<Dim> st_venant_kirchhoff() {
  return {"st_venant_kirchhoff", svk_energy<Dim>, svk_stress<Dim>, svk_stiffness<Dim>};
}

template ElasticMaterial<2> st_venant_kirchhoff<2>();
template ElasticMaterial<3> st_venant_kirchhoff<3>();

}  // namespace seiche::elastic
