#pragma once
// Speeds that a scene prescribes, for the estimate of steps.
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche {

struct Scene;

// Largest speed of a point of the kinematic solids over the run, m/s, by their surfaces at the start.
double speed_of_kinematic_solids(const Scene& scene, const std::vector<SurfaceMesh>& at_start);

// Largest speed of the liquid that inflow sides and sources bring, m/s, also after thin liquid fell to the domain's
// floor.
double speed_of_feeds(const Scene& scene);

}  // namespace seiche
