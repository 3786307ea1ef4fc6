#pragma once
// Multigrid on faces, mended where it fails: on rigid motions of stiff parts, which the energy of the rest alone
// resists. Multigrid that interpolates each axis by itself bends what turns, at a cost that is larger by the ratio of
// stiffness.
#include <Eigen/Core>
#include <array>

#include "linalg/preconditioners.h"
#include "linalg/sparse_vector.h"

namespace seiche {

// Where the velocity of a row of F is, in cells, and along which axis.
struct FacePlaces {
  const std::vector<int>& axis;
  const std::vector<std::array<double, 3>>& position;
};

// z = Q r + (1 - Q F) B (1 - F Q) r, Q = Z (Z'F Z)^-1 Z' (balancing; Mandel 1993), Z the translations and rotations of
// find_stiff_regions() that F lets through: symmetric, and positive where B is.
class RigidMotions : public Preconditioner {
 public:
  // `dimension` of 2 or 3. Collective.
  RigidMotions(const LinearSystem& F, const FacePlaces& places, int dimension, std::unique_ptr<Preconditioner> B);
  void apply(const Vector& r, Vector& z) override;
  // Of Z.
  int count() const { return int(Z_.size()); }

 private:
  void keep_soft(std::vector<SparseVector> candidates);
  void invert_energies(Eigen::MatrixXd E);
  Eigen::VectorXd transposed(const std::vector<SparseVector>& columns, const Vector& x) const;

  const LinearSystem& F_;
  std::unique_ptr<Preconditioner> B_;
  std::vector<SparseVector> Z_, FZ_;
  Eigen::MatrixXd inverse_;  // of Z'F Z
};

}  // namespace seiche
