#include "render/image.h"

namespace seiche::render {
namespace {

// The sRGB transfer functions (IEC 61966-2-1).
float encode_srgb(float v) {
  v = std::clamp(v, 0.0f, 1.0f);
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

float decode_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

// Table of 4096 steps of sqrt(v), which is nearly uniform in sRGB; accurate enough for 8 bits.
std::array<std::uint8_t, 4097> srgb_table() {
  std::array<std::uint8_t, 4097> table{};
  for (int i = 0; i <= 4096; ++i) {
    const float root = float(i) / 4096;
    table[i] = std::uint8_t(std::lround(255 * encode_srgb(root * root)));
  }
  return table;
}

}  // namespace

void blend(Canvas& canvas, int x, int y, const Vec3f& color, float alpha) {
  if (x < 0 || y < 0 || x >= canvas.width || y >= canvas.height) return;
  Vec3f& pixel = canvas.at(x, y);
  pixel += alpha * (color - pixel);
  if (canvas.alpha.empty()) return;
  float& cover = canvas.alpha[std::size_t(y) * canvas.width + x];
  cover += alpha * (1 - cover);
}

Image to_image(const Canvas& canvas) {
  static const std::array<std::uint8_t, 4097> table = srgb_table();
  Image image{canvas.width, canvas.height, {}};
  image.rgb.reserve(canvas.pixels.size() * 3);
  for (std::size_t i = 0; i < canvas.pixels.size(); ++i) {
    const float alpha = canvas.alpha.empty() ? 1.0f : canvas.alpha[i];
    const Vec3f light = alpha > 0 ? Vec3f(canvas.pixels[i] / alpha) : Vec3f(Vec3f::Zero());
    for (int c = 0; c < 3; ++c) {
      const float root = std::sqrt(std::clamp(light[c], 0.0f, 1.0f));
      image.rgb.push_back(table[std::size_t(root * 4096 + 0.5f)]);
    }
    if (!canvas.alpha.empty()) image.alpha.push_back(std::uint8_t(std::lround(255 * std::clamp(alpha, 0.0f, 1.0f))));
  }
  return image;
}

Vec3f from_srgb(float r, float g, float b) {
  return {decode_srgb(r), decode_srgb(g), decode_srgb(b)};
}

Vec3f to_srgb(const Vec3f& light) {
  return {encode_srgb(light[0]), encode_srgb(light[1]), encode_srgb(light[2])};
}

Image shrink(const Image& image, int width, int height) {
  Image small{width, height, std::vector<std::uint8_t>(std::size_t(width) * height * 3)};
  for (int y = 0; y < height; ++y) {
    const int y0 = y * image.height / height, y1 = std::max(y0 + 1, (y + 1) * image.height / height);
    for (int x = 0; x < width; ++x) {
      const int x0 = x * image.width / width, x1 = std::max(x0 + 1, (x + 1) * image.width / width);
      std::array<int, 3> sum{0, 0, 0};
      for (int k = 0; k < (y1 - y0) * (x1 - x0); ++k) {
        const std::size_t from = std::size_t(y0 + k / (x1 - x0)) * image.width + x0 + k % (x1 - x0);
        for (int c = 0; c < 3; ++c) sum[c] += image.rgb[3 * from + c];
      }
      for (int c = 0; c < 3; ++c) {
        small.rgb[3 * (std::size_t(y) * width + x) + c] = std::uint8_t(sum[c] / ((y1 - y0) * (x1 - x0)));
      }
    }
  }
  return small;
}

}  // namespace seiche::render
