#pragma once
// Hyperelastic materials: energy density as a function of the deformation gradient F, with first and second
// derivatives.
#include <span>
#include <string_view>

#include "base/vec.h"

namespace seiche {

template <int Dim>
using Gradient = Eigen::Matrix<double, Dim, Dim>;  // F_ij = dx_i / dX_j
template <int Dim>
using Hessian = Eigen::Matrix<double, Dim * Dim, Dim * Dim>;  // of F's entries column by column: index i + Dim j

struct Lame {
  double mu = 0, lambda = 0;  // Pa
};

// mu = E / (2 (1 + nu)), lambda = E nu / ((1 + nu)(1 - 2 nu)). Throws Error(bad_input) unless E > 0 and 0 <= nu < 1/2.
Lame lame_of(double youngs_modulus, double poisson_ratio);

// One material of the table. 2D is plane strain: F has a further entry F_33 = 1.
template <int Dim>
struct ElasticMaterial {
  std::string_view name;
  double (*energy)(const Lame&, const Gradient<Dim>& F);           // Psi, J/m^3; infinite where undefined
  Gradient<Dim> (*stress)(const Lame&, const Gradient<Dim>& F);    // P = dPsi/dF, first Piola-Kirchhoff, Pa
  Hessian<Dim> (*stiffness)(const Lame&, const Gradient<Dim>& F);  // d2Psi/dF2, Pa
};

template <int Dim>
std::span<const ElasticMaterial<Dim>> elastic_materials();

// Throws Error(bad_input) listing the names if there is no such material.
template <int Dim>
const ElasticMaterial<Dim>& elastic_material(std::string_view name);

// Nearest symmetric positive semi-definite matrix in the Frobenius norm: negative eigenvalues become zero.
template <int Dim>
Hessian<Dim> project_positive(const Hessian<Dim>& H);

}  // namespace seiche
