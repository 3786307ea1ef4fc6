#include "linalg/precond/rigid_motion_deflation.h"

#include "linalg/core/symmetric_eigen.h"
#include "linalg/krylov/krylov.h"

namespace seiche {
namespace {

// True if two motions may touch the same rows or coupled rows.
bool meet(const NearNullVector& a, const NearNullVector& b) {
  return a.region != b.region || std::abs(a.slab - b.slab) <= 2;
}

// F restricted to the rows where a motion is zero.
class RowsAround {
 public:
  RowsAround(const LinearSystem& F, const SparseVector& motion) : F_(F), within_(motion.row) {}
  void multiply(const Vector& x, Vector& y) const {
    F_.multiply(x, y);
    for (const int i : within_) y[std::size_t(i)] = 0;
  }
  void residual(const Vector& b, const Vector& x, Vector& r) const {
    multiply(x, r);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  }

 private:
  const LinearSystem& F_;
  const std::vector<int>& within_;
};

struct Relaxation {
  const LinearSystem& F;
  void apply(const Vector& r, Vector& z) const {
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = r[i] / F.diagonal(int(i));
  }
};

}  // namespace

RigidMotionDeflation::RigidMotionDeflation(const LinearSystem& F, const FacePlaces& places, int dimension,
                                           std::unique_ptr<Preconditioner> B)
    : F_(F), B_(std::move(B)), Z_(find_near_null_space(F, places, dimension)) {
  extend();
  SparseProduct multiply(F);
  for (const NearNullVector& m : Z_) FZ_.push_back(multiply(m.z));
  invert_energies(energies());
}

// Extends the motion of a whole region into the surrounding liquid by approximately solving F there. With the
// surrounding liquid at rest, the energy of a region of n cells would be too large by a factor of about n. Only the
// first `most` motions are extended, since extended ones are no longer sparse; small entries are dropped.
void RigidMotionDeflation::extend() {
  constexpr int most = 24, steps = 12;
  constexpr double enough = 0.05, next_to_nothing = 0.01;
  Vector z(std::size_t(F_.rows())), x(z.size()), b(z.size());
  int extended = 0;
  for (NearNullVector& m : Z_) {
    if (!m.whole || ++extended > most) continue;
    const RowsAround around(F_, m.z);
    std::fill(z.begin(), z.end(), 0.0);
    std::fill(x.begin(), x.end(), 0.0);
    add_scaled(z, -1, m.z);
    around.multiply(z, b);
    Relaxation D{F_};
    (void)conjugate_gradients(around, D, b, x, {enough * norm(b, F_.ranks()), steps}, F_.ranks());
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = std::abs(x[i] - z[i]) > next_to_nothing ? x[i] - z[i] : 0;
    m.z = nonzeros(z);
  }
}

// Z'F Z
Eigen::MatrixXd RigidMotionDeflation::energies() const {
  const auto n = Eigen::Index(Z_.size());
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(n, n);
  Vector Fz(std::size_t(F_.rows()));
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = std::size_t(k);
    add_scaled(Fz, 1, FZ_[at]);
    for (Eigen::Index l = 0; l < n; ++l)
      if (meet(Z_[at], Z_[std::size_t(l)])) E(l, k) = local_dot(Z_[std::size_t(l)].z, Fz);
    for (const int i : FZ_[at].row) Fz[std::size_t(i)] = 0;
  }
  F_.ranks().global_sum(std::span<double>(E.data(), std::size_t(E.size())));
  return 0.5 * (E + E.transpose());
}

// Pseudo-inverse of the scaled Z'F Z. Motions of nested regions may agree up to round-off, so small eigenvalues are
// dropped.
void RigidMotionDeflation::invert_energies(Eigen::MatrixXd E) {
  constexpr double next_to_nothing = 1e-6;
  inverse_.setZero(E.rows(), E.cols());
  if (E.size() == 0) return;
  const Eigen::VectorXd scale = E.diagonal().cwiseSqrt().cwiseInverse();
  E = (scale.asDiagonal() * E * scale.asDiagonal()).eval();
  const SymmetricEigen modes = symmetric_eigen(E);
  for (Eigen::Index k = 0; k < E.rows(); ++k) {
    if (modes.values[k] <= next_to_nothing) continue;
    const Eigen::VectorXd mode = scale.cwiseProduct(modes.vectors.col(k));
    inverse_ += mode * mode.transpose() / modes.values[k];
  }
}

Eigen::VectorXd RigidMotionDeflation::summed(Eigen::VectorXd y) const {
  F_.ranks().global_sum(std::span<double>(y.data(), std::size_t(y.size())));
  return y;
}

void RigidMotionDeflation::apply(const Vector& r, Vector& z) {
  if (Z_.empty()) return B_->apply(r, z);
  const auto n = Eigen::Index(Z_.size());
  Eigen::VectorXd pushed(n), left(n);
  for (Eigen::Index k = 0; k < n; ++k) pushed[k] = local_dot(Z_[std::size_t(k)].z, r);
  const Eigen::VectorXd first = inverse_ * summed(pushed);
  Vector rest = r;
  for (Eigen::Index k = 0; k < n; ++k) add_scaled(rest, -first[k], FZ_[std::size_t(k)]);
  B_->apply(rest, z);
  for (Eigen::Index k = 0; k < n; ++k)
    left[k] = local_dot(Z_[std::size_t(k)].z, rest) - local_dot(FZ_[std::size_t(k)], z);
  const Eigen::VectorXd q = first + inverse_ * summed(left);
  for (Eigen::Index k = 0; k < n; ++k) add_scaled(z, q[k], Z_[std::size_t(k)].z);
}

}  // namespace seiche
