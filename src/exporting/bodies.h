#pragma once
// The solids of a run: their surfaces in a frame, and where they were placed.
#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "base/vec.h"
#include "files/solid_mesh.h"

namespace seiche::exporting {

// The surface of each solid, `count` of them, with its own points alone; in the same order in every frame.
std::vector<SurfaceMesh> split(const render::SolidMesh& solids, std::size_t count);

// Place of a body frame: its origin is the centre of mass, its axes those of the domain at t = 0.
struct Pose {
  Vec3 position{0, 0, 0};
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

// The poses of solids.csv.
class PoseTable {
 public:
  // Reads the table. Throws Error(bad_input) naming the file and the line that is not as Seiche writes it.
  PoseTable(const std::filesystem::path& file, const std::vector<std::string>& solids);
  // Pose of a solid at time t (s) of a frame. Throws Error(bad_input) if the table has no row of that time.
  const Pose& at(std::size_t solid, double t) const;

 private:
  std::filesystem::path file_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::pair<double, Pose>>> rows_;  // of each solid, by time
};

}  // namespace seiche::exporting
