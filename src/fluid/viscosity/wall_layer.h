#pragma once
// Velocities of faces as means over them, to fourth order: beyond walls, at points, and in the viscous stress. What
// fluxes are free of divergence for are means; docs/decisions/0015-fourth-order.md says what that is worth.
#include "fluid/boundary/domain_boundary.h"

namespace seiche {

enum class FaceValues { means, points };

// Continues u (m/s, ghosts filled) beyond no-slip and moving walls as smooth flow goes on: along the wall odd about the
// wall's velocity at time t, plus the even part of the parabola through it and the two layers next to it; across the
// wall evenly, since d_n u_n = 0 there. Domains of one cell are left as they are. Local.
template <int Dim>
void continue_beyond_walls(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t, FaceValues values,
                           FaceField<Dim>& u);

// 1 on the owned faces of one component that this order holds for: all faces up to two away along each axis are
// valid (halo filled), walls of the domain being continued through, and none of its openings is nearer than that.
template <int Dim>
FaceField<Dim, char> whole_faces(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides,
                                 const FaceField<Dim, char>& valid);

// sum over the axes b within a face of delta_b^2 u/24: what the mean over the face has more than its centre.
template <int Dim>
double excess_of_mean(const Layout<Dim>& layout, const FaceField<Dim>& u, int axis, Site f);

// h^2 times what the Laplacian of the viscous operator lacks to fourth order at face f (index i) of component `axis`:
// -delta^4 u/12 along each axis, next to a wall the parabola's 2 b in place of the half link. u are means, continued as
// above.
template <int Dim>
double missing_laplacian(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, const FaceField<Dim>& u, int axis,
                         Site f, const IVec<Dim>& i);

// Smallest mask value within `reach` sites along an axis. The domain ends without harm: beyond its sides there is a
// wall's mirror image or what flows in.
template <int Dim>
char least_along(const Layout<Dim>& layout, const std::vector<char>& mask, int component, int axis, int reach, Site f,
                 const IVec<Dim>& i);

}  // namespace seiche
