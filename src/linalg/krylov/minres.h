#pragma once
// MINRES for symmetric indefinite systems. Operators and preconditioners as in linalg/krylov/krylov.h.
#include <cmath>

#include "linalg/krylov/krylov.h"

namespace seiche {

struct MinresStep {
  double of_z, of_w, of_w_before, length;
};

// Next direction w and a step along it.
inline void take_step(const MinresStep& s, const Vector& z, Vector& w_before, Vector& w, Vector& x) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double next = s.of_z * z[i] - s.of_w_before * w_before[i] - s.of_w * w[i];
    w_before[i] = w[i];
    w[i] = next;
    x[i] += s.length * next;
  }
}

// Preconditioned MINRES (Paige, Saunders 1975; Elman, Silvester, Wathen 2014, algorithm 4.1). A symmetric, B symmetric
// positive (semi-)definite. Stops when finished(|r|_B, x) returns true; |r|_B = sqrt(r'B r) never grows.
template <class Operator, class Preconditioner, class Finished>
KrylovResult minimal_residuals(const Operator& A, Preconditioner& B, const Vector& b, Vector& x, int iterations,
                               const Communicator& ranks, Finished&& finished) {
  const std::size_t n = b.size();
  Vector v_before(n, 0.0), v(n), z(n), w_before(n, 0.0), w(n, 0.0), az(n), next(n);
  A.residual(b, x, v);
  B.apply(v, z);
  double gamma_before = 1, gamma = dot(z, v, ranks), c_before = 1, c = 1, s_before = 0, s = 0;
  if (!(gamma >= 0)) return {0, "preconditioner not positive definite"};
  gamma = std::sqrt(gamma);
  double eta = gamma;
  for (int k = 0;; ++k) {
    if (finished(std::abs(eta), x)) return {k, ""};
    if (k == iterations) return {k, "iteration limit"};
    if (!(gamma > 0)) return {k, "the residual cannot be reduced further"};
    for (double& entry : z) entry /= gamma;
    A.multiply(z, az);
    const double delta = dot(az, z, ranks);
    for (std::size_t i = 0; i < n; ++i) az[i] -= delta / gamma * v[i] + gamma / gamma_before * v_before[i];
    B.apply(az, next);
    double gamma_next = dot(next, az, ranks);
    if (!std::isfinite(gamma_next)) return {k, "not finite"};
    // Round-off may make a zero slightly negative; the residual is then at its floor.
    if (gamma_next < -1e-10 * gamma * gamma) return {k, "preconditioner not positive definite"};
    gamma_next = std::sqrt(std::max(gamma_next, 0.0));
    const double a0 = c * delta - c_before * s * gamma, a1 = std::hypot(a0, gamma_next);
    const double a2 = s * delta + c_before * c * gamma, a3 = s_before * gamma;
    if (!(a1 > 0)) return {k, "matrix singular"};
    const double c_next = a0 / a1, s_next = gamma_next / a1;
    take_step({1 / a1, a2 / a1, a3 / a1, c_next * eta}, z, w_before, w, x);
    eta *= -s_next;
    std::swap(v_before, v);
    std::swap(v, az);
    std::swap(z, next);
    gamma_before = gamma;
    gamma = gamma_next;
    c_before = c, c = c_next, s_before = s, s = s_next;
  }
}

}  // namespace seiche
