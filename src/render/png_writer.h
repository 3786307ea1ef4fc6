#pragma once
// The only adapter to libpng.
#include <filesystem>

#include "render/image.h"

namespace seiche::render {

// Written completely or not at all (files/checked_file). Throws Error(output_failed) with the path and the cause.
void write_png(const std::filesystem::path& file, const Image& image);

// Reads any PNG as 8-bit RGB. Throws Error(bad_input).
Image read_png(const std::filesystem::path& file);

}  // namespace seiche::render
