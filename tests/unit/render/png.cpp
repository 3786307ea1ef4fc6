#include <catch2/catch.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "render/png_writer.h"

namespace png_tests {
using namespace seiche;
using namespace seiche::render;
namespace fs = std::filesystem;

namespace {

fs::path scratch(const std::string& name) {
  const fs::path folder = fs::temp_directory_path() / ("seiche_png_" + std::to_string(getpid()));
  fs::create_directories(folder);
  return folder / name;
}

Image noise(int width, int height) {
  Image image{width, height, std::vector<std::uint8_t>(std::size_t(width) * height * 3)};
  std::mt19937 generator(7);
  for (auto& value : image.rgb) value = std::uint8_t(generator());
  return image;
}

}  // namespace

TEST_CASE("a picture comes back from its PNG bit for bit, at odd sizes too") {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {64, 48}, {161, 97}}) {
    const Image image = noise(width, height);
    const fs::path file = scratch("noise.png");
    write_png(file, image);
    const Image back = read_png(file);
    CHECK(back.width == width);
    CHECK(back.height == height);
    CHECK(back.rgb == image.rgb);
  }
  fs::remove_all(scratch("").parent_path());
}

TEST_CASE("writing a picture into a missing folder fails as an output error, reading text as bad input") {
  try {
    write_png(scratch("missing") / "deeper" / "picture.png", noise(4, 4));
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::output_failed);
  }
  const fs::path text = scratch("text.png");
  std::ofstream(text) << "not a picture";
  CHECK_THROWS_AS(read_png(text), Error);
  fs::remove_all(text.parent_path());
}

TEST_CASE("light survives the trip to 8-bit sRGB") {
  Canvas canvas(1, 256, Vec3f::Zero());
  for (int i = 0; i < 256; ++i) canvas.at(0, i) = from_srgb(float(i) / 255, 0, 1);
  const Image image = to_image(canvas);
  for (int i = 0; i < 256; ++i) {
    CHECK(std::abs(int(image.rgb[3 * std::size_t(i)]) - i) <= 1);  // one step of the table of 4096 entries near black
    CHECK(image.rgb[3 * std::size_t(i) + 2] == 255);
  }
}

}  // namespace png_tests
