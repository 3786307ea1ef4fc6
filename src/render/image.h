#pragma once
// 8-bit images for files, and linear-light canvases to draw on.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace seiche::render {

using Vec3f = Eigen::Vector3f;
using Vec2f = Eigen::Vector2f;
using Polygon = std::vector<Vec2f>;

// 8 bits a channel, sRGB, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::uint8_t> alpha{};  // one a pixel, not multiplied into rgb; empty: opaque
};

// Linear light, rows from the top.
struct Canvas {
  int width = 0, height = 0;
  std::vector<Vec3f> pixels;
  std::vector<float> alpha{};  // one a pixel, multiplied into the light; empty: opaque

  Canvas() = default;
  Canvas(int w, int h, const Vec3f& color) : width(w), height(h), pixels(std::size_t(w) * h, color) {}
  Vec3f& at(int x, int y) { return pixels[std::size_t(y) * width + x]; }
  const Vec3f& at(int x, int y) const { return pixels[std::size_t(y) * width + x]; }
};

// Mixes the colour into the pixel with weight alpha; ignores pixels outside of the canvas.
void blend(Canvas& canvas, int x, int y, const Vec3f& color, float alpha);

// An anti-aliased line of the given width, in pixels, with a weight per pixel: fade(x, y, s), s in [0, 1] along the
// line.
template <class Fade>
void stroke(Canvas& canvas, const Vec2f& from, const Vec2f& to, float width, const Vec3f& color, const Fade& fade) {
  const Vec2f along = to - from;
  const float length2 = std::max(along.squaredNorm(), 1e-12f), reach = width / 2 + 1;
  const int x0 = std::max(0, int(std::floor(std::min(from.x(), to.x()) - reach)));
  const int x1 = std::min(canvas.width - 1, int(std::ceil(std::max(from.x(), to.x()) + reach)));
  const int y0 = std::max(0, int(std::floor(std::min(from.y(), to.y()) - reach)));
  const int y1 = std::min(canvas.height - 1, int(std::ceil(std::max(from.y(), to.y()) + reach)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vec2f p(float(x) + 0.5f, float(y) + 0.5f);
      const float s = std::clamp((p - from).dot(along) / length2, 0.0f, 1.0f);
      const float cover = std::clamp(width / 2 + 0.5f - (p - from - s * along).norm(), 0.0f, 1.0f);
      if (cover > 0) blend(canvas, x, y, color, cover * fade(x, y, s));
    }
  }
}

// sRGB encoding of linear light, and back. Light is clamped to [0, 1].
Image to_image(const Canvas& canvas);
Vec3f from_srgb(float r, float g, float b);
Vec3f to_srgb(const Vec3f& light);

// Averages blocks of pixels down to the given size (not larger than the image).
Image shrink(const Image& image, int width, int height);

}  // namespace seiche::render
