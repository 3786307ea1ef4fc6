#pragma once
// Velocities and pressures of an incompressible flow with bodies:
//   F u + G v + D'p = f
//   G'u + H v + J'p = g
//   D u + J v       = q
// u: velocities on faces; v: unknowns of bodies (the same on all ranks); p: multiplier, a pressure impulse. If H has
// constraints C v = 0, v and the iterates fulfil them, and the second row counts without its part C'W^+ C H^-1.
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
  const BlockColumns& G;        // rows of F by unknowns of bodies; blocks as in J
  const DistributedMatrix& D;   // rows of A by global rows of F
  const DistributedMatrix& Dt;  // transpose of D
  const BlockColumns& J;        // rows of A by unknowns of bodies
  const DistributedMatrix& A;   // schur_scale A = D M^-1 D', M the mass part of F
  const RowGrid& grid;          // of A
  const NullSpace& closed;      // of A
  double schur_scale;
  // Per row of A: (D F^-1 D')^-1 ~ (schur_scale A)^-1 + diag(schur_mass) (Cahouet, Chabard 1988). For a liquid of
  // viscosity mu: dt mu / h^Dim, times 1 + kappa if its energy contains kappa mu (div u)^2.
  const Vector& schur_mass;
  const Vector& mass;  // M, per row of F
  // Axis of the velocity of each row of F. Needed if the energy couples axes (full stress): without it multigrid needs
  // more and more iterations on finer grids.
  std::vector<int> axis = {};
  // Position of the face of each row of F, in cells. Needed for viscosity jumps: rotations of high-viscosity regions
  // converge slowly without it.
  std::vector<std::array<double, 3>> position = {};
};

// Full vectors hold u, p and, on rank 0 only, v, one after the other: sums over the ranks count v once.
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
  // v is broadcast from rank 0. Collective.
  void unpack(const Vector& x, Vector& u, Eigen::VectorXd& v, Vector& p) const;

  // y = K x and r = b - K x. Collective.
  void multiply(const Vector& x, Vector& y) const;
  void residual(const Vector& b, const Vector& x, Vector& r) const;

  // Blocks of K. Collective.
  void multiply_velocity(const Vector& u, const Eigen::VectorXd& v, Vector& fu, Eigen::VectorXd& fv) const;
  void add_gradient(const Vector& p, Vector& fu, Eigen::VectorXd& fv) const;  // += (D'p, J'p)
  // Takes the part C'W^+ C H^-1 off, which multipliers of constraints balance.
  void drop_multipliers(Eigen::VectorXd& fv) const;
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
