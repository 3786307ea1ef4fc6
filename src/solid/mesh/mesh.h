#pragma once
// Meshes of elastic bodies: triangles in 2D, tetrahedra in 3D, linear (order 1) or quadratic (order 2).
#include <functional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "solid/mesh/shape.h"

namespace seiche {

template <int Dim>
struct ElasticMesh {
  int order = 1;
  std::vector<Vec<Dim>> nodes;  // at rest, m
  std::vector<int> elements;    // nodes of one element after the other: corners, then edge middles in the order of VTK

  int nodes_per_element() const { return elastic::nodes_per_simplex(Dim, order); }
  int element_count() const { return int(elements.size()) / nodes_per_element(); }
  const int* element(int e) const { return elements.data() + size_t(e) * nodes_per_element(); }
};

// A side of one element only. Its nodes are ordered as in an element of one dimension less: outward by the right-hand
// rule (3D), inside to the left (2D).
struct BoundaryFace {
  int element = 0;
  std::vector<int> nodes;
};

template <int Dim>
std::vector<BoundaryFace> boundary_faces(const ElasticMesh<Dim>& mesh);

// The linear facets that represent a side of an element, as indices of the side's nodes.
std::vector<std::vector<int>> facets_of_side(int dim, int order);

// The boundary as closed triangles or segments, for contact and liquid. Its points are mesh nodes, so barycentric
// weights on a facet are weights of nodes. A quadratic face becomes 2 segments or 4 triangles.
struct ElasticSurface {
  SurfaceMesh facets;               // at rest
  std::vector<BoundaryFace> sides;  // one side after the other, each with as many facets as facets_of_side
  std::vector<int> nodes;           // the mesh node of each point
  std::vector<int> part;            // connected part of the surface, by point, counted from 0
  int parts = 0;
};

template <int Dim>
ElasticSurface surface_of(const ElasticMesh<Dim>& mesh);

// Moves the surface to displacements u of all nodes, stacked node by node.
template <int Dim>
void move_surface(ElasticSurface& surface, const ElasticMesh<Dim>& mesh, const Eigen::VectorXd& u);

// The mesh with additional mid-edge nodes.
template <int Dim>
ElasticMesh<Dim> promote_to_quadratic(const ElasticMesh<Dim>& linear);

// A box of prod(cells) blocks, each split along its diagonal (Kuhn 1960): 2 triangles or 6 tetrahedra.
template <int Dim>
ElasticMesh<Dim> box_mesh(const Vec<Dim>& lower, const Vec<Dim>& upper, const IVec<Dim>& cells, int order);

// Smallest det dX/dxi over quadrature points and nodes, relative to longest edge^Dim.
template <int Dim>
double least_jacobian(const ElasticMesh<Dim>& mesh, int element);

struct MeshQuality {
  int nodes = 0, elements = 0;
  double volume = 0;                           // m^3; in 2D m^2
  double shortest_edge = 0, longest_edge = 0;  // m
  double worst = 0, mean = 0;                  // mean ratio (Liu, Joe 1994): 1 regular, 0 flat
  int worst_element = 0;
};

template <int Dim>
MeshQuality mesh_quality(const ElasticMesh<Dim>& mesh);

// Removes unused nodes, with a note. Throws Error(bad_input) that begins with `where` and lists the first elements that
// are inverted, flat, disconnected, with repeated or non-existent nodes, and the first nodes that are not finite.
template <int Dim>
void check_mesh(ElasticMesh<Dim>& mesh, const std::string& where, std::vector<std::string>& notes);

}  // namespace seiche
