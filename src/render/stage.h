#pragma once
// Contents of a 3D picture: liquid, solids, ground and light, and their appearance.
#include <memory>
#include <optional>

#include "render/bvh.h"
#include "render/color.h"
#include "render/liquid_look.h"
#include "render/volume.h"

namespace seiche::render {

// Light on the ground: factors on a rectangular map, 1 outside.
struct GroundShadow {
  int size = 0;
  Vec3f lower{0, 0, 0};  // of the rectangle
  float extent = 1;      // of both sides, m
  std::vector<Vec3f> light;
};

struct Stage {
  Box domain;
  int up_axis = 1;
  std::unique_ptr<LiquidSurface> liquid;  // empty: no liquid
  LiquidLook look;
  std::optional<ScalarVolume> foam;      // share of foam, 0 to 1
  std::optional<ScalarVolume> quantity;  // for false colours
  ColorScale scale;
  Bvh solids;
  std::vector<char> containers;  // by solid: not drawn from outside
  std::vector<Vec3f> colors;     // by solid
  float ground = 0;              // its height along the up axis
  float reach = 1;               // diagonal of the domain, m
  Vec3f to_light{0, 1, 0};
  GroundShadow shadow;
  bool transparent = false;  // ground and sky are not drawn, but shadows and what liquid mirrors of them

  Vec3f up() const { return Vec3f::Unit(up_axis); }
};

// Sets ground, light and reach from the domain and computes the shadow on the ground. Call it after liquid and solids
// are set.
void light_stage(Stage& stage, const Vec3f& toward_eye);

// The nearest opaque thing along a ray.
struct OpaqueHit {
  enum class Kind { sky, ground, solid } kind = Kind::sky;
  float t = 1e30f;
  Vec3f normal{0, 1, 0};  // towards the ray's origin
  int solid = 0;
};
OpaqueHit find_opaque(const Stage& stage, const Ray& ray, float t0);

// Linear light from the hit; from a matt white surface at x.
Vec3f shade_opaque(const Stage& stage, const Ray& ray, const OpaqueHit& hit);
Vec3f light_on_surface(const Stage& stage, const Vec3f& x, const Vec3f& normal);
Vec3f sky(const Stage& stage, const Vec3f& direction);

// Share of the key light that reaches x past the solids.
float sun_at(const Stage& stage, const Vec3f& x);

// Share of its light that the ground at x lacks in the shadow, 0 to 1.
float shadow_on_ground(const Stage& stage, const Vec3f& x);

// Transmitted share of light after a path of this length in the liquid, by channel (Beer-Lambert).
Vec3f transmitted(const Stage& stage, float length);

}  // namespace seiche::render
