#pragma once
// An elastic body: mesh and material made into mass, energy, forces and stiffness. State is the displacement u of the
// nodes, stacked node by node (Dim numbers each).
#include <vector>

#include "linalg/core/sparse_cholesky.h"
#include "solid/elastic/held_pressure.h"
#include "solid/energy/curvature.h"
#include "solid/material/material.h"
#include "solid/mesh/mesh.h"

namespace seiche {

struct ElasticProperties {
  double density = 1000;  // at rest, kg/m^3
  Lame lame;
  double mass_damping = 0;       // Rayleigh's alpha, 1/s
  double stiffness_damping = 0;  // Rayleigh's beta, s
};

// Gradients of an element's shape functions at some of its points: row a is dN_a/dX.
template <int Dim>
using ShapeGradients = Eigen::Matrix<double, Eigen::Dynamic, Dim, Eigen::ColMajor, (Dim + 1) * (Dim + 2) / 2, Dim>;

template <int Dim>
struct ElasticBody {
  ElasticMesh<Dim> mesh;
  ElasticMaterial<Dim> material;
  ElasticProperties properties;
  int points_per_element = 0;                       // of quadrature
  std::vector<ShapeGradients<Dim>> gradients;       // at them
  std::vector<double> weights;                      // their volume, m^3
  std::vector<ShapeGradients<Dim>> node_gradients;  // at the nodes of each element; empty at order 1
  SparseMatrix mass;                                // consistent, kg
  Eigen::VectorXd lumped_mass;                      // diagonal, kg (Hinton, Rock, Zienkiewicz 1976)
  SparseMatrix pattern;                             // zeros where the stiffness has entries
  std::vector<int> slots;  // of element e, nodes a, b: where in a column of b the rows of a begin

  int size() const { return Dim * int(mesh.nodes.size()); }
};

// The mesh must have passed check_mesh().
template <int Dim>
ElasticBody<Dim> make_elastic_body(ElasticMesh<Dim> mesh, const ElasticMaterial<Dim>& material,
                                   const ElasticProperties& properties);

// F at quadrature point q.
template <int Dim>
Gradient<Dim> deformation_at(const ElasticBody<Dim>& body, int q, const Eigen::VectorXd& u);

// Psi(u), J, with the guard of solid/material/guard.h below a tenth of the volume at rest; infinite where det F <= 0.
// With the work against the held pressure, if any.
template <int Dim>
double elastic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const HeldPressure<Dim>& held = {});

// dPsi/du, N: minus the elastic force.
template <int Dim>
Eigen::VectorXd elastic_gradient(const ElasticBody<Dim>& body, const Eigen::VectorXd& u,
                                 const HeldPressure<Dim>& held = {});

// Adds d2Psi/du2 (N/m) to a matrix of the body's pattern; convex: that of each quadrature point made positive
// semi-definite.
template <int Dim>
void add_stiffness(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, Curvature curvature, SparseMatrix& K,
                   const HeldPressure<Dim>& held = {});

// integral of f . N_a over the body at rest; f in N/m^3 at points at rest. Constant f: body_force(...).
template <int Dim>
Eigen::VectorXd body_force(const ElasticBody<Dim>& body, const std::function<Vec<Dim>(const Vec<Dim>&)>& f);

// integral of t . N_a over boundary faces; t in Pa at points at rest. Dead load: area and direction at rest.
template <int Dim>
Eigen::VectorXd traction_force(const ElasticBody<Dim>& body, const std::vector<BoundaryFace>& faces,
                               const std::function<Vec<Dim>(const Vec<Dim>&)>& t);

// det F at least, over quadrature points and nodes.
template <int Dim>
double least_volume_ratio(const ElasticBody<Dim>& body, const Eigen::VectorXd& u);

// The largest share of the step d, at most 1, along which no det F falls below a tenth of what it is at u, at any
// quadrature point or node: a bound from below on the root of its polynomial.
template <int Dim>
double inversion_bound(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Eigen::VectorXd& d);

}  // namespace seiche
