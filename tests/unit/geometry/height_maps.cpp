// Height maps: files, their faults, and the shape below them.
#include <png.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <fstream>

#include "base/error.h"
#include "base/shape_spec.h"
#include "geometry/shapes/height_map.h"
#include "geometry/shapes/shapes.h"
#include "unit/files/scratch.h"

namespace height_maps_tests {
using namespace seiche;
using Catch::Matchers::Contains;

namespace {

// Pixels row by row from the top, two bytes each with 16 bits.
std::filesystem::path write_png(const std::filesystem::path& file, int width, int height, int depth, int color,
                                const std::vector<std::uint8_t>& bytes) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, stream);
  png_set_IHDR(png, info, png_uint_32(width), png_uint_32(height), depth, color, PNG_INTERLACE_ADAM7,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_gAMA(png, info, 0.45455);  // must not bend the heights
  png_write_info(png, info);
  std::vector<png_bytep> lines;
  const std::size_t line = bytes.size() / std::size_t(height);
  for (int row = 0; row < height; ++row) lines.push_back(const_cast<png_bytep>(bytes.data()) + std::size_t(row) * line);
  png_write_image(png, lines.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(stream);
  return file;
}

std::string fault_of_map(const std::filesystem::path& file) {
  try {
    (void)read_height_map(file);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  FAIL_CHECK("the map was accepted: " << file);
  return "";
}

ShapeSpec map_spec(const std::filesystem::path& file, const Vec3& lower, const Vec3& upper, const std::string& up) {
  ShapeSpec spec;
  spec.kind = "height_map";
  spec.where = "scene.toml:14";
  spec.file = file;
  spec.lower = lower, spec.upper = upper;
  spec.up = up;
  return spec;
}

const ShapeOptions quarter{0.25, nullptr};

}  // namespace

TEST_CASE("grey pictures of 8 and 16 bits are read as they are, interlaced too") {
  const ScratchFolder folder;
  const HeightMap eight =
      read_height_map(write_png(folder.path() / "8.png", 3, 2, 8, PNG_COLOR_TYPE_GRAY, {0, 51, 255, 102, 128, 1}));
  CHECK(eight.grey);
  CHECK(eight.columns == 3);
  CHECK(eight.rows == 2);
  CHECK(eight.values == std::vector<double>{0, 51 / 255.0, 1, 102 / 255.0, 128 / 255.0, 1 / 255.0});
  const HeightMap sixteen =
      read_height_map(write_png(folder.path() / "16.PNG", 2, 1, 16, PNG_COLOR_TYPE_GRAY, {0x12, 0x34, 0xff, 0xff}));
  CHECK(sixteen.values == std::vector<double>{0x1234 / 65535.0, 1});
}

TEST_CASE("numbers come apart by commas, semicolons and blanks, with an ESRI header or without") {
  const ScratchFolder folder;
  const HeightMap csv = read_height_map(folder.write("a.csv", "# metres\n1, 2.5,-3\r\n\n4;5 \t6e-1\n"));
  CHECK_FALSE(csv.grey);
  CHECK(csv.columns == 3);
  CHECK(csv.values == std::vector<double>{1, 2.5, -3, 4, 5, 0.6});
  const HeightMap grid = read_height_map(folder.write(
      "a.asc", "NCOLS 2\nnrows 3\nxllcorner 1e6\nyllcorner 0\ncellsize 5\nNODATA_value -9999\n1 2\n3 4\n5 6\n"));
  CHECK(grid.rows == 3);
  CHECK(grid.at(1, 2) == 6);
  CHECK(read_height_map(folder.write("column.txt", "1\n2\n3\n")).columns == 3);
}

TEST_CASE("maps that cannot be used are refused with the place and the remedy") {
  const ScratchFolder folder;
  const auto text = [&](const std::string& content) { return fault_of_map(folder.write("m.csv", content)); };
  CHECK_THAT(text("1 2\n3\n"), Contains("m.csv:2: 1 numbers, but 2 in the rows before"));
  CHECK_THAT(text("1 2\n3 x\n"), Contains("m.csv:2: 'x' is not a number"));
  CHECK_THAT(text("1 nan\n"), Contains("'nan' is not a number"));
  CHECK_THAT(text("1 1e999\n"), Contains("'1e999' is not a number"));
  CHECK_THAT(text("5\n"), Contains("1 x 1 samples is too small"));
  CHECK_THAT(text("# nothing\n"), Contains("holds no numbers"));
  CHECK_THAT(text("ncols 3\nnrows 1\n1 2\n"), Contains("header says 1 rows of 3"));
  CHECK_THAT(text("ncols x\n1 2\n"), Contains("m.csv:1: ncols must have one number"));
  CHECK_THAT(text("nodata_value -9\n1 -9\n"), Contains("m.csv:2: a height is missing (NODATA_value -9); fill"));
  CHECK_THAT(fault_of_map(folder.path() / "none.csv"), Contains("none.csv"));
  CHECK_THAT(fault_of_map(folder.path() / "none.png"), Contains("none.png: cannot be opened"));
  const auto rgb = write_png(folder.path() / "rgb.png", 2, 1, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3, 4, 5, 6});
  CHECK_THAT(fault_of_map(rgb), Contains("rgb.png: a height map is a grey picture of 8 or 16 bits"));
  CHECK_THAT(fault_of_map(write_png(folder.path() / "one.png", 1, 2, 8, PNG_COLOR_TYPE_GRAY, {1, 2})),
             Contains("1 x 2 samples is too small"));
  CHECK_THAT(fault_of_map(folder.write("text.png", "not a picture at all")), Contains("not a readable PNG"));
}

TEST_CASE("pictures cut short or of hostile size end in a message") {
  const ScratchFolder folder;
  const auto whole =
      write_png(folder.path() / "w.png", 16, 16, 8, PNG_COLOR_TYPE_GRAY, std::vector<std::uint8_t>(256, 7));
  std::ifstream stream(whole, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t n = 0; n + 20 < bytes.size(); n += 5)  // the last bytes hold no pixel
    CHECK_THAT(fault_of_map(folder.write("cut.png", bytes.substr(0, n))), Contains("cut.png"));
  const auto huge = write_png(folder.path() / "huge.png", 5000, 4000, 8, PNG_COLOR_TYPE_GRAY,
                              std::vector<std::uint8_t>(20'000'000, 7));
  CHECK_THAT(fault_of_map(huge), Contains("5000 x 4000 samples is too large: at most 16777216"));
}

TEST_CASE("2D: a row of heights is a polyline, with exact distances") {
  const ScratchFolder folder;
  const auto file = folder.write("h.csv", "1, 2, 2\n");
  const auto below = make_shape<2>(map_spec(file, {0, 0, 0}, {2, 3, 0}, "y"), quarter);
  constexpr double rounding = 1e-13;
  CHECK((*below)(Vec<2>(1.5, 2.4)) == Approx(0.4).margin(rounding));
  CHECK((*below)(Vec<2>(0.5, 1.5)) == Approx(0).margin(rounding));
  CHECK((*below)(Vec<2>(0.25, 1.75)) == Approx(std::sqrt(0.125)).margin(rounding));  // 45 degrees
  CHECK((*below)(Vec<2>(0.75, 1.25)) == Approx(-std::sqrt(0.125)).margin(rounding));
  CHECK((*below)(Vec<2>(-3, 0)) == Approx(-1).margin(rounding));  // edges go on
  CHECK((*below)(Vec<2>(9, 2.5)) == Approx(0.5).margin(rounding));
  const auto hanging = make_shape<2>(map_spec(file, {0, 0, 0}, {2, 3, 0}, "-y"), quarter);
  CHECK((*hanging)(Vec<2>(1.5, 2.4)) == Approx(-0.4).margin(rounding));
  const auto sideways = make_shape<2>(map_spec(file, {0, 0, 0}, {3, 2, 0}, "x"), quarter);
  CHECK((*sideways)(Vec<2>(2.4, 1.5)) == Approx(0.4).margin(rounding));
  const auto two = folder.write("two.csv", "1, 2\n3, 4\n");
  CHECK_THROWS_WITH(make_shape<2>(map_spec(two, {0, 0, 0}, {2, 5, 0}, "y"), quarter),
                    Contains("a 2D scene takes one row of heights, not 2 rows"));
  CHECK_THROWS_WITH(make_shape<2>(map_spec(file, {0, 0, 0}, {2, 1.5, 0}, "y"), quarter),
                    Contains("scene.toml:14: ") && Contains("heights run from 1 to 2 m along y"));
}

// Each axis and sense: the picture as seen from above, with the first axis across to the right.
TEST_CASE("3D: pictures lie as seen from above") {
  const ScratchFolder folder;
  // Left column low, right column high; the top right corner is the highest.
  const auto file = write_png(folder.path() / "m.png", 2, 2, 8, PNG_COLOR_TYPE_GRAY, {0, 255, 0, 51});
  struct View {
    std::string up;
    Vec3 top_right;  // place of the highest sample
  };
  const std::vector<View> views{{"y", {4, 4, 0}},  {"z", {4, 4, 4}},  {"x", {4, 4, 4}},
                                {"-y", {4, 0, 4}}, {"-z", {4, 0, 0}}, {"-x", {0, 4, 0}}};
  for (const View& view : views) {
    const auto shape = make_shape<3>(map_spec(file, {0, 0, 0}, {4, 4, 4}, view.up), quarter);
    INFO(view.up);
    const int up = view.up.back() - 'x';
    const double sense = view.up[0] == '-' ? -1 : 1;
    Vec3 middle(2, 2, 2), inner = middle + 0.95 * (view.top_right - middle);
    inner[up] = 2;
    CHECK((*shape)(inner) < 0);  // under the peak
    const int second = up == 2 ? 1 : up == 1 ? 2 : 2;
    Vec3 mirrored = inner;
    mirrored[second] = 4 - mirrored[second];
    CHECK((*shape)(mirrored) > 0);
    Vec3 deep = middle;
    deep[up] = sense > 0 ? -2 : 6;
    CHECK((*shape)(deep) < 0);
  }
}

TEST_CASE("3D: a slope is a plane to a hundredth of a cell, fine maps and coarse ones") {
  const ScratchFolder folder;
  for (const int n : {2, 9, 100}) {  // one sample in 16 cells, two a cell, some 25 a cell
    std::string text;
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) text += std::to_string(1 + double(column) / (n - 1)) + " ";
      text += "\n";
    }
    const auto shape =
        make_shape<3>(map_spec(folder.write("s.csv", text), {0, 0, 0}, {4, 3, 4}, "y"), ShapeOptions{0.25, nullptr});
    const double steep = std::sqrt(1 + 1.0 / 16);
    for (const Vec3& x : {Vec3(2, 1.5, 1), Vec3(1.3, 1.7, 3.9), Vec3(3.01, 1.2, 2.2)})
      CHECK((*shape)(x) == Approx((x[1] - 1 - x[0] / 4) / steep).margin(0.0025));
  }
}

TEST_CASE("3D: beside a cliff the distance is that from the cliff") {
  const ScratchFolder folder;
  std::string text;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 401; ++column) text += column < 200 ? "3 " : "1 ";
    text += "\n";
  }
  const auto shape = make_shape<3>(map_spec(folder.write("c.csv", text), {0, 0, 0}, {4, 4, 4}, "y"), quarter);
  // Averaged over half a cell; the cliff stands at x = 1.995.
  CHECK((*shape)(Vec3(2.35, 2, 2)) == Approx(0.355).margin(0.06));
  CHECK((*shape)(Vec3(1.65, 2, 2)) == Approx(-0.345).margin(0.06));
}

}  // namespace height_maps_tests
