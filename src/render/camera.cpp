#include "render/camera.h"

#include <cmath>

#include "base/error.h"

namespace seiche::render {
namespace {

Camera orient(const Vec3f& eye, const Vec3f& forward, const Vec3f& up, float degrees, int width, int height) {
  Camera camera;
  camera.eye = eye;
  camera.forward = forward.normalized();
  Vec3f side = camera.forward.cross(up);
  if (side.norm() < 1e-4f) side = camera.forward.unitOrthogonal();  // view straight up or down
  camera.side = side.normalized();
  camera.up = camera.side.cross(camera.forward);
  camera.slope = std::tan(degrees * 3.14159265f / 360);
  camera.width = width;
  camera.height = height;
  return camera;
}

Vec3f corner_of(const Box& box, int index) {
  Vec3f x;
  for (int a = 0; a < 3; ++a) x[a] = index >> a & 1 ? box.upper[a] : box.lower[a];
  return x;
}

// The nearest eye, for the camera's orientation, from which all corners fit into the given slopes. A corner at (s, u,
// f) relative to the box's centre requires |s - shift| <= slope (f + distance). Both directions are solved separately.
Vec3f fitting_eye(const Camera& camera, const Box& box, float slope_side, float slope_up) {
  const float slopes[2] = {slope_side, slope_up};
  const Vec3f axes[2] = {camera.side, camera.up};
  Vec3f shift = Vec3f::Zero();
  float distance = 0;
  for (int d = 0; d < 2; ++d) {
    float high = -1e30f, low = -1e30f;
    for (int i = 0; i < 8; ++i) {
      const Vec3f x = corner_of(box, i) - box.center();
      high = std::max(high, x.dot(axes[d]) - slopes[d] * x.dot(camera.forward));
      low = std::max(low, -x.dot(axes[d]) - slopes[d] * x.dot(camera.forward));
    }
    shift += 0.5f * (high - low) * axes[d];
    distance = std::max(distance, 0.5f * (high + low) / slopes[d]);
  }
  return box.center() + shift - distance * camera.forward;
}

}  // namespace

Ray Camera::ray(float x, float y) const {
  const float scale = 2 * slope / float(height);
  const Vec3f direction = forward + (x - 0.5f * float(width)) * scale * side - (y - 0.5f * float(height)) * scale * up;
  return {eye, direction.normalized()};
}

Vec3f Camera::project(const Vec3f& x) const {
  const Vec3f d = x - eye;
  const float depth = d.dot(forward), scale = float(height) / (2 * slope * depth);
  return {0.5f * float(width) + d.dot(side) * scale, 0.5f * float(height) - d.dot(up) * scale, depth};
}

Camera make_camera(const CameraSpec& spec, const Vec3f& up, int width, int height) {
  if ((spec.look - spec.eye).norm() == 0) {
    throw Error(ExitCode::bad_input, "--camera: the eye and the point looked at are the same; give two points");
  }
  if (!(spec.degrees > 0 && spec.degrees < 170)) {
    throw Error(ExitCode::bad_input, "--camera: the field of view must be between 0 and 170 degrees");
  }
  return orient(spec.eye, spec.look - spec.eye, up, spec.degrees, width, height);
}

Camera frame_box(const Box& box, int up_axis, int width, int height) {
  // horizontal axes with across x away = up
  int across = (up_axis + 2) % 3, away = (up_axis + 1) % 3;
  float away_sign = -1;
  if (box.size()[away] > box.size()[across]) std::swap(across, away), away_sign = 1;
  Vec3f forward = Vec3f::Zero();
  forward[away] = away_sign * 1.0f;
  forward[across] = 0.55f;
  forward[up_axis] = -0.52f;
  const float degrees = 32;
  Camera camera = orient(box.center(), forward, Vec3f::Unit(up_axis), degrees, width, height);
  const float margin = 0.86f;
  const float slope_side = margin * camera.slope * float(width) / float(height);
  camera.eye = fitting_eye(camera, box, slope_side, margin * camera.slope);
  return camera;
}

}  // namespace seiche::render
