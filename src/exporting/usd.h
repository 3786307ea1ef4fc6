#pragma once
// A run as one scene of Universal Scene Description, in its text form (.usda): the liquid, the solids, their motion.
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "exporting/bodies.h"
#include "exporting/liquid.h"
#include "files/checked_file.h"

namespace seiche::exporting {

struct StageFacts {
  std::string comment, name;  // name: of the prim that holds all
  int first = 0, last = 0;    // time codes are numbers of frames
  double frame_rate = 24;     // 1/s
  char up = 'Y';
};

// A valid and unique name of a prim for each text: letters, digits and '_'.
std::vector<std::string> prim_names(const std::vector<std::string>& texts);

// Samples go to parts beside the file, one an attribute, since the form lists all samples of an attribute together.
// finish() joins them. Throws Error(output_failed).
class UsdWriter {
 public:
  UsdWriter(std::filesystem::path file, StageFacts facts);
  ~UsdWriter();  // removes the parts
  UsdWriter(const UsdWriter&) = delete;
  UsdWriter& operator=(const UsdWriter&) = delete;

  // A mesh whose points, and triangles if they change, are given at each frame.
  void add_sample(const std::string& prim, int frame, const AttributedMesh& mesh, const Vec3& color);
  // A mesh in its body frame, at all frames the same, and its pose at a frame.
  void add_body(const std::string& prim, const SurfaceMesh& mesh, const Vec3& color);
  void add_pose(const std::string& prim, int frame, const Pose& pose);
  void finish();

 private:
  struct Prim {
    bool is_body = false;
    Vec3 color{0, 0, 0};
    std::vector<std::array<int, 3>> triangles;  // of the last sample
    std::vector<std::string> order;             // attributes as declared
    std::map<std::string, std::unique_ptr<AppendFile>> parts;
  };

  void put(Prim& prim, const std::string& name, const std::string& attribute, int frame, const std::string& value);
  std::string opening(const std::string& name, const Prim& prim) const;

  std::filesystem::path file_;
  StageFacts facts_;
  std::vector<std::string> order_;  // of prims
  std::map<std::string, Prim> prims_;
};

}  // namespace seiche::exporting
