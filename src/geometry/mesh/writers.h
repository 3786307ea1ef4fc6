#pragma once
// Writes surface meshes with attributes of their points.
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// Values at the points of a mesh, point by point.
struct PointAttribute {
  std::string name;
  int components = 1;  // 1 or 3
  std::vector<float> values;
};

// Binary little-endian PLY. Vectors become three properties: velocity vx, vy, vz; others NAME_x, NAME_y, NAME_z.
std::string encode_ply(const SurfaceMesh& mesh, const std::vector<PointAttribute>& attributes,
                       const std::string& comment);

// Wavefront OBJ with one named object. The format has no place for attributes.
std::string encode_obj(const SurfaceMesh& mesh, const std::string& name, const std::string& comment);

}  // namespace seiche::mesh
