#pragma once
// A [[robot]] of a scene: links and joints that a file in URDF gives. Plain data in SI units.
#include <filesystem>

#include "base/joint_spec.h"

namespace seiche {

// Forces and the place at the start of a joint of the file.
struct RobotJointSpec {
  std::string name;  // in the file
  double start = 0;  // degrees, m
  JointSpec forces;
};

enum class RobotBase : char { free, fixed };

struct RobotSpec {
  std::string name;
  std::filesystem::path file;  // resolved against the scene's folder
  TransformSpec transform;     // of the root link
  RobotBase base = RobotBase::free;
  std::optional<double> density;  // of links without mass in the file, kg/m^3
  std::vector<RobotJointSpec> joints;
  std::string where;  // "scene.toml:14"
};

}  // namespace seiche
