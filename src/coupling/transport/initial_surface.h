#pragma once
// Initial level set.
#include "coupling/geometry/step_geometry.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Signed distance (m) to the union of the regions' shapes, limited to the band. Ghosts filled. Collective.
template <int Dim>
CellField<Dim> initial_surface(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                               const StepGeometry<Dim>& geometry,
                               const std::vector<std::unique_ptr<ShapeField<Dim>>>& shapes);

// True if all cells' centres lie in one of the shapes. Collective.
template <int Dim>
bool fill_domain(const Domain<Dim>& domain, const std::vector<std::unique_ptr<ShapeField<Dim>>>& shapes);

}  // namespace seiche
