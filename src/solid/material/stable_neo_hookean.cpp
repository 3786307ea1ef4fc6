// Stable neo-Hookean flesh (Smith, de Goes, Kim 2018), with their mu' = 4/3 mu and lambda' = lambda + 5/6 mu:
// Psi = mu'/2 (|F|^2 - 3) + lambda'/2 (J - a)^2 - mu'/2 log(|F|^2 + 1), a = 1 + 3/4 mu'/lambda', less its value at
// rest.
#include <cmath>

#include "solid/material/invariants.h"
#include "solid/material/rows.h"

namespace seiche::elastic {
namespace {

Lame primed(const Lame& m) {
  return {4 * m.mu / 3, m.lambda + 5 * m.mu / 6};
}

// With I = |F|^2 - 3 and j = J - 1: mu'/2 (I - log(1 + I/4)) - 3/4 mu' j + lambda'/2 j^2.
template <int Dim>
double stable_energy(const Lame& material, const Gradient<Dim>& F) {
  const auto [mu, lambda] = primed(material);
  const double I = stretch_excess<Dim>(F), j = volume_change<Dim>(F);
  return mu / 2 * (I - std::log1p(I / 4)) - 0.75 * mu * j + lambda / 2 * j * j;
}

template <int Dim>
Gradient<Dim> stable_stress(const Lame& material, const Gradient<Dim>& F) {
  const auto [mu, lambda] = primed(material);
  const double I = stretch_excess<Dim>(F), j = volume_change<Dim>(F);
  return mu * (1 - 1 / (I + 4)) * F + (lambda * j - 0.75 * mu) * cofactor<Dim>(F);
}

template <int Dim>
Hessian<Dim> stable_stiffness(const Lame& material, const Gradient<Dim>& F) {
  const auto [mu, lambda] = primed(material);
  const double I = stretch_excess<Dim>(F), j = volume_change<Dim>(F);
  const Flat<Dim> f = flat<Dim>(F), c = flat<Dim>(cofactor<Dim>(F));
  Hessian<Dim> H = (lambda * j - 0.75 * mu) * cofactor_derivative<Dim>(F);
  H.diagonal().array() += mu * (1 - 1 / (I + 4));
  return H + 2 * mu / ((I + 4) * (I + 4)) * f * f.transpose() + lambda * c * c.transpose();
}

}  // namespace

template <int Dim>
ElasticMaterial<Dim> stable_neo_hookean() {
  return {"stable_neo_hookean", stable_energy<Dim>, stable_stress<Dim>, stable_stiffness<Dim>};
}

template ElasticMaterial<2> stable_neo_hookean<2>();
template ElasticMaterial<3> stable_neo_hookean<3>();

}  // namespace seiche::elastic
