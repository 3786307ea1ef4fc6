#include "linalg/core/sparse_cholesky.h"

#ifdef SEICHE_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif
#include <algorithm>
#include <vector>

#include "linalg/core/openmp_threads.h"

namespace seiche {
namespace {

#ifdef SEICHE_CHOLMOD
struct Llt : Eigen::CholmodSupernodalLLT<SparseMatrix> {
  Llt() { cholmod().print = 0; }  // no output for indefinite matrices
};
#else
using Llt = Eigen::SimplicialLLT<SparseMatrix>;
#endif

}  // namespace

struct SparseCholesky::Factors {
  Llt llt;
  std::vector<int> outer, inner;  // pattern of the current ordering

  bool knows(const SparseMatrix& A) const {
    return outer.size() == size_t(A.outerSize() + 1) && inner.size() == size_t(A.nonZeros()) &&
           std::equal(outer.begin(), outer.end(), A.outerIndexPtr()) &&
           std::equal(inner.begin(), inner.end(), A.innerIndexPtr());
  }
};

SparseCholesky::SparseCholesky() : factors_(std::make_unique<Factors>()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::factor(const SparseMatrix& A) {
  keep_openmp_to_this_thread();
  if (!factors_->knows(A)) {
    factors_->outer.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.outerSize() + 1);
    factors_->inner.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    factors_->llt.analyzePattern(A);
  }
  factors_->llt.factorize(A);
  return factors_->llt.info() == Eigen::Success;
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const {
  keep_openmp_to_this_thread();
  return factors_->llt.solve(b);
}

Eigen::MatrixXd SparseCholesky::solve_columns(const Eigen::MatrixXd& B) const {
  keep_openmp_to_this_thread();
  return factors_->llt.solve(B);
}

}  // namespace seiche
