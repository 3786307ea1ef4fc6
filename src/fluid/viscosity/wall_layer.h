#pragma once
// Face velocities as averages over faces, to fourth order: beyond walls, at points, and in the viscous stress. The
// discrete divergence constrains face averages, not point values (docs/decisions/0015-fourth-order.md).
#include "fluid/boundary/domain_boundary.h"

namespace seiche {

enum class FaceValues { means, points };

// Extends u (m/s, ghosts filled) smoothly beyond no-slip and moving walls. Tangential components: odd about the wall's
// velocity at time t, plus the even part of the parabola through it and the two layers next to the wall. Normal
// component: even, since d_n u_n = 0 at the wall. Skips axes with a single cell. Local.
template <int Dim>
void continue_beyond_walls(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, double t, FaceValues values,
                           FaceField<Dim>& u);

// 1 on the owned faces that have fourth-order accuracy. All faces of the same component up to two away along each axis
// must be valid (halo filled; walls of the domain do not matter). No inflow or outflow side may be nearer than three
// cells.
template <int Dim>
FaceField<Dim, char> whole_faces(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides,
                                 const FaceField<Dim, char>& valid);

// Mean over a face minus the value at its centre: the sum of delta_b^2 u/24 over the axes b within the face.
template <int Dim>
double excess_of_mean(const Layout<Dim>& layout, const FaceField<Dim>& u, int axis, Site f);

// h^2 times the fourth-order correction of the viscous operator's Laplacian at face f (index i) of component `axis`:
// -delta^4 u/12 along each axis; next to a wall, 2 b of the parabola replaces the link of half a cell. u: face means,
// extended by continue_beyond_walls().
template <int Dim>
double missing_laplacian(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, const FaceField<Dim>& u, int axis,
                         Site f, const IVec<Dim>& i);

// 1 if the mask is set at all sites within `reach` along an axis, else 0. Sites beyond the sides of the domain do not
// count, since their values are extended or prescribed.
template <int Dim>
char least_along(const Layout<Dim>& layout, const std::vector<char>& mask, int component, int axis, int reach, Site f,
                 const IVec<Dim>& i);

}  // namespace seiche
