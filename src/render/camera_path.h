#pragma once
// Paths of the camera from a table.
#include <filesystem>

#include "base/curves.h"
#include "render/camera.h"

namespace seiche::render {

// Eye, point looked at and field of view as functions of the simulated time.
struct CameraPath {
  std::array<TimeCurve, 7> columns;  // eye x, y, z, look x, y, z (m), degrees

  bool empty() const { return columns[0].times.empty(); }
  CameraSpec at(double time) const;
};

// Reads rows `time,eye_x,eye_y,eye_z,look_x,look_y,look_z[,degrees]`; a first line of words is a header. Between rows
// the camera moves along smooth curves or straight, beyond them it rests. Throws Error(bad_input) with file, line and
// remedy.
CameraPath read_camera_path(const std::filesystem::path& file, CurveForm form);

}  // namespace seiche::render
