#pragma once
// Finite elements of an elastic body: mass, energy, forces and stiffness from mesh and material. The state is the nodal
// displacement u, stacked node by node (Dim numbers each).
#include <vector>

#include "base/index_range.h"
#include "linalg/core/sparse_cholesky.h"
#include "solid/elastic/held_pressure.h"
#include "solid/energy/hessian_projection.h"
#include "solid/material/material.h"
#include "solid/mesh/mesh.h"

namespace seiche {

struct ElasticProperties {
  double density = 1000;  // at rest, kg/m^3
  Lame lame;
  double mass_damping = 0;       // Rayleigh's alpha, 1/s
  double stiffness_damping = 0;  // Rayleigh's beta, s
};

// Gradients of an element's shape functions at one point: row a is dN_a/dX.
template <int Dim>
using ShapeGradients = Eigen::Matrix<double, Eigen::Dynamic, Dim, Eigen::ColMajor, (Dim + 1) * (Dim + 2) / 2, Dim>;

template <int Dim>
struct ElasticBody {
  ElasticMesh<Dim> mesh;
  ElasticMaterial<Dim> material;
  ElasticProperties properties;
  int points_per_element = 0;                       // quadrature points
  std::vector<ShapeGradients<Dim>> gradients;       // at the quadrature points
  std::vector<double> weights;                      // volume of each quadrature point, m^3
  std::vector<ShapeGradients<Dim>> node_gradients;  // at the nodes of each element; empty at order 1
  SparseMatrix mass;                                // consistent, kg
  Eigen::VectorXd lumped_mass;                      // diagonal, kg (Hinton, Rock, Zienkiewicz 1976)
  SparseMatrix pattern;                             // zeros at the entries of the stiffness
  std::vector<int> slots;  // of element e, nodes a, b: start of the rows of a within a column of b

  int size() const { return Dim * int(mesh.nodes.size()); }
  IndexRange all_elements() const { return {0, mesh.element_count()}; }
};

// The mesh must have passed check_mesh().
template <int Dim>
ElasticBody<Dim> make_elastic_body(ElasticMesh<Dim> mesh, const ElasticMaterial<Dim>& material,
                                   const ElasticProperties& properties);

// Deformation gradient F at quadrature point q.
template <int Dim>
Gradient<Dim> deformation_at(const ElasticBody<Dim>& body, int q, const Eigen::VectorXd& u);

// Psi(u) (J), with the guard of solid/material/guard.h below a tenth of the rest volume; infinite where det F <= 0.
// Includes the work against the held pressure, if any. Sums the given elements alone, as all that follow.
template <int Dim>
double elastic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const HeldPressure<Dim>& held,
                      IndexRange elements);

// dPsi/du, N: minus the elastic force.
template <int Dim>
Eigen::VectorXd elastic_gradient(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const HeldPressure<Dim>& held,
                                 IndexRange elements);

// Adds d2Psi/du2 (N/m) to K, which has the given columns of the body's pattern. convex: the Hessian of each quadrature
// point is projected to positive semi-definite.
template <int Dim>
void add_stiffness(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, HessianProjection curvature,
                   const HeldPressure<Dim>& held, IndexRange elements, IndexRange columns, SparseMatrix& K);

// The same of all elements and columns.
template <int Dim>
double elastic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const HeldPressure<Dim>& held = {}) {
  return elastic_energy(body, u, held, body.all_elements());
}
template <int Dim>
Eigen::VectorXd elastic_gradient(const ElasticBody<Dim>& body, const Eigen::VectorXd& u,
                                 const HeldPressure<Dim>& held = {}) {
  return elastic_gradient(body, u, held, body.all_elements());
}
template <int Dim>
void add_stiffness(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, HessianProjection curvature, SparseMatrix& K,
                   const HeldPressure<Dim>& held = {}) {
  add_stiffness(body, u, curvature, held, body.all_elements(), {0, body.size()}, K);
}

// Integral of f . N_a over the body at rest; f in N/m^3 by rest position. Constant f: body_force(...).
template <int Dim>
Eigen::VectorXd body_force(const ElasticBody<Dim>& body, const std::function<Vec<Dim>(const Vec<Dim>&)>& f);

// Integral of t . N_a over boundary faces; t in Pa by rest position. A dead load: area and direction are those at rest.
template <int Dim>
Eigen::VectorXd traction_force(const ElasticBody<Dim>& body, const std::vector<BoundaryFace>& faces,
                               const std::function<Vec<Dim>(const Vec<Dim>&)>& t);

// Smallest det F over quadrature points and nodes.
template <int Dim>
double least_volume_ratio(const ElasticBody<Dim>& body, const Eigen::VectorXd& u);

// Largest share of the step d, at most 1, along which no det F falls below a tenth of its value at u, at any quadrature
// point or node of the given elements. A lower bound on the root of its polynomial.
template <int Dim>
double inversion_bound(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Eigen::VectorXd& d,
                       IndexRange elements);
template <int Dim>
double inversion_bound(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Eigen::VectorXd& d) {
  return inversion_bound(body, u, d, body.all_elements());
}

}  // namespace seiche
