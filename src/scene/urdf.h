#pragma once
// Robots in URDF files, as liburdfdom reads them.
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "base/vec.h"

namespace seiche {

using LinkPlace = Eigen::Isometry3d;

// The robot of a file. Null, and what is wrong, if it cannot be read.
urdf::ModelInterfaceSharedPtr read_urdf(const std::filesystem::path& file, std::string& fault);

Vec3 vector_of(const urdf::Vector3& v);
LinkPlace place_of(const urdf::Pose& pose);

struct LinkShape {
  urdf::GeometrySharedPtr geometry;
  LinkPlace place;  // in the link
};
// Shapes for collisions, or else those for show.
std::vector<LinkShape> shapes_of(const urdf::Link& link);

// True if a fixed joint holds the link.
bool is_welded(const urdf::Link& link);
// Root first, parents before children.
std::vector<urdf::LinkSharedPtr> links_of(const urdf::ModelInterface& model);

}  // namespace seiche
