#pragma once
// Multigrid on faces, mended where it fails: on rigid motions of stiff parts, which the energy of the rest alone
// resists. Multigrid that interpolates each axis by itself bends what turns, at a cost that is larger by the ratio of
// stiffness.
#include <Eigen/Core>

#include "linalg/precond/near_null_space.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// z = Q r + (1 - Q F) B (1 - F Q) r, Q = Z (Z'F Z)^-1 Z' (balancing; Mandel 1993), Z = find_near_null_space() with
// the flow around them: symmetric, and positive where B is.
class RigidMotionDeflation : public Preconditioner {
 public:
  // Keeps the reference to F; `dimension` is 2 or 3. Collective.
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
