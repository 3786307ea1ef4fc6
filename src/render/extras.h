#pragma once
// Products of a series of pictures: a contact sheet and a film.
#include <filesystem>
#include <string>
#include <vector>

#include "render/image.h"

namespace seiche::render {

// Contact sheet of up to twelve evenly spaced pictures of a series, including first and last, in rows of up to four.
class ContactSheet {
 public:
  ContactSheet(int pictures, int width, int height, const std::string& font);
  // Adds picture `index` of the series (from zero, ascending) if it is selected, with the label on a line of its own
  // above it, in a readable size.
  void offer(int index, const Image& picture, const std::string& label);
  const Image& image() const { return image_; }

 private:
  std::string font_;
  int pictures_, tiles_, columns_, tile_width_, tile_height_, label_height_, next_ = 0;
  Image image_;
};

// Encodes PNG pictures of equal size as an H.264 film with ffmpeg. Returns "", or a message if ffmpeg is not installed.
// Throws Error(output_failed) if ffmpeg fails.
std::string encode_animation(const std::vector<std::filesystem::path>& pictures, double rate,
                             const std::filesystem::path& film);

}  // namespace seiche::render
