// Texts, lines and pages: what cairo draws for us.
#include <catch2/catch.hpp>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <pugixml.hpp>
#include <regex>

#include "base/error.h"
#include "render/font.h"
#include "render/outline.h"
#include "render/plot.h"

namespace painting_tests {
using namespace seiche;
using namespace seiche::render;

namespace {

const Vec3f black = Vec3f::Zero();

int count_ink(const Image& image) {
  int ink = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) ink += image.rgb[i] < 128;
  return ink;
}

Image print_text(const std::string& text, float size, int width, int height) {
  Painter painter(width, height, Format::png);
  painter.text(2, 0.9f * float(height), text, size, black);
  return painter.image();
}

// A unit square with a box of solid in the middle, and a disc of liquid.
Plot disc_and_box(int n) {
  Plot plot;
  plot.domain = {Vec3f::Zero(), Vec3f(2, 1, 1.0f / float(n))};
  plot.phi.cells = {2 * n, n, 1};
  plot.phi.h = 1.0f / float(n);
  for (int c = 0; c < 2 * n * n; ++c) {
    const Vec3f x((float(c % (2 * n)) + 0.5f) * plot.phi.h, (float(c / (2 * n)) + 0.5f) * plot.phi.h, 0);
    plot.phi.values.push_back(std::clamp((x - Vec3f(1.2f, 0.5f, 0)).norm() - 0.3f, -3 * plot.phi.h, 3 * plot.phi.h));
  }
  return plot;
}

void add_box(Plot& plot, const Vec3& lower, const Vec3& upper) {
  plot.solids.mesh.points = {lower, {upper[0], lower[1], 0}, upper, {lower[0], upper[1], 0}};
  plot.solids.mesh.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  plot.solids.solid = {0, 0, 0, 0};
  plot.colors = {Vec3f(0.5f, 0, 0)};
}

float area_of(const std::vector<Polygon>& polygons) {
  float sum = 0;
  for (const Polygon& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2f &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      sum += 0.5f * (a.x() * b.y() - a.y() * b.x());
    }
  return sum;
}

std::string page_of(const Plot& plot, Format format) {
  Painter painter(640, 360, format);
  draw_plot(painter, plot);
  return painter.page();
}

}  // namespace

TEST_CASE("letters, Greek, accents and superscripts print shapes of their own") {
  const std::vector<std::string> letters{"a", "A", "é", "ö", "µ", "ω", "Δ", "²", "³", "⁻", "¹", "°", "ρ", "·", "…"};
  std::vector<std::vector<std::uint8_t>> seen;
  for (const std::string& letter : letters) {
    INFO(letter);
    const Image image = print_text(letter, 24, 40, 40);
    CHECK(count_ink(image) > 0);
    for (const auto& other : seen) CHECK(other != image.rgb);  // none is the box of a missing glyph
    seen.push_back(image.rgb);
  }
}

TEST_CASE("texts grow with their size, and are as wide as they say, wherever they are anchored") {
  Painter painter(400, 80, Format::png);
  const std::string text = "speed (m s⁻¹)";
  const float width = painter.text_width(text, 20);
  CHECK(painter.text_width(text, 60) == Approx(3 * width).epsilon(1e-3));  // no hinting, so that widths scale
  CHECK(painter.text_width(text + text, 20) == Approx(2 * width).epsilon(1e-3));
  painter.text(300, 40, text, 20, black, Anchor::end);
  const Image image = painter.image();
  int left = 400, right = 0;
  for (int x = 0; x < 400; ++x)
    for (int y = 0; y < 80; ++y)
      if (image.rgb[3 * std::size_t(y * 400 + x)] < 128) left = std::min(left, x), right = std::max(right, x);
  CHECK(float(left) == Approx(300 - width).margin(4));  // a sign's own space beside it is below a fifth of its size
  CHECK(float(right) == Approx(300).margin(4));
  CHECK(text_size(3840, 2160) > 4 * text_size(480, 320));
  CHECK(text_size(160, 120) >= 9);
}

TEST_CASE("fonts that are not there are refused with what to do") {
  CHECK_THROWS_WITH(find_font("No Such Family"),
                    Catch::Contains("no font 'No Such Family'") && Catch::Contains("fonts-dejavu-core"));
  CHECK_THROWS_WITH(find_font("/no/such/file.ttf"), Catch::Contains("is not a font file"));
  CHECK(find_font("").file == find_font(find_font("").file.string()).file);
}

TEST_CASE("a disc of liquid covers its area of the plot, to a fraction of a pixel") {
  const Plot plot = disc_and_box(50);
  const float exact = float(M_PI) * 0.09f;
  // cubic pieces have an error of order h^4; chords of h/3 lack (h/3)^2/(6 R^2) = 8e-5 of the area
  CHECK(area_of(liquid_outlines(plot.phi)) == Approx(exact).epsilon(5e-4));
  Painter painter(640, 360, Format::png);
  const auto [x0, y0, x1, y1] = plot_rectangle(painter, plot);
  draw_plot(painter, plot);
  const Image image = painter.image();
  double covered = 0;
  const float blue = to_srgb(plot.liquid)[0];
  for (int y = int(y0) + 2; y < int(y1) - 2; ++y)
    for (int x = int(x0) + 2; x < int(x1) - 2; ++x)
      covered += (1 - image.rgb[3 * std::size_t(y * 640 + x)] / 255.0) / (1 - blue);
  const double pixel = 2.0 / (x1 - x0);
  CHECK(covered * pixel * pixel == Approx(exact).epsilon(0.003));  // colours are rounded to 1/255 of the disc's
}

TEST_CASE("in SVG the corners of a solid stand where they are, and the file is well-formed") {
  Plot plot = disc_and_box(20);
  const Vec3 lower(0.2123, 0.3, 0), upper(0.5, 0.7071, 0);
  add_box(plot, lower, upper);
  plot.quantity = plot.phi;
  plot.scale = {-0.1f, 0.1f, "φ (m)", &color_map("viridis")};
  const std::string page = page_of(plot, Format::svg);
  pugi::xml_document document;
  REQUIRE(document.load_string(page.c_str()));
  const pugi::xml_node svg = document.child("svg");
  CHECK(std::string(svg.attribute("viewBox").value()) == "0 0 640 360");
  CHECK(document.select_node("//*[local-name()='image']"));  // the colours
  const Painter painter(640, 360, Format::png);
  const auto [x0, y0, x1, y1] = plot_rectangle(painter, plot);
  const double scale = (x1 - x0) / 2;
  const double left = x0 + lower[0] * scale, right = x0 + upper[0] * scale;
  const double below = y1 - lower[1] * scale, above = y1 - upper[1] * scale;
  bool found = false;
  for (const auto& node : document.select_nodes("//*[local-name()='path']")) {
    const std::string path = node.node().attribute("d").value();
    const std::regex corners(R"(M (\S+) (\S+) L (\S+) (\S+) L (\S+) (\S+) L (\S+) (\S+) Z.*)");
    std::smatch match;
    if (!std::regex_match(path, match, corners)) continue;
    const auto near = [&](int n, double value) { return std::abs(std::stod(match[n]) - value) < 0.005; };  // 1/256 px
    found = found || (near(1, left) && near(2, below) && near(3, right) && near(4, below) && near(5, right) &&
                      near(6, above) && near(7, left) && near(8, above));
  }
  CHECK(found);
}

TEST_CASE("a page of PDF has fonts and no picture where nothing is coloured") {
  const std::string page = page_of(disc_and_box(20), Format::pdf);
  CHECK(page.starts_with("%PDF-1."));
  CHECK(page.find("/Font") != std::string::npos);
  CHECK(page.find("/Subtype /Image") == std::string::npos);
}

TEST_CASE("what stands beside a plot is within the picture and apart, at any size") {
  Plot plot = disc_and_box(20);
  plot.quantity = plot.phi;
  for (const auto& [width, height] : {std::pair{160, 120}, {320, 240}, {480, 320}, {640, 360}, {3840, 2160}}) {
    const Painter painter(width, height, Format::png);
    const auto [x0, y0, x1, y1] = plot_rectangle(painter, plot);
    const float size = text_size(width, height);
    INFO(width << "x" << height);
    // at the left numbers and, read upwards, the title; at the right the bar with numbers and its label
    CHECK(x0 > painter.text_width("0.0", size) + 2 * size);
    CHECK(float(width) - x1 > painter.text_width("0.00", size) + 3 * size);
    CHECK(y0 > 2 * size);  // the label
    CHECK(float(height) - y1 > 2.5f * size);
    CHECK(x1 > x0);
    CHECK(y1 > y0);
  }
  plot.plain = true;
  CHECK(plot_rectangle(Painter(640, 320, Format::png), plot) == std::array<float, 4>{0, 0, 640, 320});
}

TEST_CASE("colour maps have the published colours at their ends") {
  const auto shows = [](const std::string& name, float t, int r, int g, int b) {
    const Vec3f color = 255 * to_srgb(color_map(name).at(t));
    return std::lround(color[0]) == r && std::lround(color[1]) == g && std::lround(color[2]) == b;
  };
  CHECK(shows("viridis", 0, 0x44, 0x01, 0x54));
  CHECK(shows("viridis", 1, 0xfd, 0xe7, 0x25));
  CHECK(shows("magma", 1, 0xfc, 0xfd, 0xbf));
  CHECK(shows("inferno", 0, 0x00, 0x00, 0x04));
  CHECK(shows("plasma", 1, 0xf0, 0xf9, 0x21));
  CHECK(shows("cividis", 0, 0x00, 0x22, 0x4e));
  CHECK(shows("turbo", 1, 0x7a, 0x04, 0x03));
  CHECK(shows("coolwarm", 0, 59, 76, 192));
  CHECK(shows("coolwarm", 1, 180, 4, 38));
  CHECK(shows("gray", 0.2f, 51, 51, 51));
  CHECK_THROWS_WITH(color_map("virdis"), Catch::Contains("did you mean 'viridis'"));
  for (const std::string name : {"viridis", "magma", "plasma", "inferno", "cividis", "gray"}) {
    float before = -1;
    for (int i = 0; i <= 255; ++i) {
      const Vec3f& c = color_map(name).colors[std::size_t(i)];
      const float luminance = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
      INFO(name << " " << i);
      CHECK(luminance > before - 1e-3f);  // 8 bits round a step of some channels back
      before = luminance;
    }
    CHECK(color_map(name).at(-3) == color_map(name).at(0));
    CHECK(color_map(name).at(7) == color_map(name).at(1));
    CHECK(color_map(name).at(NAN) == color_map(name).at(0));
  }
}

}  // namespace painting_tests
