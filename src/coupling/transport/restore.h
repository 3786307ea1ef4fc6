#pragma once
// After the solve: velocity and pressure slope on the faces next to liquid, extrapolated beyond it.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Values of TimeLevel::valid. The link of face_at_surface ends at the surface, at a share theta of h: u is solved, but
// q = p/(rho theta h) has the pressure's error times 1/theta.
enum : char { face_invalid = 0, face_solved = 1, face_prescribed = 2, face_at_surface = 3 };

inline bool is_solved(char valid) {
  return valid == face_solved || valid == face_at_surface;
}

// The level after the projection on all faces that touch a pressure, of any fluid,
//   u = u* - dt q,   q = grad p/rho,
// on unknown faces, and the given velocity on prescribed ones. n is 0. Ghosts of u filled. Collective.
template <int Dim>
TimeLevel<Dim> solved_level(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                            const OperatorPerturbation& perturbation, const ProjectionInput<Dim>& in,
                            const PressureRows<Dim>& rows, const CellField<Dim>& pressure, const FaceField<Dim>& u_star,
                            const StepGeometry<Dim>& geometry);

// Extrapolates u from its valid faces: linearly for two layers, constant beyond. In solids u follows the solid, so that
// no flow passes through its surface. Faces of walls and inflow keep the given velocity. Ghosts filled. Collective.
template <int Dim>
void continue_velocity(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                       const StepGeometry<Dim>& geometry, const FaceField<Dim, char>& valid, FaceField<Dim>& u);

// Extrapolates the level of one fluid. Only the faces `near` the fluid stay valid. Collective.
template <int Dim>
void continue_level(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                    const StepGeometry<Dim>& geometry, const FaceField<Dim, char>& near, TimeLevel<Dim>& level);

// A fluid's first time level: velocity u on the faces `near` it, extrapolated beyond. Collective.
template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> initial_level(const Domain<Dim>& domain, const Fluids& fluids,
                                                    const Solids<Dim>& solids, const StepGeometry<Dim>& geometry,
                                                    const FaceField<Dim, char>& near, FaceField<Dim> u);

}  // namespace seiche
