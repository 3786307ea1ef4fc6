#pragma once
// Colours of the solids.
#include "render/image.h"

namespace seiche {
struct SolidSpec;
}

namespace seiche::render {

// Light grey for static solids, dark grey for prescribed ones, and a colour for each rigid body in the order of the
// scene; linear light.
std::vector<Vec3f> solid_colors(const std::vector<SolidSpec>& solids);

// Colour of one solid. Solids missing in the list get the colours of rigid bodies in turn.
Vec3f solid_color(const std::vector<Vec3f>& colors, int solid);

}  // namespace seiche::render
