#include "linalg/rigid_motions.h"

#include <Eigen/Eigenvalues>

#include "linalg/stiff_regions.h"

namespace seiche {
namespace {

// About the middle of the region, rotations scaled to be of the size of translations.
std::vector<SparseVector> motions_of(const StiffRegion& region, const FacePlaces& places, int dimension,
                                     const Communicator& ranks) {
  std::array<double, 3> centre{0, 0, 0};
  for (const int i : region.row)
    for (int a = 0; a < 3; ++a) centre[a] += places.position[std::size_t(i)][a] / double(region.size);
  ranks.global_sum(centre);
  double reach = 0;
  for (const int i : region.row)
    for (int a = 0; a < dimension; ++a)
      reach = std::max(reach, std::abs(places.position[std::size_t(i)][a] - centre[a]));
  reach = std::max(1.0, ranks.global_max(reach));
  std::vector<SparseVector> motions(std::size_t(dimension == 2 ? 3 : 6));
  const auto set = [&](int motion, int row, double value) {
    motions[std::size_t(motion)].row.push_back(row), motions[std::size_t(motion)].value.push_back(value);
  };
  for (const int i : region.row) {
    const int a = places.axis[std::size_t(i)], b = (a + 1) % 3, c = (a + 2) % 3;
    const auto arm = [&](int axis) { return (places.position[std::size_t(i)][axis] - centre[axis]) / reach; };
    set(a, i, 1);
    if (dimension == 2) {
      set(2, i, a == 0 ? -arm(1) : arm(0));
    } else {
      set(3 + b, i, arm(c));
      set(3 + c, i, -arm(b));
    }
  }
  return motions;
}

}  // namespace

RigidMotions::RigidMotions(const LinearSystem& F, const FacePlaces& places, int dimension,
                           std::unique_ptr<Preconditioner> B)
    : F_(F), B_(std::move(B)) {
  constexpr std::size_t most = 16;  // regions
  std::vector<SparseVector> candidates;
  for (const StiffRegion& region : find_stiff_regions(F, dimension * (dimension + 1), most))
    for (SparseVector& motion : motions_of(region, places, dimension, F.ranks()))
      candidates.push_back(std::move(motion));
  keep_soft(std::move(candidates));
}

// Those with z'F z much less than z'D z, D the diagonal of F: of the others relaxation takes care.
void RigidMotions::keep_soft(std::vector<SparseVector> candidates) {
  constexpr double soft = 1e-3;
  Vector z(std::size_t(F_.rows())), Fz(z.size());
  for (SparseVector& candidate : candidates) {
    std::fill(z.begin(), z.end(), 0.0);
    add_scaled(z, 1, candidate);
    F_.multiply(z, Fz);
    std::array<double, 2> sums{local_dot(candidate, Fz), 0};
    for (std::size_t n = 0; n < candidate.row.size(); ++n)
      sums[1] += F_.diagonal(candidate.row[n]) * candidate.value[n] * candidate.value[n];
    F_.ranks().global_sum(sums);
    if (!(sums[0] > 0 && sums[0] <= soft * sums[1])) continue;
    FZ_.push_back(nonzeros(Fz));
    Z_.push_back(std::move(candidate));
  }
  const auto n = Eigen::Index(Z_.size());
  Eigen::MatrixXd E(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    std::fill(Fz.begin(), Fz.end(), 0.0);
    add_scaled(Fz, 1, FZ_[std::size_t(k)]);
    for (Eigen::Index l = 0; l < n; ++l) E(l, k) = local_dot(Z_[std::size_t(l)], Fz);
  }
  F_.ranks().global_sum(std::span<double>(E.data(), std::size_t(E.size())));
  invert_energies(0.5 * (E + E.transpose()));
}

// Motions of nested regions may be the same but for rounding: what is next to nothing of a combination is left out.
void RigidMotions::invert_energies(Eigen::MatrixXd E) {
  constexpr double next_to_nothing = 1e-6;
  inverse_.setZero(E.rows(), E.cols());
  if (E.size() == 0) return;
  const Eigen::VectorXd scale = E.diagonal().cwiseSqrt().cwiseInverse();
  E = (scale.asDiagonal() * E * scale.asDiagonal()).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(E);
  for (Eigen::Index k = 0; k < E.rows(); ++k) {
    if (modes.eigenvalues()[k] <= next_to_nothing) continue;
    const Eigen::VectorXd mode = scale.cwiseProduct(modes.eigenvectors().col(k));
    inverse_ += mode * mode.transpose() / modes.eigenvalues()[k];
  }
}

Eigen::VectorXd RigidMotions::transposed(const std::vector<SparseVector>& columns, const Vector& x) const {
  Eigen::VectorXd y(Eigen::Index(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) y[Eigen::Index(k)] = local_dot(columns[k], x);
  F_.ranks().global_sum(std::span<double>(y.data(), columns.size()));
  return y;
}

void RigidMotions::apply(const Vector& r, Vector& z) {
  if (Z_.empty()) return B_->apply(r, z);
  const Eigen::VectorXd pushed = transposed(Z_, r);
  Eigen::VectorXd q = inverse_ * pushed;
  Vector rest = r;
  for (std::size_t k = 0; k < FZ_.size(); ++k) add_scaled(rest, -q[Eigen::Index(k)], FZ_[k]);
  B_->apply(rest, z);
  // Z'(r - F z) of z with what q adds
  for (std::size_t k = 0; k < Z_.size(); ++k) add_scaled(z, q[Eigen::Index(k)], Z_[k]);
  q = inverse_ * (pushed - transposed(FZ_, z));
  for (std::size_t k = 0; k < Z_.size(); ++k) add_scaled(z, q[Eigen::Index(k)], Z_[k]);
}

}  // namespace seiche
