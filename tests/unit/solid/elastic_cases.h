#pragma once
// Helpers for tests of elastic bodies.
#include <catch2/catch.hpp>

#include <cmath>

#include "solid/elastic/step.h"

namespace seiche::testing {

template <int Dim>
ElasticBody<Dim> elastic_body(ElasticMesh<Dim> mesh, const char* material, double density, double E, double nu) {
  ElasticProperties properties;
  properties.density = density;
  properties.lame = lame_of(E, nu);
  return make_elastic_body<Dim>(std::move(mesh), seiche::elastic_material<Dim>(material), properties);
}

// Nodes whose rest position satisfies f.
template <int Dim, class Predicate>
std::vector<int> nodes_where(const ElasticMesh<Dim>& mesh, Predicate f) {
  std::vector<int> r;
  for (size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (f(mesh.nodes[n])) r.push_back(int(n));
  }
  return r;
}

template <int Dim>
int node_nearest(const ElasticMesh<Dim>& mesh, const Vec<Dim>& X) {
  int best = 0;
  for (size_t n = 0; n < mesh.nodes.size(); ++n) {
    if ((mesh.nodes[n] - X).norm() < (mesh.nodes[best] - X).norm()) best = int(n);
  }
  return best;
}

// Boundary faces whose nodes all satisfy f.
template <int Dim, class Predicate>
std::vector<BoundaryFace> faces_where(const ElasticMesh<Dim>& mesh, Predicate f) {
  std::vector<BoundaryFace> r;
  for (const auto& face : boundary_faces(mesh)) {
    if (std::all_of(face.nodes.begin(), face.nodes.end(), [&](int n) { return f(mesh.nodes[n]); })) r.push_back(face);
  }
  return r;
}

// Values of a field at the nodes.
template <int Dim, class Field>
Eigen::VectorXd at_nodes(const ElasticMesh<Dim>& mesh, Field f) {
  Eigen::VectorXd r(Dim * mesh.nodes.size());
  for (size_t n = 0; n < mesh.nodes.size(); ++n) r.segment<Dim>(Dim * n) = f(mesh.nodes[n]);
  return r;
}

// The strip [0, length] x [0, height] of the plane, clamped at x = 0.
struct Strip {
  double length = 1, height = 0.1;
  ElasticBody<2> body;
  Pins clamp;
  int tip = 0;                    // node at (length, height / 2), or the nearest
  std::vector<BoundaryFace> end;  // at x = length
};

inline Strip clamped_strip(double length, double height, const IVec<2>& cells, int order, const char* material,
                           double density, double E, double nu) {
  auto mesh = box_mesh<2>(Vec<2>::Zero(), Vec<2>(length, height), cells, order);
  Strip s{length, height, elastic_body<2>(std::move(mesh), material, density, E, nu), {}, 0, {}};
  const double near = 1e-9 * length;
  s.clamp = pin_nodes<2>(nodes_where(s.body.mesh, [&](const Vec<2>& X) { return X[0] < near; }));
  s.tip = node_nearest<2>(s.body.mesh, Vec<2>(length, height / 2));
  s.end = faces_where(s.body.mesh, [&](const Vec<2>& X) { return X[0] > length - near; });
  return s;
}

}  // namespace seiche::testing
