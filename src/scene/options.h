#pragma once
// The one table of every key a scene may have.
#include <vector>

#include "base/options.h"
#include "scene/section.h"

namespace seiche {

// The top level; everything else hangs below it.
const Section<Scene>& scene_section();
Section<ShapeSpec> shape_section();
Section<LiquidSpec> liquid_section();
Section<SolidSpec> solid_section();
Section<RigidSpec> rigid_section();
Section<ElasticSpec> elastic_section();
Section<MotionSpec> motion_section();

// Of viscous liquid.
Key<LiquidSpec> viscosity_key();
Key<LiquidSpec> rheology_key();
std::vector<Key<SolverSpec>> viscous_solver_keys();
// Of surface tension. `where` ends the angle's description.
Key<LiquidSpec> surface_tension_key();
Key<LiquidSpec> tension_scheme_key();
Option contact_angle_option(const std::string& where);
// Reports a liquid that gives both viscosity and rheology.
void check_one_viscosity(SceneContext& context, const Place& place);

Key<Scene> gas_key();
// Of liquid and gas alike.
Option density_option();
Option initial_velocity_option();

// Reports a rotation axis that is missing (3D), zero or not along z (2D) in the table at `place`.
void check_axis(SceneContext& context, const Place& place, const Vec3& axis);

// What a shape's mesh file may hold: a closed surface alone, or also the elements of an elastic solid.
enum class MeshFiles { surfaces, surfaces_and_elements };

// Sets shape.where and checks what concerns several keys of a shape.
void finish_shape(SceneContext& context, const Place& place, ShapeSpec& shape, MeshFiles files = MeshFiles::surfaces);

// Check what concerns several keys of a rigid or an elastic solid.
void finish_rigid(SceneContext& context, const Place& place, const SolidSpec& solid);
void finish_elastic(SceneContext& context, const Place& place, const SolidSpec& solid);

// Reports shapes that have no bounds: planes and inverted ones. `what` is "a rigid solid".
void check_bounded(SceneContext& context, const Place& place, const ShapeSpec& shape, const std::string& what);

// Every key with its full path ("solid[].rotate.degrees"), in the order of the scene file.
std::vector<Option> scene_options();

inline constexpr std::size_t most_entries = 20000;  // solids, regions, sources or probes of one scene

}  // namespace seiche
