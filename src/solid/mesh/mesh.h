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

// A side that one element alone has; its nodes as in an element a dimension lower, outward by the right-hand rule (3D),
// the inside to the left (2D).
struct BoundaryFace {
  int element = 0;
  std::vector<int> nodes;
};

template <int Dim>
std::vector<BoundaryFace> boundary_faces(const ElasticMesh<Dim>& mesh);

// The linear facets that stand for a side of an element, as indices of the side's nodes.
std::vector<std::vector<int>> facets_of_side(int dim, int order);

// The boundary as closed triangles or segments for contact and liquid. Its points are mesh nodes, so the barycentric
// weights on a facet are the weights on nodes. A quadratic face becomes 2 segments or 4 triangles.
struct ElasticSurface {
  SurfaceMesh facets;               // at rest
  std::vector<BoundaryFace> sides;  // each as many facets as facets_of_side, one side after the other
  std::vector<int> nodes;           // the mesh node of each point
  std::vector<int> part;            // of each point: which connected part of the surface it is on, counted from 0
  int parts = 0;
};

template <int Dim>
ElasticSurface surface_of(const ElasticMesh<Dim>& mesh);

// The same surface after displacements u of all nodes, stacked node by node.
template <int Dim>
void move_surface(ElasticSurface& surface, const ElasticMesh<Dim>& mesh, const Eigen::VectorXd& u);

// The mesh with a node in the middle of each edge.
template <int Dim>
ElasticMesh<Dim> promote_to_quadratic(const ElasticMesh<Dim>& linear);

// A box of prod(cells) blocks, each split along its diagonal (Kuhn 1960): 2 triangles or 6 tetrahedra.
template <int Dim>
ElasticMesh<Dim> box_mesh(const Vec<Dim>& lower, const Vec<Dim>& upper, const IVec<Dim>& cells, int order);

// det dX/dxi at least, over the points at which the element's energy is taken and its nodes, over longest edge^Dim.
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

// Drops nodes that no element has, with a note. Throws Error(bad_input) that begins with `where` and lists the first
// elements that are inverted, flat or apart from the others, that have a node twice or one that does not exist, and
// nodes that are not finite.
template <int Dim>
void check_mesh(ElasticMesh<Dim>& mesh, const std::string& where, std::vector<std::string>& notes);

}  // namespace seiche
