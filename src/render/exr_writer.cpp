#include "render/exr_writer.h"

#include <ImfIO.h>
#include <ImfRgbaFile.h>
#include <fmt/format.h>

#include "base/error.h"
#include "files/checked_file.h"

namespace seiche::render {
namespace {

// OpenEXR writes into memory; the file is written by ours.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char bytes[], int count) override {
    const auto size = std::size_t(count);
    if (text_.size() < at_ + size) text_.resize(at_ + size);
    text_.replace(at_, size, bytes, size);
    at_ += size;
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t place) override { at_ = place; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace

void write_exr(const std::filesystem::path& file, const Canvas& canvas) {
  MemoryStream stream;
  try {
    std::vector<Imf::Rgba> pixels;
    pixels.reserve(canvas.pixels.size());
    for (std::size_t i = 0; i < canvas.pixels.size(); ++i) {
      const Vec3f& light = canvas.pixels[i];
      pixels.emplace_back(light[0], light[1], light[2], canvas.alpha.empty() ? 1.0f : canvas.alpha[i]);
    }
    const Imf::Header header(canvas.width, canvas.height, 1, {0, 0}, 1, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
    Imf::RgbaOutputFile output(stream, header, canvas.alpha.empty() ? Imf::WRITE_RGB : Imf::WRITE_RGBA);
    output.setFrameBuffer(pixels.data(), 1, std::size_t(canvas.width));
    output.writePixels(canvas.height);
  } catch (const std::exception& error) {
    throw Error(ExitCode::output_failed, fmt::format("{}: cannot encode the picture: {}", file.string(), error.what()));
  }
  write_file(file, stream.text());
}

Canvas read_exr(const std::filesystem::path& file) {
  try {
    Imf::RgbaInputFile input(file.c_str());
    const auto box = input.dataWindow();
    const int width = box.max.x - box.min.x + 1, height = box.max.y - box.min.y + 1;
    std::vector<Imf::Rgba> pixels(std::size_t(width) * std::size_t(height));
    input.setFrameBuffer(pixels.data() - box.min.x - std::ptrdiff_t(box.min.y) * width, 1, std::size_t(width));
    input.readPixels(box.min.y, box.max.y);
    Canvas canvas(width, height, Vec3f::Zero());
    const bool has_alpha = (input.channels() & Imf::WRITE_A) != 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      canvas.pixels[i] = Vec3f(pixels[i].r, pixels[i].g, pixels[i].b);
      if (has_alpha) canvas.alpha.push_back(pixels[i].a);
    }
    return canvas;
  } catch (const std::exception& error) {
    throw Error(ExitCode::bad_input, fmt::format("{}: not a readable EXR: {}", file.string(), error.what()));
  }
}

}  // namespace seiche::render
