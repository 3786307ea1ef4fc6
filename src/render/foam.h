#pragma once
// Foam and spray for pictures.
#include "render/fields.h"

namespace seiche::render {

// Share of foam at each cell, 0 to 0.85: M. Ihmsen, N. Akinci, G. Akinci, M. Teschner, Unified spray, foam and air
// bubbles for particle-based fluids (2012), whose potentials of wave crests and kinetic energy are multiplied. Crests:
// curvature of the level set over the cell size; energy: speed^2 against `fast`^2 (m/s). `amount` scales the result.
ScalarVolume foam_of(const ScalarVolume& phi, const FaceVelocity& velocity, float fast, float amount);

}  // namespace seiche::render
