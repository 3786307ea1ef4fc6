#pragma once
// Drops of a frame in pictures: discs in 2D, small spheres in 3D.
#include "files/solid_mesh.h"
#include "geometry/vdb/openvdb_adapter.h"
#include "render/color.h"
#include "render/liquid_look.h"
#include "render/plot.h"

namespace seiche::render {

// Discs in the false colour of the drops' own speed or velocity if that is the quantity shown, else in `plain`.
std::vector<Disc> discs_of(const std::vector<vdb::Point>& drops, const std::string& quantity, const ColorScale& scale,
                           const Vec3f& plain);

// Adds the drops as spheres that belong to one further solid.
void add_spheres(const std::vector<vdb::Point>& drops, int solid, SolidMesh& to);

// Colour of drops in 3D: that of opaque liquids, else of spray.
Vec3f drop_color(const LiquidLook& look);

}  // namespace seiche::render
