#pragma once
// The table of all keys of a scene.
#include <vector>

#include "base/options.h"
#include "base/vec.h"
#include "scene/materials.h"
#include "scene/section.h"

namespace seiche {

struct ContactSpec;
struct ElasticSpec;
struct ForceSpec;
struct JointSpec;
struct LiquidSourceSpec;
struct LiquidSpec;
struct MotionSpec;
struct ProbeSpec;
struct RigidSpec;
struct RobotSpec;
struct Scene;
struct ShapeSpec;
struct SolidSpec;
struct SolverSpec;
struct TransformSpec;

// The top level; all other keys are below it.
const Section<Scene>& scene_section();
std::vector<Key<Scene>> naming_keys();  // include, parameters, signals, curves
Section<ShapeSpec> shape_section();
// rotate and translate.
Section<TransformSpec> placement_section();
Section<LiquidSpec> liquid_section();
Section<LiquidSourceSpec> source_section();
Section<LiquidSourceSpec> drain_section();
Section<SolidSpec> solid_section();
Section<RigidSpec> rigid_section();
Section<ElasticSpec> elastic_section();
Section<MotionSpec> motion_section();
Section<JointSpec> joint_section();
Section<ForceSpec> force_section();
Section<ContactSpec> contact_section();
Section<RobotSpec> robot_section();
Section<ProbeSpec> probe_section();

// Keys of viscous liquid.
Key<LiquidSpec> viscosity_key();
Key<LiquidSpec> rheology_key();
std::vector<Key<SolverSpec>> viscous_solver_keys();
// Keys of surface tension. `where` completes the description of the angle.
Key<LiquidSpec> surface_tension_key();
Key<LiquidSpec> tension_scheme_key();
Option contact_angle_option(const std::string& where);
// Reports a liquid with both viscosity and rheology.
void check_one_viscosity(SceneContext& context, const Place& place);

Key<Scene> gas_key();
// Common to liquid and gas.
Option density_option();
// A key that names a material; fill_in_materials() has put numbers in its place before sections are read.
Option material_option(MaterialState state);
template <class Spec>
Key<Spec> material_key(MaterialState state) {
  const Option option = material_option(state);
  return {option,
          [option](SceneContext& c, const Place& p, Spec&) {
            std::string name;
            read_value(c, p, option, name);
          },
          [](const Spec&, int, const std::string&, SceneLines&) {}};
}
Option initial_velocity_option();

// Reports a rotation axis that is missing (3D), zero or not along z (2D) in the table at `place`.
void check_axis(SceneContext& context, const Place& place, const Vec3& axis);

// Permitted contents of a shape's mesh file: a closed surface only, or also the elements of an elastic solid.
enum class MeshFiles { surfaces, surfaces_and_elements };

// Sets shape.where and checks keys of a shape against each other.
void finish_shape(SceneContext& context, const Place& place, ShapeSpec& shape, MeshFiles files = MeshFiles::surfaces);

// Check keys of a rigid or elastic solid against each other.
void finish_rigid(SceneContext& context, const Place& place, const SolidSpec& solid);
void finish_elastic(SceneContext& context, const Place& place, const SolidSpec& solid);

// Reason why no body has this tensor of inertia (kg m^2, its lower triangle), or "".
std::string fault_of_inertia(const Eigen::Matrix3d& tensor);
// Reports a mass that is missing, given twice, or that no body has.
void check_mass(SceneContext& context, const Place& place, const SolidSpec& solid);

// Reports unbounded shapes: planes and inverted ones. `what` is "a rigid solid".
void check_bounded(SceneContext& context, const Place& place, const ShapeSpec& shape, const std::string& what);

// Every key with its full path ("solid[].rotate.degrees"), in the order of the scene file.
std::vector<Option> scene_options();

// Shortest time between steps or samples, s; shorter ones would never finish a run.
inline constexpr double shortest_time = 1e-12;

inline constexpr std::size_t most_entries = 20000;  // solids, regions, sources or probes of one scene

}  // namespace seiche
