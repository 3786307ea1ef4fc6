#pragma once
// After the solve: velocity and pressure slope on the faces next to liquid, continued beyond it.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// valid codes of Level::valid.
enum : char { face_unknown_to_flow = 0, face_solved = 1, face_prescribed = 2 };

// The flow after a solve.
template <int Dim>
struct Restored {
  TimeLevel<Dim> level;  // the liquid's
  TimeLevel<Dim> gas;    // where gas flows
  GapFlow<Dim> gap_flow;
  double divergence = 0;  // the largest |net flux|/volume of a cell with a row, 1/s
};

// u = u* - dt grad p/rho on unknown faces, the given velocity on prescribed ones, q = grad p/rho; then u continued.
template <int Dim>
Restored<Dim> restore_velocity(const Setup<Dim>& setup, const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                               const CellField<Dim>& pressure, const FaceField<Dim>& u_star,
                               const StepGeometry<Dim>& geometry);

// Continues u from its valid faces: straight for two layers, constant beyond; in solids without flow through them.
template <int Dim>
void continue_velocity(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                       const StepGeometry<Dim>& geometry, const FaceField<Dim, char>& valid, FaceField<Dim>& u);

// Continues a fluid's level from the faces near it, its only valid ones where there is another fluid.
template <int Dim>
void continue_level(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                    const StepGeometry<Dim>& geometry, const FaceField<Dim, char>& near, TimeLevel<Dim>& level);

}  // namespace seiche
