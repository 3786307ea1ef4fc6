#include "render/palette.h"

#include "base/solid_spec.h"

namespace seiche::render {
namespace {

// Distinct from the blue of the water, and from their neighbours in hue or lightness.
Vec3f body_color(std::size_t n) {
  static const std::array<Vec3f, 8> colors{
      Vec3f{0.85f, 0.52f, 0.04f}, Vec3f{0.72f, 0.20f, 0.03f}, Vec3f{0.55f, 0.05f, 0.06f}, Vec3f{0.30f, 0.15f, 0.06f},
      Vec3f{0.12f, 0.33f, 0.08f}, Vec3f{0.26f, 0.11f, 0.40f}, Vec3f{0.78f, 0.73f, 0.62f}, Vec3f{0.75f, 0.25f, 0.32f}};
  return colors[n % colors.size()];
}

}  // namespace

std::vector<Vec3f> solid_colors(const std::vector<SolidSpec>& solids) {
  std::vector<Vec3f> colors;
  std::size_t bodies = 0;
  for (const SolidSpec& solid : solids) {
    if (solid.kind.is_free())
      colors.push_back(body_color(bodies++));
    else
      colors.push_back(Vec3f::Constant(solid.kind.moves() ? 0.28f : 0.52f));
  }
  return colors;
}

Vec3f solid_color(const std::vector<Vec3f>& colors, int solid) {
  const auto n = std::size_t(solid);
  return n < colors.size() ? colors[n] : body_color(n);
}

}  // namespace seiche::render
