#pragma once
// Extends a preconditioner B of A to S = A + c J H^-1 J' for any H, by deflation (A-DEF2 of Tang, Nabben, Vuik,
// Erlangga 2009). The deflation vectors are Z = B J, cut to the neighbourhood of each body. If Z is not cut and H ->
// infinity, B is unchanged. For H -> 0 (massless bodies), Z spans the directions that A alone lacks.
#include <optional>

#include "linalg/core/dense_factors.h"
#include "linalg/core/sparse_ldlt.h"
#include "linalg/core/sparse_vector.h"
#include "linalg/precond/preconditioners.h"
#include "linalg/spd/body_regions.h"
#include "linalg/spd/coupled_system.h"

namespace seiche {

// Up to this number of bodies, columns of Z are not cut.
inline constexpr std::size_t few_bodies = 2;

class Deflation {
 public:
  // Keeps references. Collective.
  Deflation(const CoupledSystem& S, Preconditioner& B);

  // Updates the factors for the current H of S. False if E = Z' S Z could not be factored. Collective.
  [[nodiscard]] bool refresh();

  // z = (I - Q S) B r + Q r, Q = Z E^-1 Z'. Collective.
  void apply(const Vector& r, Vector& z);

  // x += Q (b - S x): makes the residual orthogonal to Z, which apply() requires. Collective.
  void prepare(const Vector& b, Vector& x);

  // (J'Z)(Z'AZ)^-1(Z'J), the Galerkin approximation of J'A^-1 J, without closed components.
  Eigen::MatrixXd estimate_schur() const;

  int applications_of_B() const { return applications_; }  // during set-up

 private:
  // Rows around a body in which its columns of Z and of A Z may be nonzero, ascending; the factor of each kept entry.
  struct Neighbourhood {
    std::vector<int> kept, touched;
    std::vector<double> fading;  // empty: 1 everywhere
  };
  struct Regions {
    std::vector<Neighbourhood> bodies;
    std::vector<int> color;     // bodies of one share applications of B
    std::vector<int> separate;  // ranges touched by bodies of one do not overlap
  };
  Regions find_regions() const;
  void find_modes();
  int mode_count(std::size_t block) const;
  void make_columns();
  void add_columns(const Regions& regions, const std::vector<std::size_t>& members, int mode);
  void cut_columns(const Regions& regions, const std::vector<std::size_t>& members, const Vector& z);
  void add_component_columns();
  void multiply_out();
  void regularize();
  Eigen::Map<const Eigen::VectorXd> regularization(Eigen::Index count) const;  // of the first columns
  Eigen::VectorXd transposed(const std::vector<SparseVector>& columns, const Vector& x) const;
  bool multiply_small();
  bool factor_extended();
  void factor_own();
  bool factor_added_mass();
  Eigen::VectorXd solve_small(const Eigen::VectorXd& f) const;
  Eigen::VectorXd felt_by_columns(const Eigen::VectorXd& w) const;
  void subtract(const Eigen::VectorXd& q, Vector& z) const;

  const CoupledSystem& S_;
  Preconditioner& B_;
  std::vector<Eigen::MatrixXd> modes_;  // per deformable block
  std::vector<SparseVector> Z_, AZ_;
  std::vector<Eigen::Triplet<double>> zaz_, jz_;  // Z' A Z and J' Z
  int body_columns_ = 0;                          // columns of Z that belong to bodies; closed components follow
  std::vector<double> regularization_;            // of the diagonal of Z'AZ
  int applications_ = 0;
  std::optional<ScaledLdlt> small_;  // of E
  Eigen::MatrixXd weighed_;          // c H^-1 J'Z
  SparseLdlt extended_;              // or of [[Z'AZ, (J'Z)'], [J'Z, -H/c]]
  std::optional<DenseLlt> own_;      // or, where nearly all columns overlap: Z'AZ = LL',
  Eigen::MatrixXd W_, added_;        // W = L^-1 (J'Z)', W'W,
  DenseLlt added_mass_;              // H/c + W'W
};

}  // namespace seiche
