// Compressible neo-Hookean (Bonet, Wood 2008): Psi = mu/2 (|F|^2 - 3) - mu log J + lambda/2 log^2 J,
// infinite at J <= 0.
#include <cmath>
#include <limits>

#include "solid/material/invariants.h"
#include "solid/material/rows.h"

namespace seiche::elastic {
namespace {

template <int Dim>
double neo_hookean_energy(const Lame& m, const Gradient<Dim>& F) {
  const double j = volume_change<Dim>(F);
  if (!(j > -1)) return std::numeric_limits<double>::infinity();
  const double log_J = std::log1p(j);
  return m.mu * (stretch_excess<Dim>(F) / 2 - log_J) + m.lambda / 2 * log_J * log_J;
}

// P = mu F + (lambda log J - mu) / J dJ/dF
template <int Dim>
Gradient<Dim> neo_hookean_stress(const Lame& m, const Gradient<Dim>& F) {
  const double j = volume_change<Dim>(F);
  return m.mu * F + (m.lambda * std::log1p(j) - m.mu) / (1 + j) * cofactor<Dim>(F);
}

template <int Dim>
Hessian<Dim> neo_hookean_stiffness(const Lame& m, const Gradient<Dim>& F) {
  const double j = volume_change<Dim>(F), J = 1 + j, pull = m.lambda * std::log1p(j) - m.mu;
  const Flat<Dim> c = flat<Dim>(cofactor<Dim>(F));
  Hessian<Dim> H = pull / J * cofactor_derivative<Dim>(F) + (m.lambda - pull) / (J * J) * c * c.transpose();
  H.diagonal().array() += m.mu;
  return H;
}

}  // namespace

template <int Dim>
ElasticMaterial<Dim> neo_hookean() {
  return {"neo_hookean", neo_hookean_energy<Dim>, neo_hookean_stress<Dim>, neo_hookean_stiffness<Dim>};
}

template ElasticMaterial<2> neo_hookean<2>();
template ElasticMaterial<3> neo_hookean<3>();

}  // namespace seiche::elastic
