#pragma once
// The only adapter to OpenEXR.
#include <filesystem>

#include "render/image.h"

namespace seiche::render {

// Linear light as half-precision RGBA, or RGB where the canvas has no alpha, compressed without loss. Written
// completely or not at all. Throws Error(output_failed) with the path and the cause.
void write_exr(const std::filesystem::path& file, const Canvas& canvas);

// Throws Error(bad_input).
Canvas read_exr(const std::filesystem::path& file);

}  // namespace seiche::render
