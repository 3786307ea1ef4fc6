#pragma once
// Scalable fonts of the system, found by fontconfig.
#include <filesystem>
#include <string>

namespace seiche::render {

struct FontFile {
  std::filesystem::path file;
  int index = 0;  // of the face in the file
};

// The font for a name: "" for DejaVu Sans or, without it, another font of the system; a family such as "Liberation
// Serif"; or a file (a name with '/'). Throws Error(bad_input) with the remedy if there is none.
FontFile find_font(const std::string& name);

// Height of small texts for a picture of this size, in pixels.
float text_size(int width, int height);

}  // namespace seiche::render
