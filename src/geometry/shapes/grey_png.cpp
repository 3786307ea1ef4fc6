// Adapter to libpng: grey pictures as height maps.
#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "geometry/shapes/height_map.h"

namespace seiche {
namespace {

[[noreturn]] void refuse_png(const std::filesystem::path& file, const std::string& why) {
  throw Error(ExitCode::bad_input, fmt::format("{}: {}", file.string(), why));
}

void keep_png_error(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}
void ignore_png_warning(png_structp, png_const_charp) {
  // flaws that do not keep a picture from being read
}

class PngReader {
 public:
  explicit PngReader(const std::filesystem::path& file) : file_(file), stream_(std::fopen(file.c_str(), "rb")) {
    if (!stream_) refuse_png(file, "cannot be opened");
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault_, keep_png_error, ignore_png_warning);
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) refuse_png(file, "libpng has no memory");
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  HeightMap read() {
    guarded([this] {
      png_init_io(png_, stream_.get());
      png_set_user_limits(png_, png_uint_32(most_map_samples), png_uint_32(most_map_samples));
      png_read_info(png_, info_);
    });
    HeightMap map;
    map.grey = true;
    require_map_size(file_, png_get_image_width(png_, info_), png_get_image_height(png_, info_));
    map.columns = int(png_get_image_width(png_, info_));
    map.rows = int(png_get_image_height(png_, info_));
    const int depth = png_get_bit_depth(png_, info_);
    if (png_get_color_type(png_, info_) != PNG_COLOR_TYPE_GRAY || (depth != 8 && depth != 16))
      refuse_png(file_,
                 "a height map is a grey picture of 8 or 16 bits a pixel without transparency; `convert IN -alpha off "
                 "-colorspace Gray -depth 16 OUT.png` makes one");
    guarded([this] {
      png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
    });
    decode(depth / 8, map);
    return map;
  }

 private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };

  // libpng leaves a step that fails by longjmp(), so that steps must hold nothing to destroy.
  template <class Step>
  void guarded(const Step& step) {
    if (setjmp(png_jmpbuf(png_)) != 0) refuse_png(file_, "not a readable PNG: " + fault_);
    step();
  }

  void decode(int bytes, HeightMap& map) {
    const std::size_t width = std::size_t(map.columns) * std::size_t(bytes);
    std::vector<png_byte> pixels(width * std::size_t(map.rows));
    std::vector<png_bytep> lines;
    for (int row = 0; row < map.rows; ++row) lines.push_back(pixels.data() + std::size_t(row) * width);
    guarded([&] { png_read_image(png_, lines.data()); });
    map.values.reserve(pixels.size() / std::size_t(bytes));
    for (std::size_t n = 0; n < pixels.size(); n += std::size_t(bytes))
      map.values.push_back(bytes == 1 ? pixels[n] / 255.0 : (256 * pixels[n] + pixels[n + 1]) / 65535.0);
  }

  std::filesystem::path file_;
  std::string fault_;
  std::unique_ptr<std::FILE, Close> stream_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

HeightMap read_grey_png(const std::filesystem::path& file) {
  return PngReader(file).read();
}

}  // namespace seiche
