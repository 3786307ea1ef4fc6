#include "render/trace.h"

#include <cmath>

#include "base/parallel_range.h"

namespace seiche::render {
namespace {

// Light along a ray, multiplied by alpha: the share of what stands behind the picture that it covers.
struct Light {
  Vec3f rgb{0, 0, 0};
  float alpha = 1;
};

Light mix(const Light& a, const Light& b, float share) {
  return {a.rgb + share * (b.rgb - a.rgb), a.alpha + share * (b.alpha - a.alpha)};
}

// Result of one ray: light, distance of the first object, and which one (edges between objects are anti-aliased).
struct Sample {
  Light light;
  float t = 1e30f;
  int thing = 0;
};

Vec3f reflect(const Vec3f& d, const Vec3f& n) {
  return d - 2 * d.dot(n) * n;
}

// Snell's law for a ray d at the normal n; eta = index before / index behind. False for total reflection.
bool refract(const Vec3f& d, const Vec3f& n, float eta, Vec3f& out) {
  const float cosine = -d.dot(n), k = 1 - eta * eta * (1 - cosine * cosine);
  if (k < 0) return false;
  out = (eta * d + (eta * cosine - std::sqrt(k)) * n).normalized();
  return true;
}

// Schlick's approximation.
float fresnel(const Stage& stage, float cosine) {
  const float root = (stage.look.index - 1) / (stage.look.index + 1), least = root * root;
  return least + (1 - least) * std::pow(1 - std::clamp(cosine, 0.0f, 1.0f), 5.0f);
}

// Light that mirrors show: that of the opaque surroundings.
Vec3f outside(const Stage& stage, const Ray& ray) {
  return shade_opaque(stage, ray, find_opaque(stage, ray, 1e-4f * stage.reach));
}

// Light seen directly or through liquid: without ground and sky on a transparent stage, but with their shadows.
Light seen_at(const Stage& stage, const Ray& ray, const OpaqueHit& hit) {
  if (!stage.transparent || hit.kind == OpaqueHit::Kind::solid) return {shade_opaque(stage, ray, hit), 1};
  const bool ground = hit.kind == OpaqueHit::Kind::ground;
  return {Vec3f::Zero(), ground ? shadow_on_ground(stage, ray.at(hit.t)) : 0.0f};
}

Light seen_outside(const Stage& stage, const Ray& ray) {
  return seen_at(stage, ray, find_opaque(stage, ray, 1e-4f * stage.reach));
}

Sample trace(const Stage& stage, const Ray& ray, int depth);

// Light that the liquid itself scatters towards the eye.
Vec3f scattered(const Stage& stage, const Vec3f& x) {
  const float height = (x[stage.up_axis] - stage.ground) / stage.domain.size()[stage.up_axis];
  return stage.look.glow * (0.8f + 0.9f * std::clamp(height, 0.0f, 1.0f));
}

// Light that comes through liquid: tinted, with what the liquid scatters in front of it.
Light behind_liquid(const Light& behind, const Vec3f& left, const Vec3f& glow) {
  return {left.cwiseProduct(behind.rgb) + glow, 1 - left.mean() * (1 - behind.alpha)};
}

// Light along a ray that starts in the liquid.
Light through_liquid(const Stage& stage, const Ray& ray, int depth) {
  const float h = stage.liquid->phi().h;
  const Span span = clip(ray, stage.domain);
  const OpaqueHit opaque = find_opaque(stage, ray, 1e-3f * h);
  float leave = stage.liquid->first_crossing(ray, 0.02f * h, span.t1);
  const bool through_wall = leave < 0;
  if (through_wall) leave = std::max(span.t1, 0.0f);
  const float path = std::min(leave, opaque.t);
  const float film = depth == 0 ? 0.03f * stage.reach : 0.0f;  // least tint, so that thin sheets are visible
  const Vec3f left = transmitted(stage, path + film);
  const Vec3f glow = (Vec3f::Ones() - left).cwiseProduct(scattered(stage, ray.at(0.5f * path)));
  if (opaque.t <= leave) return behind_liquid(seen_at(stage, ray, opaque), left, glow);
  const Vec3f x = ray.at(leave);
  Vec3f direction = ray.direction;  // walls do not refract, so objects behind them stay recognisable
  if (!through_wall && !refract(ray.direction, -stage.liquid->normal(x), stage.look.index, direction)) {
    const Vec3f mirrored = reflect(ray.direction, stage.liquid->normal(x)).normalized();
    const Light beyond = depth < 3 ? through_liquid(stage, {x + 0.02f * h * mirrored, mirrored}, depth + 1)
                                   : Light{scattered(stage, x), 1};
    return behind_liquid(beyond, left, glow);
  }
  const Ray onward{x + 0.05f * h * direction, direction};
  const bool goes_on = depth < 3 && !through_wall;
  return behind_liquid(goes_on ? trace(stage, onward, depth + 1).light : seen_outside(stage, onward), left, glow);
}

// First liquid along the ray before `limit`: at its surface or at a wall that it touches. Negative t: none.
struct LiquidHit {
  float t = -1;
  Vec3f normal{0, 1, 0};
  bool at_wall = false, eye_inside = false;
};

Light shade_clear(const Stage& stage, const Vec3f& x, const LiquidHit& hit, const Vec3f& direction, int depth) {
  const Vec3f& normal = hit.normal;
  const float dullness = hit.at_wall ? 0.35f : 1.0f;  // reduced mirroring at walls, so that the inside is visible
  const float mirror = dullness * fresnel(stage, -direction.dot(normal));
  Vec3f inward = direction;
  refract(direction, normal, 1 / stage.look.index, inward);
  const Light seen = through_liquid(stage, {x, inward}, depth);
  const Vec3f mirrored = outside(stage, {x + 1e-3f * stage.reach * normal, reflect(direction, normal)});
  return mix(seen, {mirrored, 1}, mirror);
}

// Metals mirror; milk and blood are matt below a clear skin.
Light shade_opaque_liquid(const Stage& stage, const Vec3f& x, const Vec3f& normal, const Vec3f& direction) {
  const float edge = fresnel(stage, -direction.dot(normal));
  const Vec3f mirrored = outside(stage, {x + 1e-3f * stage.reach * normal, reflect(direction, normal)});
  const Vec3f& metal = stage.look.metal;
  if (metal.maxCoeff() > 0) return {mirrored.cwiseProduct(metal + edge * (Vec3f::Ones() - metal)), 1};
  const Vec3f matt = stage.look.albedo.cwiseProduct(light_on_surface(stage, x, normal));
  return mix({matt, 1}, {mirrored, 1}, edge);
}

Light shade_surface(const Stage& stage, const Vec3f& x, const LiquidHit& hit, const Vec3f& direction, int depth) {
  const Light own = stage.look.is_opaque() ? shade_opaque_liquid(stage, x, hit.normal, direction)
                                           : shade_clear(stage, x, hit, direction, depth);
  const float foam = stage.foam && !hit.at_wall ? stage.foam->sample(x) : 0.0f;
  if (foam <= 0) return own;
  return mix(own, {0.92f * light_on_surface(stage, x, hit.normal), 1}, std::min(foam, 1.0f));
}

Vec3f shade_false_color(const Stage& stage, const Vec3f& x, const Vec3f& normal, const Vec3f& direction) {
  const Vec3f within = x - 0.5f * stage.quantity->h * normal;
  const Vec3f albedo = color_of(stage.scale, stage.quantity->sample(within));
  const float facing = std::max(0.0f, normal.dot(stage.to_light));
  const float sun = facing > 0 ? facing * sun_at(stage, x) : 0;
  const float open = 0.5f + 0.5f * normal[stage.up_axis];
  const Vec3f base = albedo * (0.35f + 0.2f * open + 0.55f * sun);
  const Vec3f mirrored = sky(stage, reflect(direction, normal));
  return base + 0.4f * fresnel(stage, -direction.dot(normal)) * (mirrored - base);
}

LiquidHit find_liquid(const Stage& stage, const Ray& ray, float limit) {
  const Span span = clip(ray, stage.domain);
  limit = std::min(limit, span.t1);
  if (!stage.liquid || !span.hits() || span.t0 >= limit) return {};
  const float start = span.t0 + 1e-4f * stage.liquid->phi().h;
  if (stage.liquid->inside(ray.at(start))) {
    const Vec3f wall = (ray.direction[span.enter_axis] > 0 ? -1.0f : 1.0f) * Vec3f::Unit(span.enter_axis);
    return {start, wall, true, span.t0 == 0};
  }
  const float t = stage.liquid->first_crossing(ray, start, limit);
  return t < 0 ? LiquidHit{} : LiquidHit{t, stage.liquid->normal(ray.at(t)), false, false};
}

Sample trace(const Stage& stage, const Ray& ray, int depth) {
  const OpaqueHit opaque = find_opaque(stage, ray, 0);
  // where solid and liquid touch the same wall, the solid is shown
  const float limit = stage.liquid ? opaque.t - 0.05f * stage.liquid->phi().h : opaque.t;
  const LiquidHit liquid = find_liquid(stage, ray, limit);
  if (liquid.t < 0) {
    return {seen_at(stage, ray, opaque), opaque.t, int(opaque.kind) + opaque.solid};
  }
  const Vec3f x = ray.at(liquid.t);
  if (liquid.eye_inside) return {through_liquid(stage, {x, ray.direction}, depth), liquid.t, -1};
  if (stage.quantity) return {{shade_false_color(stage, x, liquid.normal, ray.direction), 1}, liquid.t, -1};
  return {shade_surface(stage, x, liquid, ray.direction, depth), liquid.t, -1};
}

// Compresses highlights: light above 0.8 approaches 1 smoothly.
Light expose(const Light& light) {
  return {light.rgb.unaryExpr([](float v) { return v < 0.8f ? v : 0.8f + 0.2f * (v - 0.8f) / (v - 0.8f + 0.2f); }),
          light.alpha};
}

// True if a neighbour of the pixel shows another object or clearly different light.
bool is_rough(const std::vector<Sample>& samples, const Camera& camera, int x, int y) {
  const Sample& here = samples[std::size_t(y) * camera.width + x];
  const int x1 = std::min(x + 1, camera.width - 1), y1 = std::min(y + 1, camera.height - 1);
  for (const int other : {y * camera.width + x1, y1 * camera.width + x, y * camera.width + std::max(0, x - 1),
                          std::max(0, y - 1) * camera.width + x}) {
    const Sample& there = samples[std::size_t(other)];
    if (there.thing != here.thing || (there.light.rgb - here.light.rgb).cwiseAbs().maxCoeff() > 0.06f) return true;
    if (std::abs(there.light.alpha - here.light.alpha) > 0.06f) return true;
  }
  return false;
}

Light light_along(const Stage& stage, const Camera& camera, const TraceStyle& style, float u, float v) {
  const Light light = trace(stage, camera.ray(u, v), 0).light;
  return style.expose ? expose(light) : light;
}

Light four_rays(const Stage& stage, const Camera& camera, const TraceStyle& style, int x, int y) {
  Light sum{Vec3f::Zero(), 0};
  for (int k = 0; k < 4; ++k) {
    const float u = float(x) + 0.25f + 0.5f * float(k & 1), v = float(y) + 0.25f + 0.5f * float(k >> 1);
    const Light light = light_along(stage, camera, style, u, v);
    sum.rgb += 0.25f * light.rgb, sum.alpha += 0.25f * light.alpha;
  }
  return sum;
}

// Draws the twelve edges of the domain, faint behind objects.
void draw_domain(Canvas& canvas, const Stage& stage, const Camera& camera, const std::vector<Sample>& samples) {
  for (int edge = 0; edge < 12; ++edge) {
    const int axis = edge / 4, a = (axis + 1) % 3, b = (axis + 2) % 3;
    Vec3f from = stage.domain.lower;
    if (edge & 1) from[a] = stage.domain.upper[a];
    if (edge & 2) from[b] = stage.domain.upper[b];
    Vec3f to = from;
    to[axis] = stage.domain.upper[axis];
    const Vec3f p = camera.project(from), q = camera.project(to);
    if (p[2] <= 0 || q[2] <= 0) continue;
    const auto fade = [&](int x, int y, float s) {
      const float depth = 1 / ((1 - s) / p[2] + s / q[2]);  // linear in 1/depth along the line on the picture
      const Ray ray = camera.ray(float(x) + 0.5f, float(y) + 0.5f);
      const float seen = samples[std::size_t(y) * canvas.width + x].t * ray.direction.dot(camera.forward);
      return seen > depth * 0.995f ? 0.45f : 0.07f;
    };
    stroke(canvas, p.head<2>(), q.head<2>(), 1.2f * float(canvas.height) / 720, {0.12f, 0.14f, 0.18f}, fade);
  }
}

}  // namespace

Canvas trace_picture(const Stage& stage, const Camera& camera, const TraceStyle& style) {
  std::vector<Sample> samples(std::size_t(camera.width) * camera.height);
  parallel_range(0, camera.height, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      Sample& sample = samples[std::size_t(y) * camera.width + x];
      sample = trace(stage, camera.ray(float(x) + 0.5f, float(y) + 0.5f), 0);
      if (style.expose) sample.light = expose(sample.light);
    }
  });
  Canvas canvas(camera.width, camera.height, Vec3f::Zero());
  if (stage.transparent) canvas.alpha.resize(canvas.pixels.size());
  parallel_range(0, camera.height, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      const std::size_t pixel = std::size_t(y) * camera.width + x;
      const Light light =
          is_rough(samples, camera, x, y) ? four_rays(stage, camera, style, x, y) : samples[pixel].light;
      canvas.pixels[pixel] = light.rgb;
      if (stage.transparent) canvas.alpha[pixel] = light.alpha;
    }
  });
  if (style.edges) draw_domain(canvas, stage, camera, samples);
  return canvas;
}

}  // namespace seiche::render
