#pragma once

namespace seiche {

// Hessian projection of a non-convex energy. exact: the Hessian itself. convex: negative eigenvalues are removed from
// each of its parts (each quadrature point, the contacts between two rigid bodies, each primitive pair with a
// deformable side).
enum class HessianProjection : char { exact, convex };

}  // namespace seiche
