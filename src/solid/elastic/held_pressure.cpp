#include "solid/elastic/held_pressure.h"

#include <algorithm>

#include "solid/elastic/body.h"

namespace seiche {

// det(F_0 + D) without its linear part in D: det D in 2D, cof D : F_0 + det D in 3D.
template <int Dim>
double HeldPressure<Dim>::energy(int point, const Gradient<Dim>& F) const {
  const Gradient<Dim>& F0 = start[std::size_t(point)];
  const Gradient<Dim> D = F - F0;
  double rest = D.determinant();
  if constexpr (Dim == 3) rest += elastic::cofactor<Dim>(D).cwiseProduct(F0).sum();
  return pressure[std::size_t(point)] * rest;
}

template <int Dim>
Gradient<Dim> HeldPressure<Dim>::stress(int point, const Gradient<Dim>& F) const {
  return pressure[std::size_t(point)] * (elastic::cofactor<Dim>(F) - elastic::cofactor<Dim>(start[std::size_t(point)]));
}

template <int Dim>
Hessian<Dim> HeldPressure<Dim>::stiffness(int point, const Gradient<Dim>& F) const {
  return pressure[std::size_t(point)] * elastic::cofactor_derivative<Dim>(F);
}

template <int Dim>
HeldPressure<Dim> hold_pressure(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, double most) {
  HeldPressure<Dim> held;
  if (!(most > 0)) return held;
  for (std::size_t q = 0; q < body.weights.size(); ++q) {
    const Gradient<Dim> F = deformation_at(body, int(q), u);
    // sigma = P F'/J
    const double trace = body.material.stress(body.properties.lame, F).cwiseProduct(F).sum() / F.determinant();
    held.pressure.push_back(std::clamp(-trace / Dim, 0.0, most));
    held.start.push_back(F);
  }
  return held;
}

template <int Dim>
HeldPressure<Dim> hold_pressure(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, std::vector<double> pressure) {
  HeldPressure<Dim> held;
  held.pressure = std::move(pressure);
  for (std::size_t q = 0; q < held.pressure.size(); ++q) held.start.push_back(deformation_at(body, int(q), u));
  return held;
}

#define SEICHE_INSTANTIATE(D)                                                                       \
  template struct HeldPressure<D>;                                                                  \
  template HeldPressure<D> hold_pressure<D>(const ElasticBody<D>&, const Eigen::VectorXd&, double); \
  template HeldPressure<D> hold_pressure<D>(const ElasticBody<D>&, const Eigen::VectorXd&, std::vector<double>);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
