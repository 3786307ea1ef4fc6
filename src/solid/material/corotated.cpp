// Corotated linear elasticity (Mueller, Gross 2004): Psi = mu |F - R|^2 + lambda/2 (R:F - Dim)^2, R the rotation of
// F = R S. Derivatives of R: Smith, de Goes, Kim 2019 (analytic eigensystems).
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <vector>

#include "solid/material/invariants.h"
#include "solid/material/rows.h"

namespace seiche::elastic {
namespace {

// F = U diag(s) V', U and V rotations: the last of s is negative if det F is.
template <int Dim>
struct Rotations {
  Gradient<Dim> U, V;
  Vec<Dim> s;
};

template <int Dim>
Rotations<Dim> decompose(const Gradient<Dim>& F) {
  const Eigen::JacobiSVD<Gradient<Dim>> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Rotations<Dim> r{svd.matrixU(), svd.matrixV(), svd.singularValues()};
  for (Gradient<Dim>* Q : {&r.U, &r.V}) {
    if (Q->determinant() > 0) continue;
    Q->col(Dim - 1) *= -1;
    r.s[Dim - 1] *= -1;
  }
  return r;
}

// dR/dF = sum over the planes i, j of 2 / (s_i + s_j) q q', q = U (e_i e_j' - e_j e_i') V' / sqrt 2.
template <int Dim>
Hessian<Dim> rotation_derivative(const Rotations<Dim>& r) {
  Hessian<Dim> H = Hessian<Dim>::Zero();
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < i; ++j) {
      const Gradient<Dim> turn = r.U.col(i) * r.V.col(j).transpose() - r.U.col(j) * r.V.col(i).transpose();
      const Flat<Dim> q = flat<Dim>(turn);
      H += 1 / (r.s[i] + r.s[j]) * q * q.transpose();
    }
  }
  return H;
}

template <int Dim>
double energy(const Lame& m, const Gradient<Dim>& F) {
  const Vec<Dim> strain = decompose<Dim>(F).s.array() - 1;
  return m.mu * strain.squaredNorm() + m.lambda / 2 * strain.sum() * strain.sum();
}

template <int Dim>
Gradient<Dim> stress(const Lame& m, const Gradient<Dim>& F) {
  const auto r = decompose<Dim>(F);
  const Gradient<Dim> R = r.U * r.V.transpose();
  return 2 * m.mu * (F - R) + m.lambda * (r.s.array() - 1).sum() * R;
}

template <int Dim>
Hessian<Dim> stiffness(const Lame& m, const Gradient<Dim>& F) {
  const auto r = decompose<Dim>(F);
  const Flat<Dim> R = flat<Dim>(r.U * r.V.transpose());
  Hessian<Dim> H = (m.lambda * (r.s.array() - 1).sum() - 2 * m.mu) * rotation_derivative<Dim>(r);
  H.diagonal().array() += 2 * m.mu;
  return H + m.lambda * R * R.transpose();
}

}  // namespace

template <int Dim>
ElasticMaterial<Dim> corotated() {
  return {"corotated", energy<Dim>, stress<Dim>, stiffness<Dim>};
}

template ElasticMaterial<2> corotated<2>();
template ElasticMaterial<3> corotated<3>();

}  // namespace seiche::elastic
