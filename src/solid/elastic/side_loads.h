#pragma once
// Nodal loads of a pressure on pieces of an elastic body's surface: integrals of shape functions.
#include "geometry/mesh/facet_pieces.h"
#include "solid/elastic/solid.h"

namespace seiche {

// Integrals over one piece of the deformed surface, for each node of its element's side. n points out of the body.
template <int Dim>
struct SideLoad {
  std::vector<int> nodes;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> area;      // column i: int N_i n dA, m^(Dim - 1)
  std::vector<Eigen::Matrix<double, Dim, Dim>> moment;  // int N_i n x' dA, m^Dim
};

// Exact to rounding: shape functions, n and x are those of the element, linear or quadratic.
template <int Dim>
SideLoad<Dim> load_of_piece(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const FacetPiece<Dim>& piece);

}  // namespace seiche
