#pragma once
// Settings shared by all pictures of a run.
#include "base/scene.h"
#include "render/color.h"
#include "render/frame.h"
#include "render/run.h"

namespace seiche::render {

struct Job {
  RenderOptions options;
  Scene scene;
  std::filesystem::path frames, out;
  std::vector<int> chosen;
  int dimension = 3;
  FrameWants wants;
  ColorScale scale;
};

// Reads the scene and the chosen frames' range of colours. Throws Error(bad_input) as render_run() does.
Job prepare_job(const RenderOptions& options, const std::function<void(const std::string&)>& say);

// The scale of one frame, with `per_frame`; else the job's.
ColorScale scale_of(const Job& job, const LoadedFrame& frame);

// Throws Error(bad_input) that names the first option that does not go with others or with the dimension, and what to
// do.
void require_fitting_options(const RenderOptions& options, int dimension, bool has_quantity);

}  // namespace seiche::render
