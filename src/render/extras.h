#pragma once
// What is made of a series of pictures: one sheet with several of them, and a film.
#include <filesystem>
#include <string>
#include <vector>

#include "render/image.h"

namespace seiche::render {

// Up to twelve evenly chosen pictures of a series, the first and the last among them, in rows of up to four.
class ContactSheet {
 public:
  ContactSheet(int pictures, int width, int height);
  // Takes picture `index` of the series (from zero, ascending) if it is one of the chosen, and prints the label on it
  // in letters that stay readable.
  void offer(int index, const Image& picture, const std::string& label);
  const Image& image() const { return image_; }

 private:
  int pictures_, tiles_, columns_, tile_width_, tile_height_, next_ = 0;
  Image image_;
};

// Encodes PNG pictures of one size to an H.264 film with ffmpeg. Returns "" or, where there is no ffmpeg, a line that
// says so. Throws Error(output_failed) when ffmpeg fails.
std::string encode_animation(const std::vector<std::filesystem::path>& pictures, double rate,
                             const std::filesystem::path& film);

}  // namespace seiche::render
