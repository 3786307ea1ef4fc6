#pragma once
// Liquid too little for a pressure of its own: shares of cells away from the level set's liquid. It flies freely.
#include "coupling/state/state.h"

namespace seiche {

// Cells, the first beyond the owned ones too, with a share of liquid that have no cell of phi < 0 (m) within one of
// them.
template <int Dim>
std::vector<Site> drifting_cells(const Domain<Dim>& domain, const CellField<Dim>& phi, const CellField<Dim>& share);

// Sets 1 on the faces of drifting cells.
template <int Dim>
void mark_faces(const Layout<Dim>& layout, const std::vector<Site>& drifting, FaceField<Dim, char>& marks);

// Velocity of a face in free fall, m/s: u(x - dt u) + dt g, with g the mean gravity of the step, m/s^2.
template <int Dim>
double falling_velocity(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec3& gravity, double dt, int axis,
                        Site face);

// Sets u* (m/s) on the faces of drifting cells: that of free fall, or 0 where a face is less open than least_open. A
// face that lets nothing out of its cell and has no liquid beyond it takes the velocity of the opposite face. Liquid
// that lies on a wall then gains no speed. Fills ghosts. Collective.
template <int Dim>
void let_drift(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const CellField<Dim>& share,
               const std::vector<Site>& drifting, const FaceField<Dim>& u, const Vec3& gravity, double dt,
               FaceField<Dim>& u_star);

// Takes u from u* on the invalid faces of drifting cells that are open by least_open or more, and marks them valid
// (face_at_surface). Fills ghosts. Collective.
template <int Dim>
void take_drifting(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const std::vector<Site>& drifting,
                   const FaceField<Dim>& u_star, TimeLevel<Dim>& level);

}  // namespace seiche
