#include "render/png_writer.h"

#include <fmt/format.h>
#include <png.h>

#include "base/error.h"
#include "files/checked_file.h"

namespace seiche::render {

namespace {

std::vector<std::uint8_t> with_alpha(const Image& image) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(image.alpha.size() * 4);
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    rgba.insert(rgba.end(), {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2], image.alpha[i]});
  }
  return rgba;
}

}  // namespace

void write_png(const std::filesystem::path& file, const Image& image) {
  const std::vector<std::uint8_t> rgba = with_alpha(image);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = png_uint_32(image.width);
  header.height = png_uint_32(image.height);
  header.format = rgba.empty() ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  header.flags = PNG_IMAGE_FLAG_FAST;  // a third of the time for files a tenth larger
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, rgba.empty() ? image.rgb.data() : rgba.data(), 0,
                                 nullptr)) {
    throw Error(ExitCode::output_failed,
                fmt::format("{}: cannot encode the picture: {}", file.string(), header.message));
  }
  write_file(file, std::string_view(bytes).substr(0, size));
}

Image read_png(const std::filesystem::path& file) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&header, file.c_str())) {
    throw Error(ExitCode::bad_input, fmt::format("{}: not a readable PNG: {}", file.string(), header.message));
  }
  const bool has_alpha = (header.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  header.format = has_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(header));
  if (!png_image_finish_read(&header, nullptr, bytes.data(), 0, nullptr)) {
    throw Error(ExitCode::bad_input, fmt::format("{}: not a readable PNG: {}", file.string(), header.message));
  }
  Image image{int(header.width), int(header.height), {}};
  if (!has_alpha) {
    image.rgb = std::move(bytes);
    return image;
  }
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    image.rgb.insert(image.rgb.end(), {bytes[i], bytes[i + 1], bytes[i + 2]});
    image.alpha.push_back(bytes[i + 3]);
  }
  return image;
}

}  // namespace seiche::render
