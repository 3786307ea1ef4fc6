#pragma once
// What must hold between the keys of a scene, once each has been read.
#include "base/scene.h"
#include "scene/context.h"

namespace seiche {

// Reports extents that are no whole number of cells, grids too small or too large, one-sided periodicity, times that do
// not fit together, names used twice, probes outside the domain, more rigid solids than can be solved for and motions
// that jump. Fills domain.cells and the default names. Groups with problems of their own are left out.
void check_scene(SceneContext& context, const TomlNode& root, Scene& scene);

// Part of the above: prescribed motions must be finite and must not leap further than the domain is long.
void check_motions(SceneContext& context, const TomlNode& root, const Scene& scene);

// Part of the above: where the flow is prescribed there must be nothing that acts on a flow.
void check_prescribed_flow(SceneContext& context, const TomlNode& root, const Scene& scene);

}  // namespace seiche
