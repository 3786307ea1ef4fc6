#pragma once
// Draws the pictures of a job one after another.
#include <memory>

#include "render/camera_path.h"
#include "render/job.h"
#include "render/plot.h"
#include "render/stage.h"
#include "render/surface_refiner.h"

namespace seiche::render {

// One picture: a frame, and how far the camera has turned round the scene.
struct Shot {
  int frame = 0;
  float degrees = 0;
};

// The pictures of a job in their order: one a frame, or `turntable` of a single one.
std::vector<Shot> shots_of(const Job& job);

// Draws pictures; keeps the loaded frame from one to the next.
class Studio {
 public:
  explicit Studio(const Job& job);

  // Writes the picture of a shot. `label` becomes what is printed on it, and `image` the pixels; empty for vectors.
  struct Result {
    std::string label;
    Image image;
  };
  Result draw(const Shot& shot, const std::filesystem::path& file);

 private:
  void load(int number);
  Result draw_flat(const std::filesystem::path& file);
  Result draw_solid(const Shot& shot, const std::filesystem::path& file);
  Camera camera_of(const Shot& shot) const;
  Plot plot_of_frame();
  void set_stage();

  const Job& job_;
  SurfaceRefiner refiner_;
  std::optional<LoadedFrame> frame_;
  Stage stage_;
  CameraPath path_;
  std::optional<Vec3f> toward_eye_;  // of the first picture: the light stays where it is
};

}  // namespace seiche::render
