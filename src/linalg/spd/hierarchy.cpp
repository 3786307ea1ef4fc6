#include "linalg/spd/hierarchy.h"

#include "linalg/precond/hypre_adapter.h"
#include "linalg/spd/body_rows.h"

namespace seiche {
namespace {

// BoomerAMG on A + C. Rows filled by bodies: aggressive coarsening doubles the iterations, and a single sweep costs a
// third more (docs/decisions/0010-elastic-preconditioner.md).
void make_filled(const std::string& name, const CoupledSystem& S, const BodyCoupling& C, Hierarchy& h) {
  const LinearSystem& A = S.liquid();
  h.matrix = std::make_unique<DistributedMatrix>(add_body_coupling(A, C));
  h.system = std::make_unique<LinearSystem>(*h.matrix, A.grid(), A.null_space(), A.ranks());
  h.made = name == "boomeramg" ? make_boomeramg(*h.system, {.aggressive_levels = 0, .sweeps = 2})
                               : make_preconditioner(name, *h.system);
}

// Multigrid on the grid's stencil for A + lumped C; C itself in an exact solve on the rows it touches
// (docs/decisions/0036-multigrid-with-bodies.md).
void make_on_grid(const std::string& name, const CoupledSystem& S, const BodyCoupling& C, Hierarchy& h) {
  const LinearSystem& A = S.liquid();
  h.matrix = std::make_unique<DistributedMatrix>(add_lumped_coupling(A, C));
  h.system =
      std::make_unique<LinearSystem>(*h.matrix, A.grid(), without(A.null_space(), S.sensed_components()), A.ranks());
  h.made = make_preconditioner(name, *h.system);
  if (h.made.preconditioner) h.made = eliminate_body_rows(A, C, std::move(h.made.preconditioner));
}

}  // namespace

Hierarchy make_hierarchy(const std::string& name, const CoupledSystem& S, Coefficients coefficients) {
  Hierarchy h;
  if (S.columns().any_deforms() && S.is_coupled()) {
    h.diagonal = S.bodies().diagonal();
    const BodyCoupling C = body_coupling(S.liquid(), S.columns(), S.bodies(), S.scale());
    (keeps_to_grid(name) ? make_on_grid : make_filled)(name, S, C, h);
  } else if (name == "boomeramg" && coefficients == Coefficients::jumping) {
    // docs/decisions/0002-preconditioner-choice.md
    h.made = make_boomeramg(S.liquid(), {.elements_per_row = 6, .aggressive_levels = 0});
  } else {
    h.made = make_preconditioner(name, S.liquid());
  }
  return h;
}

}  // namespace seiche
