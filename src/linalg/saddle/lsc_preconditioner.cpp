#include "linalg/saddle/lsc_preconditioner.h"

#include <algorithm>
#include <cassert>

#include "linalg/core/matrix_entries.h"
#include "linalg/saddle/wall_distance.h"

namespace seiche {
namespace {

// What a cycle leaves of an error counts twice over: a sweep and four elements a row, enough elsewhere, take 72
// iterations at 40^3, this one 16 (docs/decisions/0017-viscous-speed.md).
AmgSettings thorough(AmgSettings settings) {
  settings.sweeps *= 2;
  settings.elements_per_row = 6;
  return settings;
}

void multiply_by(const Vector& weight, Vector& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= weight[i];
}

}  // namespace

LscPreconditioner::LscPreconditioner(const SaddleOperator& K, const PressureFreeRows* pressure_free,
                                     const AmgSettings& settings)
    : K_(K), pressure_free_(pressure_free) {
  set_weights();
  matrix_ = weighted_laplacian();
  L_ = std::make_unique<LinearSystem>(matrix_, K.liquid().grid(), K.liquid().null_space(), K.ranks());
  B_ = make_boomeramg(*L_, thorough(settings)).preconditioner;
}

// C = M + (diag F - M) max(1, layer / rows from the wall)
void LscPreconditioner::set_weights() {
  constexpr int layer = 4;
  const SaddleSystem& s = K_.system();
  const std::vector<int> rows = rows_from_walls(K_.faces(), s.axis, s.mass, layer);
  weight_.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    weight_[i] = 1 / (s.mass[i] + (K_.faces().diagonal(int(i)) - s.mass[i]) * layer / rows[i]);
}

// D C^-1 D' has the pattern of A.
DistributedMatrix LscPreconditioner::weighted_laplacian() const {
  const DistributedMatrix &A = K_.liquid().pattern(), &Dt = K_.system().Dt;
  DistributedMatrix L{A.first_row, A.global_rows, A.row_start, A.column, Vector(A.column.size(), 0.0)};
  const auto add = [&](const MatrixEntry& e) {
    const auto i = std::size_t(e.row - A.first_row);
    const auto begin = A.column.begin() + A.row_start[i], end = A.column.begin() + A.row_start[i + 1];
    const auto found = std::find(begin, end, e.column);
    assert(found != end);
    if (found != end) L.value[std::size_t(found - A.column.begin())] += e.value;
  };
  std::vector<MatrixEntry> away;
  for (int f = 0; f < Dt.rows(); ++f)
    for (int k = Dt.row_start[f]; k < Dt.row_start[f + 1]; ++k)
      for (int l = Dt.row_start[f]; l < Dt.row_start[f + 1]; ++l) {
        const MatrixEntry e{Dt.column[k], Dt.column[l], Dt.value[k] * Dt.value[l] * weight_[std::size_t(f)]};
        if (e.row >= A.first_row && e.row < A.first_row + A.rows())
          add(e);
        else
          away.push_back(e);
      }
  for (const MatrixEntry& e : send_to_owner(away, A.first_row, std::size_t(A.rows()), K_.ranks())) add(e);
  return L;
}

// x = L^-1 b; b loses what L cannot reach.
void LscPreconditioner::solve_laplacian(Vector& b, Vector& x) {
  L_->project(b);
  x.resize(b.size());
  B_->apply(b, x);
  L_->project(x);
}

// Fw = F w, the loose faces free to follow: w_L = -F_LL^-1 (F w)_L.
void LscPreconditioner::follow_stress(Vector& w, Vector& Fw) const {
  K_.faces().multiply(w, Fw);
  if (!pressure_free_) return;
  Vector x(w.size(), 0.0);
  pressure_free_->add_solved(Fw, x);
  add_scaled(w, -1, x);
  K_.faces().multiply(w, Fw);
}

void LscPreconditioner::apply(const Vector& r, Vector& z) {
  Vector b = r, p, w(weight_.size(), 0.0), Fw(weight_.size()), flux;
  Eigen::VectorXd none = Eigen::VectorXd::Zero(K_.unknowns());
  solve_laplacian(b, p);
  K_.add_gradient(p, w, none);
  multiply_by(weight_, w);
  follow_stress(w, Fw);
  multiply_by(weight_, Fw);
  K_.divergence(Fw, Eigen::VectorXd::Zero(K_.unknowns()), flux);
  solve_laplacian(flux, z);
  for (double& entry : z) entry *= K_.system().schur_scale;
}

}  // namespace seiche
