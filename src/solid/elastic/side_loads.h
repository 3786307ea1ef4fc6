#pragma once
// Integrals of shape functions over pieces of an elastic body's surface: what a pressure there does to its nodes.
#include "geometry/mesh/facet_pieces.h"
#include "solid/elastic/solid.h"

namespace seiche {

// Over one piece of the deformed surface, for each node of the element's side it lies on. n points out of the body.
template <int Dim>
struct SideLoad {
  std::vector<int> nodes;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> area;      // column i: int N_i n dA, m^(Dim - 1)
  std::vector<Eigen::Matrix<double, Dim, Dim>> moment;  // int N_i n x' dA, m^Dim
};

// Exact to rounding: shape functions, n and x are the element's own, linear or quadratic.
template <int Dim>
SideLoad<Dim> load_of_piece(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const FacetPiece<Dim>& piece);

}  // namespace seiche
