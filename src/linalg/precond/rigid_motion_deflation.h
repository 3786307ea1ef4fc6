#pragma once
// Deflation (balancing) of rigid motions of high-viscosity regions. Only the energy of the surrounding liquid resists
// them. Unknown-based AMG does not represent rotations and gives them spurious energy, larger by the viscosity ratio.
#include <Eigen/Core>

#include "linalg/precond/near_null_space.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// Balancing preconditioner (Mandel 1993):
//   z = Q r + (1 - Q F) B (1 - F Q) r,   Q = Z (Z'F Z)^-1 Z'.
// Z holds the near-null-space vectors of find_near_null_space(), extended into the surrounding liquid. Symmetric;
// positive if B is.
class RigidMotionDeflation : public Preconditioner {
 public:
  // Keeps a reference to F; `dimension` is 2 or 3. Collective.
  RigidMotionDeflation(const LinearSystem& F, const FacePlaces& places, int dimension,
                       std::unique_ptr<Preconditioner> B);
  void apply(const Vector& r, Vector& z) override;
  const std::vector<NearNullVector>& motions() const { return Z_; }

 private:
  void extend();
  Eigen::MatrixXd energies() const;
  void invert_energies(Eigen::MatrixXd E);
  Eigen::VectorXd summed(Eigen::VectorXd y) const;

  const LinearSystem& F_;
  std::unique_ptr<Preconditioner> B_;
  std::vector<NearNullVector> Z_;
  std::vector<SparseVector> FZ_;
  Eigen::MatrixXd inverse_;  // of Z'F Z
};

}  // namespace seiche
