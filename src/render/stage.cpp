#include "render/stage.h"

#include <cmath>

#include "base/parallel_range.h"
#include "render/palette.h"

namespace seiche::render {
namespace {

const Vec3f sun_color{1.0f, 0.96f, 0.88f};

// Colour of the horizon.
const Vec3f haze{0.80f, 0.85f, 0.90f};

bool is_container(const Stage& stage, int solid) {
  return std::size_t(solid) < stage.containers.size() && stage.containers[solid];
}

// True if a solid other than a container blocks the ray.
bool is_blocked(const Stage& stage, const Ray& ray, float t) {
  if (!stage.solids.any(ray, t, 1e30f)) return false;
  Hit hit = stage.solids.closest(ray, t, 1e30f);
  while (hit.t >= 0 && is_container(stage, stage.solids.triangle(hit.triangle).solid)) {
    hit = stage.solids.closest(ray, hit.t + 1e-5f * stage.reach, 1e30f);
  }
  return hit.t >= 0;
}

// Light that reaches a point of the ground: none behind solids, tinted behind liquid.
Vec3f ground_light(const Stage& stage, const Vec3f& x) {
  const Ray ray{x, stage.to_light};
  if (is_blocked(stage, ray, 1e-4f * stage.reach)) return Vec3f::Zero();
  const Span span = clip(ray, stage.domain);
  if (!stage.liquid || !span.hits()) return Vec3f::Ones();
  float path = 0, t = span.t0;
  bool inside = stage.liquid->inside(ray.at(t));
  for (int crossings = 0; crossings < 8 && t < span.t1; ++crossings) {
    float next = stage.liquid->first_crossing(ray, t, span.t1);
    if (next < 0) next = span.t1;
    if (inside) path += next - t;
    t = next + 1e-2f * stage.liquid->phi().h;
    inside = !inside;
  }
  if (path > 0 && stage.look.is_opaque()) return Vec3f::Zero();
  return path > 0 ? Vec3f(0.82f * transmitted(stage, 0.7f * path)) : Vec3f::Ones();
}

// Three passes of a 3-point box filter along each side: soft shadow edges.
void soften(GroundShadow& shadow) {
  const int n = shadow.size;
  for (int pass = 0; pass < 6; ++pass) {
    const int stride = pass % 2 == 0 ? 1 : n;
    std::vector<Vec3f> soft = shadow.light;
    for (int k = 0; k < n * n; ++k) {
      const int along = stride == 1 ? k % n : k / n;
      if (along == 0 || along == n - 1) continue;
      soft[k] = (shadow.light[k - stride] + shadow.light[k] + shadow.light[k + stride]) / 3;
    }
    shadow.light.swap(soft);
  }
}

void measure_shadow(Stage& stage) {
  GroundShadow& shadow = stage.shadow;
  const int a = (stage.up_axis + 1) % 3, b = (stage.up_axis + 2) % 3;
  shadow.size = 240;
  shadow.extent = 3 * stage.reach;
  shadow.lower = stage.domain.center() - Vec3f::Constant(shadow.extent / 2);
  shadow.lower[stage.up_axis] = stage.ground;
  shadow.light.resize(std::size_t(shadow.size) * shadow.size);
  parallel_range(0, shadow.size, [&](int row) {
    for (int column = 0; column < shadow.size; ++column) {
      Vec3f x = shadow.lower;
      x[a] += (float(column) + 0.5f) * shadow.extent / float(shadow.size);
      x[b] += (float(row) + 0.5f) * shadow.extent / float(shadow.size);
      shadow.light[std::size_t(row) * shadow.size + column] = ground_light(stage, x);
    }
  });
  soften(shadow);
}

Vec3f light_on_ground(const Stage& stage, const Vec3f& x) {
  const GroundShadow& shadow = stage.shadow;
  const int a = (stage.up_axis + 1) % 3, b = (stage.up_axis + 2) % 3, n = shadow.size;
  const float u = (x[a] - shadow.lower[a]) / shadow.extent * float(n) - 0.5f;
  const float v = (x[b] - shadow.lower[b]) / shadow.extent * float(n) - 0.5f;
  if (!(u >= 0 && v >= 0 && u < float(n - 1) && v < float(n - 1))) return Vec3f::Ones();
  const int i = int(u), j = int(v);
  const float p = u - float(i), q = v - float(j);
  const Vec3f* low = &shadow.light[std::size_t(j) * n + i];
  return (1 - q) * ((1 - p) * low[0] + p * low[1]) + q * ((1 - p) * low[n] + p * low[n + 1]);
}

// Soft tile pattern, finer near the eye; its mean beyond the tiles' reach.
float tiles(const Stage& stage, const Vec3f& x, float t) {
  const int a = (stage.up_axis + 1) % 3, b = (stage.up_axis + 2) % 3;
  const float side = stage.reach / 10;
  const float wave_a = std::sin(3.14159265f * (x[a] - stage.domain.lower[a]) / side);
  const float wave_b = std::sin(3.14159265f * (x[b] - stage.domain.lower[b]) / side);
  const float edge = 4 + 30 * stage.reach / (stage.reach + t);
  const float tile = std::clamp(edge * wave_a, -1.0f, 1.0f) * std::clamp(edge * wave_b, -1.0f, 1.0f);
  return tile * std::exp(-t * t / (60 * stage.reach * stage.reach));
}

Vec3f shade_ground(const Stage& stage, const Ray& ray, const OpaqueHit& hit) {
  const Vec3f x = ray.at(hit.t);
  const Vec3f albedo = Vec3f(0.44f, 0.44f, 0.43f) * (1 + 0.055f * tiles(stage, x, hit.t));
  const Vec3f light = 0.40f * haze + 0.85f * sun_color.cwiseProduct(light_on_ground(stage, x));
  const float distance = (x - stage.domain.center()).norm() / stage.reach;
  const float fade = 1 - std::exp(-0.018f * distance * distance);
  return albedo.cwiseProduct(light) * (1 - fade) + haze * fade;
}

}  // namespace

void light_stage(Stage& stage, const Vec3f& toward_eye) {
  stage.reach = stage.domain.size().norm();
  stage.ground = stage.domain.lower[stage.up_axis] - 2e-3f * stage.reach;
  Vec3f level = toward_eye - toward_eye.dot(stage.up()) * stage.up();
  if (level.norm() < 1e-3f) level = Vec3f::Unit((stage.up_axis + 1) % 3);
  level.normalize();
  const Vec3f side = stage.up().cross(level);
  stage.to_light = (1.5f * stage.up() + 0.2f * level - 0.9f * side).normalized();
  measure_shadow(stage);
}

Vec3f sky(const Stage& stage, const Vec3f& direction) {
  const float height = direction[stage.up_axis];
  const Vec3f zenith(0.22f, 0.42f, 0.72f);
  const float rise = std::sqrt(std::max(0.0f, height));
  const float sun = std::max(0.0f, direction.dot(stage.to_light));
  const float sun8 = std::pow(sun, 8.0f), disc = std::pow(sun8, 60.0f);
  return haze + rise * (zenith - haze) + (0.25f * sun8 + 9.0f * disc) * sun_color;
}

OpaqueHit find_opaque(const Stage& stage, const Ray& ray, float t0) {
  OpaqueHit found;
  const float fall = ray.direction[stage.up_axis];
  const float t = (stage.ground - ray.origin[stage.up_axis]) / fall;
  if (fall < 0 && t > t0) found = {OpaqueHit::Kind::ground, t, stage.up(), 0};
  Hit hit = stage.solids.closest(ray, t0, found.t);
  while (hit.t >= 0) {
    const Triangle& triangle = stage.solids.triangle(hit.triangle);
    const bool behind = triangle.edge1.cross(triangle.edge2).dot(ray.direction) > 0;
    if (behind && is_container(stage, triangle.solid)) {
      hit = stage.solids.closest(ray, hit.t + 1e-5f * stage.reach, found.t);
      continue;
    }
    const auto& n = triangle.normals;
    Vec3f normal = ((1 - hit.u - hit.v) * n[0] + hit.u * n[1] + hit.v * n[2]).normalized();
    if (normal.dot(ray.direction) > 0) normal = -normal;
    return {OpaqueHit::Kind::solid, hit.t, normal, triangle.solid};
  }
  return found;
}

float sun_at(const Stage& stage, const Vec3f& x) {
  return is_blocked(stage, {x, stage.to_light}, 2e-3f * stage.reach) ? 0.0f : 1.0f;
}

Vec3f light_on_surface(const Stage& stage, const Vec3f& x, const Vec3f& normal) {
  const float facing = std::max(0.0f, normal.dot(stage.to_light));
  const float sun = facing > 0 ? facing * sun_at(stage, x + 1e-4f * stage.reach * normal) : 0.0f;
  const float open = 0.5f + 0.5f * normal[stage.up_axis];
  const float height = std::clamp((x[stage.up_axis] - stage.ground) / (0.25f * stage.reach), 0.0f, 1.0f);
  const Vec3f from_sky(0.85f, 0.95f, 1.1f), from_ground(0.62f, 0.6f, 0.56f);
  const Vec3f ambient = (0.24f + 0.10f * height) * (open * from_sky + (1 - open) * from_ground);
  return ambient + 0.95f * sun * sun_color;
}

Vec3f shade_opaque(const Stage& stage, const Ray& ray, const OpaqueHit& hit) {
  if (hit.kind == OpaqueHit::Kind::sky) return sky(stage, ray.direction);
  if (hit.kind == OpaqueHit::Kind::ground) return shade_ground(stage, ray, hit);
  return solid_color(stage.colors, hit.solid).cwiseProduct(light_on_surface(stage, ray.at(hit.t), hit.normal));
}

float shadow_on_ground(const Stage& stage, const Vec3f& x) {
  const Vec3f all = 0.40f * haze + 0.85f * sun_color;
  const Vec3f lit = 0.40f * haze + 0.85f * sun_color.cwiseProduct(light_on_ground(stage, x));
  return std::clamp(1 - lit.sum() / all.sum(), 0.0f, 1.0f);
}

Vec3f transmitted(const Stage& stage, float length) {
  return (-stage.look.absorption * (length / stage.reach)).array().exp();
}

}  // namespace seiche::render
