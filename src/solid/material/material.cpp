#include "solid/material/material.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <string>

#include "base/error.h"
#include "solid/material/rows.h"

namespace seiche {

Lame lame_of(double youngs_modulus, double poisson_ratio) {
  const double E = youngs_modulus, nu = poisson_ratio;
  if (!(E > 0)) throw Error(ExitCode::bad_input, "Young's modulus is " + std::to_string(E) + "; must be above 0");
  if (!(nu >= 0 && nu < 0.5)) {
    throw Error(ExitCode::bad_input, "Poisson's ratio is " + std::to_string(nu) + "; must be at least 0 and below 0.5");
  }
  return {E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))};
}

template <int Dim>
std::span<const ElasticMaterial<Dim>> elastic_materials() {
  static const std::array rows{elastic::stable_neo_hookean<Dim>(), elastic::neo_hookean<Dim>(),
                               elastic::corotated<Dim>(), elastic::st_venant_kirchhoff<Dim>()};
  return rows;
}

template <int Dim>
const ElasticMaterial<Dim>& elastic_material(std::string_view name) {
  std::string names;
  for (const auto& row : elastic_materials<Dim>()) {
    if (row.name == name) return row;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  throw Error(ExitCode::bad_input, "no material \"" + std::string(name) + "\"; there are " + names);
}

template <int Dim>
Hessian<Dim> project_positive(const Hessian<Dim>& H) {
  const Eigen::SelfAdjointEigenSolver<Hessian<Dim>> eigen(H);
  if (eigen.eigenvalues()[0] >= 0) return H;
  const auto& Q = eigen.eigenvectors();
  return Q * eigen.eigenvalues().cwiseMax(0).asDiagonal() * Q.transpose();
}

template std::span<const ElasticMaterial<2>> elastic_materials<2>();
template std::span<const ElasticMaterial<3>> elastic_materials<3>();
template const ElasticMaterial<2>& elastic_material<2>(std::string_view);
template const ElasticMaterial<3>& elastic_material<3>(std::string_view);
template Hessian<2> project_positive<2>(const Hessian<2>&);
template Hessian<3> project_positive<3>(const Hessian<3>&);

}  // namespace seiche
