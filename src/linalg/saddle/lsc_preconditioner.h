#pragma once
// Preconditioners of the Schur complement of viscous flow, S = D F^-1 D', that see how viscosity varies.
#include "linalg/precond/hypre_adapter.h"
#include "linalg/precond/pressure_free_faces.h"
#include "linalg/saddle/system.h"

namespace seiche {

// (S / schur_scale)^-1 by the least-squares commutator (BFBt; Elman et al. 2006; Rudi, Stadler, Ghattas 2017),
//   S^-1 ~ L^-1 (D C^-1 F C^-1 D') L^-1,   L = D C^-1 D',   C diagonal,
// L^-1 by a cycle of multigrid. Symmetric, and positive but for the null space. F is what is left of it once the loose
// faces, which no pressure feels, have been eliminated. C is the diagonal of F, its viscous part larger near walls: the
// commutator of F and the gradient does not vanish there (Elman, Tuminaro 2009).
class LscPreconditioner : public Preconditioner {
 public:
  // Keeps the references; `loose` may be null. Collective.
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
