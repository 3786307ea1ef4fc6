#pragma once
// Pictures of 3D frames by ray tracing.
#include "render/camera.h"
#include "render/stage.h"

namespace seiche::render {

// The picture, about one ray a pixel where it is smooth and four where it is not; rows in parallel. The edges of the
// domain are drawn in.
Canvas trace_picture(const Stage& stage, const Camera& camera);

}  // namespace seiche::render
