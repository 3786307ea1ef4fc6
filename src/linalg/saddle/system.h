#pragma once
// Velocities under the constraint that volume stays:
//   F u + G v + D'p = f
//   G'u + H v + J'p = g
//   D u + J v       = q
// u on faces, v of bodies (the same on all ranks), p the multiplier, a pressure impulse.
#include <array>
#include <optional>

#include "linalg/core/block_columns.h"
#include "linalg/core/body_matrix.h"
#include "linalg/core/linear_system.h"
#include "linalg/core/sparse_operator.h"
#include "linalg/spd/coupled_system.h"

namespace seiche {

struct SaddleSystem {
  const DistributedMatrix& F;   // faces; symmetric positive definite, the diagonal first in each row
  const BlockColumns& G;        // rows of F by unknowns of bodies, the blocks those of J
  const DistributedMatrix& D;   // rows of A by (global) rows of F
  const DistributedMatrix& Dt;  // its transpose
  const BlockColumns& J;        // rows of A by unknowns of bodies
  const DistributedMatrix& A;   // schur_scale A = D M^-1 D', M the mass part of F
  const RowGrid& grid;          // of A
  const NullSpace& closed;      // of A
  double schur_scale;
  // By row of A: (D F^-1 D')^-1 ~ (schur_scale A)^-1 + diag(schur_mass) (Cahouet, Chabard 1988). Of a liquid of
  // viscosity mu dt mu / h^Dim, times 1 + kappa where kappa mu (div u)^2 is part of its energy.
  const Vector& schur_mass;
  const Vector& mass;  // M, by row of F
  // Axis of the velocity in each row of F. Needed where its energy couples axes (the full stress): without it multigrid
  // needs ever more iterations on finer grids.
  std::vector<int> axis = {};
  // Of the face of each row of F, in cells. Needed where viscosity jumps: without it stiff parts turn slowly.
  std::vector<std::array<double, 3>> position = {};
};

// Vectors of the whole are u, p and, on rank 0 alone, v, one after the other: sums over the ranks count v once.
class SaddleOperator {
 public:
  // Keeps references. Collective.
  SaddleOperator(const SaddleSystem& system, const Communicator& ranks);

  void set_bodies(const BodyMatrix& H) { H_ = &H; }
  const BodyMatrix& bodies() const { return *H_; }
  const SaddleSystem& system() const { return system_; }
  const LinearSystem& faces() const { return F_; }
  const LinearSystem& liquid() const { return A_; }
  const Communicator& ranks() const { return F_.ranks(); }
  int velocities() const { return F_.rows(); }
  int pressures() const { return A_.rows(); }
  int unknowns() const { return unknowns_; }  // of bodies

  Vector pack(const Vector& u, const Eigen::VectorXd& v, const Vector& p) const;
  // Collective: v comes from rank 0.
  void unpack(const Vector& x, Vector& u, Eigen::VectorXd& v, Vector& p) const;

  // y = K x and r = b - K x. Collective.
  void multiply(const Vector& x, Vector& y) const;
  void residual(const Vector& b, const Vector& x, Vector& r) const;

  // Parts of it. Collective.
  void multiply_velocity(const Vector& u, const Eigen::VectorXd& v, Vector& fu, Eigen::VectorXd& fv) const;
  void add_gradient(const Vector& p, Vector& fu, Eigen::VectorXd& fv) const;       // += (D'p, J'p)
  void divergence(const Vector& u, const Eigen::VectorXd& v, Vector& flux) const;  // = D u + J v

 private:
  const SaddleSystem& system_;
  RowGrid no_grid_;
  NullSpace none_;
  LinearSystem F_, A_;
  SparseOperator D_, Dt_;
  int unknowns_;
  const BodyMatrix* H_ = nullptr;
};

}  // namespace seiche
