#pragma once
// Looks of liquids in pictures.
#include <string>

#include "render/image.h"

namespace seiche {
struct LiquidSpec;
}

namespace seiche::render {

// Lengths are relative to the domain's diagonal, so that small and large scenes of a liquid look alike.
struct LiquidLook {
  Vec3f absorption{8.0f, 2.3f, 1.2f};     // by channel, per diagonal
  Vec3f glow{0.010f, 0.115f, 0.185f};     // light that the liquid scatters where it is deep
  float index = 1.33f;                    // of refraction
  Vec3f albedo{0, 0, 0};                  // of opaque liquids; zero: light passes
  Vec3f metal{0, 0, 0};                   // reflectance of metals at normal incidence; zero: none
  Vec3f flat = {0.033f, 0.187f, 0.508f};  // plain colour of 2D pictures

  bool is_opaque() const { return albedo.maxCoeff() > 0 || metal.maxCoeff() > 0; }
};

// The look for a name of docs/materials.md. Throws Error(bad_input) that lists them.
const LiquidLook& liquid_look(const std::string& name);

// Name of the material that a liquid looks like, by density and viscosity: the material itself where both agree with
// the table, else honey for 1 Pa s and more, olive_oil for light oils of 0.02 Pa s and more, mercury for metals, or
// water.
std::string material_of(const LiquidSpec& liquid);

}  // namespace seiche::render
