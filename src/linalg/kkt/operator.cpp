#include "linalg/kkt/operator.h"

#include <algorithm>

#include "linalg/core/shared_columns.h"

namespace seiche {
namespace {

// H is symmetric, so its stored columns serve as rows.
DistributedMatrix share_of(const SparseMatrix& H, const Communicator& ranks) {
  const IndexRange own = share_of_rank(int(H.rows()), ranks);
  DistributedMatrix M;
  M.first_row = own.begin;
  M.global_rows = H.rows();
  for (Row i = own.begin; i < own.end; ++i) {
    const std::size_t diagonal = M.value.size();
    M.column.push_back(i), M.value.push_back(0);
    for (SparseMatrix::InnerIterator it(H, Eigen::Index(i)); it; ++it) {
      if (it.row() == i)
        M.value[diagonal] = it.value();
      else if (it.value() != 0)
        M.column.push_back(it.row()), M.value.push_back(it.value());
    }
    M.row_start.push_back(int(M.column.size()));
  }
  return M;
}

}  // namespace

KktOperator::KktOperator(const KktSystem& system, const LinearSystem& A, const SparseMatrix& H)
    : system_(system), A_(A), rows_(share_of(H, A.ranks())) {
  H_ = std::make_unique<LinearSystem>(rows_, no_grid_, none_, A.ranks());
}

Vector KktOperator::pack(const Vector& p, const Eigen::VectorXd& v) const {
  Vector x(p);
  const auto first = v.begin() + first_unknown();
  x.insert(x.end(), first, first + H_->rows());
  return x;
}

void KktOperator::unpack(const Vector& x, Vector& p, Eigen::VectorXd& v) const {
  const auto cells = x.begin() + pressures();
  p.assign(x.begin(), cells);
  v.setZero(Eigen::Index(rows_.global_rows));
  std::copy(cells, x.end(), v.begin() + first_unknown());
  // Each sum has a single nonzero term, so there is no rounding.
  A_.ranks().global_sum(std::span<double>(v.data(), std::size_t(v.size())));
}

void KktOperator::multiply(const Vector& x, Vector& y) const {
  Vector p, flux(A_.rows()), hv(H_->rows());
  Eigen::VectorXd v;
  unpack(x, p, v);
  A_.multiply(p, flux);
  add_multiplied(system_.J, system_.c1 * v, flux);
  const Vector own(x.begin() + pressures(), x.end());
  H_->multiply(own, hv);
  indefinite_ = indefinite_ || dot(own, hv, A_.ranks()) < 0;
  Eigen::VectorXd force = system_.c1 * multiply_transposed(system_.J, p, A_.ranks());
  for (std::size_t i = 0; i < hv.size(); ++i)
    force[first_unknown() + Eigen::Index(i)] -= system_.c1 / system_.c2 * hv[i];
  y = pack(flux, force);
}

void KktOperator::residual(const Vector& b, const Vector& x, Vector& r) const {
  multiply(x, r);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
}

}  // namespace seiche
