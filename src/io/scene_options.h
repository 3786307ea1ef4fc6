#pragma once
// The one table of every key a scene may have.
#include <vector>

#include "base/options.h"
#include "io/scene_section.h"

namespace seiche {

// The top level; everything else hangs below it.
const Section<Scene>& scene_section();
Section<ShapeSpec> shape_section();
Section<LiquidSpec> liquid_section();
Section<SolidSpec> solid_section();
Section<RigidSpec> rigid_section();

// Reports a rotation axis that is missing (3D), zero or not along z (2D) in the table at `place`.
void check_axis(SceneContext& context, const Place& place, const Vec3& axis);

// Sets shape.where and checks what concerns several keys of a shape.
void finish_shape(SceneContext& context, const Place& place, ShapeSpec& shape);

// Checks what concerns several keys of a rigid solid.
void finish_rigid(SceneContext& context, const Place& place, const SolidSpec& solid);

// Every key with its full path ("solid[].rotate.degrees"), in the order of the scene file.
std::vector<Option> scene_options();

inline constexpr std::size_t most_entries = 20000;  // solids, regions, sources or probes of one scene

}  // namespace seiche
