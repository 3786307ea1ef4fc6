#pragma once
// Shared by the materials: invariants of F without cancellation at small strain, and derivatives of det F.
#include <Eigen/Dense>

#include "solid/material/material.h"

namespace seiche::elastic {

template <int Dim>
using Flat = Eigen::Matrix<double, Dim * Dim, 1>;

template <int Dim>
Flat<Dim> flat(const Gradient<Dim>& F) {
  return Eigen::Map<const Flat<Dim>>(F.data());
}

// J - 1 with D = F - 1: tr D + (tr^2 D - tr D^2)/2 + det D (the last in 3D).
template <int Dim>
double volume_change(const Gradient<Dim>& F) {
  const Gradient<Dim> D = F - Gradient<Dim>::Identity();
  if constexpr (Dim == 2) return D.trace() + D.determinant();
  const double trace = D.trace();
  return trace + (trace * trace - (D * D).trace()) / 2 + D.determinant();
}

// |F|^2 - 3 with D = F - 1: 2 tr D + |D|^2.
template <int Dim>
double stretch_excess(const Gradient<Dim>& F) {
  const Gradient<Dim> D = F - Gradient<Dim>::Identity();
  return 2 * D.trace() + D.squaredNorm();
}

// dJ/dF
template <int Dim>
Gradient<Dim> cofactor(const Gradient<Dim>& F) {
  Gradient<Dim> C;
  if constexpr (Dim == 2) {
    C << F(1, 1), -F(1, 0), -F(0, 1), F(0, 0);
  } else {
    for (int j = 0; j < 3; ++j) C.col(j) = F.col((j + 1) % 3).cross(F.col((j + 2) % 3));
  }
  return C;
}

// d2J/dF2: minus the matrix of the cross product with F's third column between the other two; that column is e_3 in 2D.
template <int Dim>
Hessian<Dim> cofactor_derivative(const Gradient<Dim>& F) {
  Hessian<Dim> H = Hessian<Dim>::Zero();
  if constexpr (Dim == 2) {
    H(0, 3) = H(3, 0) = 1;
    H(1, 2) = H(2, 1) = -1;
  } else {
    for (int j = 0; j < 3; ++j) {
      const Vec3 f = F.col((j + 2) % 3);
      Eigen::Matrix3d cross;
      cross << 0, -f[2], f[1], f[2], 0, -f[0], -f[1], f[0], 0;
      const int next = (j + 1) % 3;
      H.template block<3, 3>(3 * j, 3 * next) = -cross;
      H.template block<3, 3>(3 * next, 3 * j) = cross;
    }
  }
  return H;
}

}  // namespace seiche::elastic
