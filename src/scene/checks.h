#pragma once
// Checks between the keys of a scene, after each has been read.
#include "scene/context.h"

namespace seiche {

struct Scene;

// Reports extents that are not a whole number of cells, too small or too large grids, one-sided periodicity,
// inconsistent times, duplicate names, probes outside the domain, too many rigid solids, and motions that jump. Sets
// domain.cells and the default names. Skips groups that already have problems.
void check_scene(SceneContext& context, const TomlNode& root, Scene& scene);

// Part of check_scene(): prescribed motions must be finite and must not jump by more than the domain's length.
void check_motions(SceneContext& context, const TomlNode& root, const Scene& scene);

// Part of check_scene(): joints name solids that are there, and have what their kind needs.
void check_joints(SceneContext& context, const TomlNode& root, const Scene& scene);

// Parts of check_scene(): forces and contacts name solids that are there, and do something.
void check_forces(SceneContext& context, const TomlNode& root, const Scene& scene);
void check_contacts(SceneContext& context, const TomlNode& root, const Scene& scene);

// Part of check_scene(): solids that sources and drains are attached to are there and do not deform.
void check_attached(SceneContext& context, const TomlNode& root, const Scene& scene);

// Part of check_scene(): rates of sources and drains are finite and not negative.
void check_rates(SceneContext& context, const TomlNode& root, const Scene& scene);

// Part of check_scene(): a prescribed flow excludes everything that acts on a flow.
void check_prescribed_flow(SceneContext& context, const TomlNode& root, const Scene& scene);

}  // namespace seiche
