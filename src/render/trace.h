#pragma once
// Renders 3D frames by ray tracing.
#include "render/camera.h"
#include "render/stage.h"

namespace seiche::render {

// The picture with the domain's edges: about one ray per pixel in smooth areas and four elsewhere; rows in parallel.
Canvas trace_picture(const Stage& stage, const Camera& camera);

}  // namespace seiche::render
