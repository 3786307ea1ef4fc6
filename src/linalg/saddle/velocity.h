#pragma once
// The velocity block of a saddle-point preconditioner: an approximate inverse of [F G; G' H], symmetric and positive.
#include <Eigen/Cholesky>

#include "linalg/precond/chebyshev.h"
#include "linalg/precond/hypre_adapter.h"
#include "linalg/precond/pressure_free_faces.h"
#include "linalg/saddle/system.h"

namespace seiche {

// A motion m of bodies with the flow -W ~ -F^-1 G m that it drags along.
struct Direction {
  int unknown;        // m is 1 here and 0 elsewhere; or -1:
  Eigen::VectorXd m;  // of a body that deforms
  SparseVector W;
};

// Rigid bodies by the factors of the block matrix, with B ~ F^-1 (AMG, a polynomial where mass still
// counts, or the diagonal where it prevails):
//   [1 -W; 0 1] [B 0; 0 T^-1] [1 0; -W' 1],   T = [-W; 1]'[F G; G' H][-W; 1].
// T is positive whatever W is. Bodies that deform keep H^-1, and move as a whole with the liquid by
//   + Z E^-1 Z',   Z = [-W; m],   E = Z'[F G; G' H]Z.
class VelocityPreconditioner {
 public:
  // Keeps the reference. Collective.
  VelocityPreconditioner(const SaddleOperator& K, const AmgSettings& settings);

  // For the present H. Whether T and E could be factored. Collective.
  [[nodiscard]] bool refresh();
  void apply(const Vector& ru, const Eigen::VectorXd& rv, Vector& zu, Eigen::VectorXd& zv);

  // Whether viscosity counts for so much that B is a multigrid cycle.
  bool is_multigrid() const { return !mass_prevails_ && !interval_; }
  // Faces without a pressure; null where there are none.
  const PressureFreeRows* pressure_free_rows() const { return pressure_free_.get(); }
  const std::vector<Direction>& directions() const { return directions_; }
  // T of the rigid directions, E of the others, as one matrix.
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
  std::optional<SpectralInterval> interval_;  // where a polynomial stands for multigrid
  std::unique_ptr<PressureFreeRows> pressure_free_;
  std::unique_ptr<Preconditioner> B_;
  std::vector<Direction> directions_;  // rigid ones first
  std::size_t rigid_ = 0;
  Eigen::MatrixXd dragged_;  // W'FW - W'GM - M'G'W
  Eigen::MatrixXd energies_;
  BodyMatrix T_;
  Eigen::LDLT<Eigen::MatrixXd> E_;
};

}  // namespace seiche
