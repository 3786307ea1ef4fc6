#pragma once
// LSC (BFBt) preconditioner of the Schur complement S = D F^-1 D' of viscous flow, for variable viscosity.
#include "linalg/precond/hypre_adapter.h"
#include "linalg/precond/pressure_free_faces.h"
#include "linalg/saddle/system.h"

namespace seiche {

// Approximates (S / schur_scale)^-1 by the least-squares commutator (BFBt; Elman et al. 2006; Rudi, Stadler, Ghattas
// 2017),
//   S^-1 ~ L^-1 (D C^-1 F C^-1 D') L^-1,   L = D C^-1 D',   C diagonal.
// L^-1 is one multigrid cycle. Symmetric, and positive up to the null space. F is the Schur complement after
// elimination of the pressure-free faces. C is the diagonal of F with a larger viscous part near walls, where F does
// not commute with the gradient (Elman, Tuminaro 2009).
class LscPreconditioner : public Preconditioner {
 public:
  // Keeps references to K and *loose; `loose` may be null. Collective.
  LscPreconditioner(const SaddleOperator& K, const PressureFreeRows* pressure_free, const AmgSettings& settings);
  void apply(const Vector& r, Vector& z) override;

 private:
  void set_weights();
  DistributedMatrix weighted_laplacian() const;
  void solve_laplacian(Vector& b, Vector& x);
  void follow_stress(Vector& w, Vector& Fw) const;

  const SaddleOperator& K_;
  const PressureFreeRows* pressure_free_;
  Vector weight_;  // C^-1
  DistributedMatrix matrix_;
  std::unique_ptr<LinearSystem> L_;
  std::unique_ptr<Preconditioner> B_;
};

}  // namespace seiche
