#include "linalg/kkt/preconditioner.h"

#include <algorithm>

#include "linalg/krylov/krylov.h"

namespace seiche {

KktPreconditioner::KktPreconditioner(const KktOperator& K, const BodyMatrix& H, const AmgSettings& settings,
                                     Motions& motions)
    : K_(K),
      motions_(motions),
      schur_(K.liquid(), K.system().J, K.system().c1 * K.system().c2, {}, "boomeramg", settings) {
  AmgSettings own = settings;
  own.component = components();
  own.components = 2 * K.system().dimension + (K.system().dimension == 3 ? 3 : 1);
  B_ = make_boomeramg(K.solid(), own).preconditioner;
  if (motions_.empty()) find_motions(H.size());
  const auto n = Eigen::Index(motions_.size());
  Eigen::MatrixXd N(n, n);
  std::vector<Vector> Jd;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd Hm = H.multiply(motions_[std::size_t(k)]);
    for (Eigen::Index l = 0; l < n; ++l) N(l, k) = motions_[std::size_t(l)].dot(Hm);
    Jd.emplace_back(std::size_t(K.pressures()), 0.0);
    add_multiplied(K.system().J, motions_[std::size_t(k)], Jd.back());
  }
  energies_.compute(N);
  indefinite_ = n > 0 && !energies_.is_positive();
  if (indefinite_) failure_ = "the bodies' motions have no positive energy";
  schur_.set_directions(std::move(Jd));
  if (failure_.empty()) failure_ = schur_.refresh(H, N);
}

// Component of each local row of H for unknown-based AMG: axes of nodes first, then the unknowns of rigid bodies.
std::vector<int> KktPreconditioner::components() const {
  const KktSystem& s = K_.system();
  std::vector<int> all;
  for (const ColumnBlock& b : s.J.blocks)
    for (int k = 0; k < b.width; ++k) all.push_back(b.deforms() ? k % s.dimension : s.dimension + k);
  const auto first = all.begin() + K_.first_unknown();
  return {first, first + K_.solid().rows()};
}

void KktPreconditioner::find_motions(int unknowns) {
  const BlockColumns& J = K_.system().J;
  const std::vector<int> first = J.first_columns();
  for (std::size_t b = 0; b < J.blocks.size(); ++b) {
    if (J.blocks[b].deforms()) {
      add_responses(J.blocks[b], first[b], unknowns);
      continue;
    }
    for (int k = 0; k < J.blocks[b].width; ++k) motions_.push_back(Eigen::VectorXd::Unit(unknowns, first[b] + k));
  }
}

// Solves H m ~ load for each load. Low accuracy suffices, since the motions need only span the soft directions of H.
void KktPreconditioner::add_responses(const ColumnBlock& block, int first, int unknowns) {
  constexpr double enough = 1e-2;
  constexpr int at_most = 40;
  const std::size_t begin = motions_.size();
  const Communicator& ranks = K_.liquid().ranks();
  for (Eigen::Index k = 0; k < block.loads.cols(); ++k) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns);
    load.segment(first, block.width) = block.loads.col(k).normalized();
    const auto own = load.begin() + K_.first_unknown();
    const Vector b(own, own + K_.solid().rows());
    Vector x(b.size(), 0.0);
    (void)conjugate_gradients(K_.solid(), *B_, b, x, {enough * norm(b, ranks), at_most}, ranks);
    Vector packed(std::size_t(K_.pressures()), 0.0), p;
    packed.insert(packed.end(), x.begin(), x.end());
    K_.unpack(packed, p, motions_.emplace_back());
  }
  orthonormalise(first, block.width, begin);
}

// Replaces one body's motions by an orthonormal basis of their span.
void KktPreconditioner::orthonormalise(int first, int width, std::size_t begin) {
  Eigen::MatrixXd own(width, Eigen::Index(motions_.size() - begin));
  for (Eigen::Index k = 0; k < own.cols(); ++k)
    own.col(k) = motions_[begin + std::size_t(k)].segment(first, width).normalized();
  const Eigen::MatrixXd Q = orthonormal_basis(own);
  const Eigen::Index n = K_.solid().pattern().global_rows;
  motions_.resize(begin);
  for (Eigen::Index k = 0; k < Q.cols(); ++k) {
    motions_.push_back(Eigen::VectorXd::Zero(n));
    motions_.back().segment(first, width) = Q.col(k);
  }
}

// Block of the bodies: c2/c1 (B + M N^-1 M') with B ~ H^-1, M the motions and N = M'H M.
void KktPreconditioner::apply(const Vector& r, Vector& z) {
  const Vector rp(r.begin(), r.begin() + K_.pressures()), rv(r.begin() + K_.pressures(), r.end());
  Vector zp, zv(rv.size());
  schur_.apply(rp, zp);
  B_->apply(rv, zv);
  const auto n = Eigen::Index(motions_.size());
  Eigen::VectorXd felt = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (std::size_t i = 0; i < rv.size(); ++i)
      felt[k] += motions_[std::size_t(k)][K_.first_unknown() + Eigen::Index(i)] * rv[i];
  if (n > 0) K_.liquid().ranks().global_sum(std::span<double>(felt.data(), std::size_t(n)));
  const Eigen::VectorXd amount = n > 0 ? energies_.solve(felt) : felt;
  for (Eigen::Index k = 0; k < n; ++k)
    for (std::size_t i = 0; i < zv.size(); ++i)
      zv[i] += amount[k] * motions_[std::size_t(k)][K_.first_unknown() + Eigen::Index(i)];
  z = zp;
  for (const double value : zv) z.push_back(K_.system().c2 / K_.system().c1 * value);
}

}  // namespace seiche
