#pragma once
// Velocity block of the saddle-point preconditioner: a symmetric positive approximate inverse of [F G; G' H].
#include "linalg/core/dense_factors.h"
#include "linalg/precond/chebyshev.h"
#include "linalg/precond/hypre_adapter.h"
#include "linalg/precond/pressure_free_faces.h"
#include "linalg/saddle/system.h"

namespace seiche {

// A motion m of bodies and the flow -W ~ -F^-1 G m that it drags along.
struct Direction {
  int unknown;        // m is the unit vector of this unknown; -1:
  Eigen::VectorXd m;  // m of a deformable body
  SparseVector W;
};

// Rigid bodies: factors of the block matrix with B ~ F^-1. B is multigrid (AMG) where viscosity dominates, a Chebyshev
// polynomial for moderate viscosity, the diagonal where mass dominates:
//   [1 -W; 0 1] [B 0; 0 T^-1] [1 0; -W' 1],   T = [-W; 1]'[F G; G' H][-W; 1].
// T is positive for any W. Deformable bodies keep H^-1 (a block of T^-1). Their motions as a whole, with the liquid,
// add
//   Z E^-1 Z',   Z = [-W; m],   E = Z'[F G; G' H]Z.
class VelocityPreconditioner {
 public:
  // Keeps a reference to K. Collective.
  VelocityPreconditioner(const SaddleOperator& K, const AmgSettings& settings);

  // Updates for the current H. False if T or E could not be factored. Collective.
  [[nodiscard]] bool refresh();
  void apply(const Vector& ru, const Eigen::VectorXd& rv, Vector& zu, Eigen::VectorXd& zv);

  // True if viscosity is so large that B is a multigrid cycle.
  bool is_multigrid() const { return !mass_prevails_ && !interval_; }
  // Pressure-free faces; null if there are none.
  const PressureFreeRows* pressure_free_rows() const { return pressure_free_.get(); }
  const std::vector<Direction>& directions() const { return directions_; }
  // T of the rigid directions and E of the others as one block-diagonal matrix.
  const Eigen::MatrixXd& direction_energies() const { return energies_; }

 private:
  void make_multigrid(AmgSettings settings);
  void correct_pressure_free_faces();
  void deflate_viscous_regions();
  void find_directions();
  std::vector<SparseVector> extend(const std::vector<Vector>& GM) const;
  void multiply_out(const std::vector<Vector>& GM);
  SparseMatrix body_part() const;

  const SaddleOperator& K_;
  bool mass_prevails_, good_ = true;
  std::optional<SpectralInterval> interval_;  // if B is a polynomial
  std::unique_ptr<PressureFreeRows> pressure_free_;
  std::unique_ptr<Preconditioner> B_;
  std::vector<Direction> directions_;  // rigid ones first
  std::size_t rigid_ = 0;
  Eigen::MatrixXd dragged_;  // W'FW - W'GM - M'G'W
  Eigen::MatrixXd energies_;
  BodyMatrix T_;
  DenseLdlt E_;
};

}  // namespace seiche
