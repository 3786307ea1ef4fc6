#pragma once
// Renders 3D frames by ray tracing.
#include "render/camera.h"
#include "render/stage.h"

namespace seiche::render {

struct TraceStyle {
  bool edges = true;   // of the domain
  bool expose = true;  // highlights are compressed into [0, 1]; false: light as it is, for EXR
};

// About one ray per pixel in smooth areas and four elsewhere; rows in parallel. The canvas of a transparent stage has
// alpha.
Canvas trace_picture(const Stage& stage, const Camera& camera, const TraceStyle& style = {});

}  // namespace seiche::render
