#include "linalg/core/sparse_cholesky.h"

#ifdef SEICHE_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif
#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "linalg/core/openmp_threads.h"

namespace seiche {
namespace {

#ifdef SEICHE_CHOLMOD
struct Llt : Eigen::CholmodSupernodalLLT<SparseMatrix> {
  Llt() { cholmod().print = 0; }  // no output for indefinite matrices
  // Keeps the analysis only.
  void drop_values() {
    if (m_cholmodFactor) cholmod_change_factor(CHOLMOD_PATTERN, 1, 1, 0, 0, m_cholmodFactor, &cholmod());
  }
};
#else
struct Llt : Eigen::SimplicialLLT<SparseMatrix> {
  void drop_values() {}  // Eigen keeps them with the analysis
};
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

// Analyses that no matrix uses at present, the newest last.
struct SparseCholesky::Analyses {
  static constexpr std::size_t most = 64, most_entries = std::size_t(16) << 20;  // entries of patterns: 64 MB

  std::mutex mutex;
  std::vector<std::unique_ptr<Factors>> kept;
  std::size_t entries = 0;

  static Analyses& of_process() {
    static Analyses all;
    return all;
  }

  void give(std::unique_ptr<Factors> factors) {
    if (!factors || factors->outer.empty()) return;
    factors->llt.drop_values();
    const std::lock_guard lock(mutex);
    entries += factors->inner.size();
    kept.push_back(std::move(factors));
    while (kept.size() > most || entries > most_entries) {
      entries -= kept.front()->inner.size();
      kept.erase(kept.begin());
    }
  }

  // Null: not kept.
  std::unique_ptr<Factors> take(const SparseMatrix& A) {
    const std::lock_guard lock(mutex);
    const auto known = std::find_if(kept.rbegin(), kept.rend(), [&](const auto& f) { return f->knows(A); });
    if (known == kept.rend()) return nullptr;
    std::unique_ptr<Factors> factors = std::move(*known);
    entries -= factors->inner.size();
    kept.erase(std::next(known).base());
    return factors;
  }
};

SparseCholesky::SparseCholesky() : factors_(std::make_unique<Factors>()) {}
SparseCholesky::~SparseCholesky() {
  Analyses::of_process().give(std::move(factors_));
}
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::factor(const SparseMatrix& A) {
  keep_openmp_to_this_thread();
  if (!factors_->knows(A)) {
    std::unique_ptr<Factors> known = Analyses::of_process().take(A);
    Analyses::of_process().give(std::exchange(factors_, std::move(known)));
  }
  if (!factors_) {
    factors_ = std::make_unique<Factors>();
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
