#pragma once

namespace seiche {

// Which second derivatives of an energy that is not convex. convex: without the negative eigenvalues of its parts (each
// quadrature point, the contacts between each two rigid bodies, each pair of primitives with a deformable side).
enum class Curvature : char { exact, convex };

}  // namespace seiche
