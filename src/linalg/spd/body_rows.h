#pragma once
// Exact elimination of the rows that deformable bodies touch: the rest of the preconditioner keeps the grid's stencil.
#include <memory>

#include "linalg/precond/preconditioners.h"
#include "linalg/spd/body_coupling.h"

namespace seiche {

// With n the rows of C, o all others, and B ~ (A + lumped C)^-1, z = P r approximates (A + C)^-1 r:
//   z_o = [B (r_o - A_on y, 0)]_o,   (A + C)_nn y = r_n,   (A + C)_nn z_n = r_n - A_no z_o.
// P is symmetric positive definite if B is. Only C, which couples rows far apart, keeps B from being multigrid on the
// grid's stencil, and C lies within (A + C)_nn. Fails if that block is not positive definite. Collective.
PreconditionerOrFailure eliminate_body_rows(const LinearSystem& A, const BodyCoupling& C,
                                            std::unique_ptr<Preconditioner> B);

}  // namespace seiche
