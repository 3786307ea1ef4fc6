#pragma once
// Quantities for false colours: fields of a frame, and others derived from its velocity.
#include <optional>
#include <string>
#include <vector>

#include "geometry/vdb/openvdb_adapter.h"
#include "render/volume.h"

namespace seiche::render {

// Velocity at the low faces of cells, m/s, as frames hold it.
struct FaceVelocity {
  std::array<int, 3> cells{0, 0, 0};
  Vec3f lower{0, 0, 0};
  float h = 1;
  std::vector<float> values;  // x, y, z of each cell, first axis fastest

  // Component along an axis at the centre of a cell: mean of its two faces; at the last cell of the axis its low one.
  float at_center(const std::array<int, 3>& cell, int axis) const;
  // Bilinear in each component; 2D alone. Zero outside of the domain.
  Vec2f sample(const Vec2f& x) const;
};

// Level set of a decoded frame, if any.
std::optional<ScalarVolume> level_set_of(const vdb::Frame& frame);

// The frame's velocity. Throws Error(bad_input) where it has none; `option` names what asked for it.
FaceVelocity velocity_of(const vdb::Frame& frame, const std::string& option);

// A quantity at cell centres: "speed", "velocity_x" (y, z), "vorticity" (1/s; its length in 3D), "divergence" (1/s), or
// the name of a field (the length for vectors). Derivatives are central, one-sided beside what is not
// liquid. Throws Error(bad_input) that lists what the frame can show and names the entry of
// output.frames that is missing.
ScalarVolume quantity_of(const vdb::Frame& frame, const std::string& quantity);

// Names for quantity_of() that this frame can show.
std::vector<std::string> quantities_of(const vdb::Frame& frame);

// "speed (m/s)"; only the name if the unit is unknown.
std::string label_of(const std::string& quantity);

// True for quantities with a sign, which are shown about zero. In 3D the vorticity is a length.
bool has_sign(const std::string& quantity, int dimension);

}  // namespace seiche::render
