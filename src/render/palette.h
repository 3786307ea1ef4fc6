#pragma once
// Which solid has which colour.
#include "base/scene.h"
#include "render/image.h"

namespace seiche::render {

// A light grey for solids at rest, a dark one for those that a formula moves, and a colour each for rigid bodies, by
// their order in the scene; linear light.
std::vector<Vec3f> solid_colors(const Scene& scene);

// That of one solid; solids the list does not know have the colours of rigid bodies in turn.
Vec3f solid_color(const std::vector<Vec3f>& colors, int solid);

}  // namespace seiche::render
