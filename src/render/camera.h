#pragma once
// Camera of a picture: position, orientation and projection.
#include <optional>

#include "render/volume.h"

namespace seiche::render {

struct Camera {
  Vec3f eye{0, 0, 1}, forward{0, 0, -1}, side{1, 0, 0}, up{0, 1, 0};  // unit vectors, orthogonal
  float slope = 0.3f;                                                 // tangent of half the vertical field of view
  int width = 1280, height = 720;

  // Ray through pixel coordinates (from the top left; pixel centres at + 1/2).
  Ray ray(float x, float y) const;
  // Pixel coordinates and, as third component, the distance along `forward` (<= 0: behind the eye).
  Vec3f project(const Vec3f& x) const;
};

struct CameraSpec {
  Vec3f eye{0, 0, 0}, look{0, 0, 0};
  float degrees = 35;  // vertical field of view
};

// The requested camera. Throws Error(bad_input) if eye and look coincide or the angle is not in (0, 170).
Camera make_camera(const CameraSpec& spec, const Vec3f& up, int width, int height);

// Three-quarter view from above with the whole box in view; its longer horizontal side runs across the picture.
Camera frame_box(const Box& box, int up_axis, int width, int height);

}  // namespace seiche::render
