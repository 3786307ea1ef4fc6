#include "linalg/saddle/velocity.h"

#include <algorithm>

#include "linalg/krylov/krylov.h"
#include "linalg/precond/rigid_motion_deflation.h"

namespace seiche {
namespace {

// If off-diagonal sums are below this fraction of the diagonal, diag(F) is within 20 % of F.
constexpr double small_share = 0.2;
// Polynomial in place of multigrid: fraction of an error that it leaves, and the number of steps up to which it is
// cheaper than a hierarchy (mu dt/(rho h^2) up to about 5; docs/decisions/0017-viscous-speed.md).
constexpr double share_left = 0.1;
constexpr int most_steps = 16;
// Coarsest level of BoomerAMG: Gaussian elimination (hypre's number), since F is not singular. A single relaxation
// would not reduce motions of a high-viscosity inclusion as a whole.
constexpr int elimination = 9;

bool is_mass_dominated(const LinearSystem& F) {
  double worst = 0;
  const auto& start = F.pattern().row_start;
  for (int i = 0; i < F.rows(); ++i) {
    double others = 0;
    for (int k = start[i] + 1; k < start[i + 1]; ++k) others += std::abs(F.values()[k]);
    worst = std::max(worst, others / F.diagonal(i));
  }
  return F.ranks().global_max(worst) < small_share;
}

int count_axes(const std::vector<int>& axis, const Communicator& ranks) {
  const int highest = axis.empty() ? 0 : *std::max_element(axis.begin(), axis.end());
  return 1 + int(ranks.global_max(std::int64_t(highest)));
}

// G m
Vector multiply(const BlockColumns& G, const Eigen::VectorXd& m, int rows) {
  Vector y(std::size_t(rows), 0.0);
  add_multiplied(G, m, y);
  return y;
}

// Orthonormal responses of a deformable block to its loads.
Eigen::MatrixXd modes_of(const ColumnBlock& b, int first, const BodyMatrix& H) {
  Eigen::MatrixXd own(b.width, b.loads.cols());
  for (Eigen::Index k = 0; k < b.loads.cols(); ++k) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(H.size());
    load.segment(first, b.width) = b.loads.col(k).normalized();
    own.col(k) = H.solve(load).segment(first, b.width).normalized();
  }
  return orthonormal_basis(own);
}

}  // namespace

VelocityPreconditioner::VelocityPreconditioner(const SaddleOperator& K, const AmgSettings& settings)
    : K_(K), mass_prevails_(is_mass_dominated(K.faces())), T_(K.ranks()) {
  const SpectralInterval interval = estimate_interval(K.faces());
  const int steps = chebyshev_steps(interval, share_left);
  if (mass_prevails_) {
    B_ = make_preconditioner("none", K.faces()).preconditioner;
  } else if (steps <= most_steps) {
    interval_ = interval;
    B_ = std::make_unique<Chebyshev>(K.faces(), interval, steps);
    correct_pressure_free_faces();
  } else {
    make_multigrid(settings);
    correct_pressure_free_faces();
    deflate_viscous_regions();
  }
  if (K.unknowns() > 0) find_directions();
}

void VelocityPreconditioner::make_multigrid(AmgSettings settings) {
  settings.component = K_.system().axis;
  settings.components = count_axes(settings.component, K_.ranks());
  settings.relax_coarsest = elimination;
  B_ = make_boomeramg(K_.faces(), settings).preconditioner;
}

void VelocityPreconditioner::correct_pressure_free_faces() {
  std::vector<char> pressure_free(std::size_t(K_.velocities()));
  const std::vector<int>& start = K_.system().Dt.row_start;
  for (std::size_t i = 0; i < pressure_free.size(); ++i) pressure_free[i] = start[i] == start[i + 1];
  if (!K_.ranks().any(std::find(pressure_free.begin(), pressure_free.end(), 1) != pressure_free.end())) return;
  pressure_free_ = std::make_unique<PressureFreeRows>(K_.faces(), pressure_free);
  good_ = pressure_free_->good();
  B_ = std::make_unique<PressureFreeFaces>(K_.faces(), *pressure_free_, std::move(B_));
}

void VelocityPreconditioner::deflate_viscous_regions() {
  const SaddleSystem& s = K_.system();
  if (K_.ranks().any(s.position.size() != s.axis.size())) return;
  const int dimension = count_axes(s.axis, K_.ranks());
  if (dimension < 2) return;  // a domain one cell thick
  B_ = std::make_unique<RigidMotionDeflation>(K_.faces(), FacePlaces{s.axis, s.position}, dimension, std::move(B_));
}

void VelocityPreconditioner::find_directions() {
  const BlockColumns& G = K_.system().G;
  const std::vector<int> first = G.first_columns();
  const int n = K_.unknowns();
  for (std::size_t b = 0; b < G.blocks.size(); ++b)
    for (int k = 0; k < G.blocks[b].width && !K_.system().J.blocks[b].deforms(); ++k)
      directions_.push_back({first[b] + k, Eigen::VectorXd::Unit(n, first[b] + k), {}});
  rigid_ = directions_.size();
  for (std::size_t b = 0; b < G.blocks.size(); ++b) {
    const ColumnBlock& block = K_.system().J.blocks[b];
    if (!block.deforms()) continue;
    const Eigen::MatrixXd modes = modes_of(block, first[b], K_.bodies());
    for (Eigen::Index k = 0; k < modes.cols(); ++k) {
      directions_.push_back({-1, Eigen::VectorXd::Zero(n), {}});
      directions_.back().m.segment(first[b], block.width) = modes.col(k);
    }
  }
  std::vector<Vector> GM;
  for (const Direction& d : directions_) GM.push_back(multiply(G, d.m, K_.velocities()));
  std::vector<SparseVector> W = extend(GM);
  for (std::size_t k = 0; k < W.size(); ++k) directions_[k].W = std::move(W[k]);
  multiply_out(GM);
}

// Solves F W ~ G m for each direction. An accurate W saves outer iterations if only viscosity couples light bodies.
std::vector<SparseVector> VelocityPreconditioner::extend(const std::vector<Vector>& GM) const {
  constexpr double enough = 1e-3, roughly = 1e-2;
  constexpr int at_most = 12;
  if (interval_) return solve_locally(K_.faces(), *interval_, chebyshev_steps(*interval_, roughly), GM);
  std::vector<SparseVector> all;
  for (const Vector& Gm : GM) {
    Vector W(Gm.size(), 0.0);
    const double target = enough * norm(Gm, K_.ranks());
    if (target > 0) (void)conjugate_gradients(K_.faces(), *B_, Gm, W, {target, at_most}, K_.ranks());
    all.push_back(nonzeros(W));
  }
  return all;
}

void VelocityPreconditioner::multiply_out(const std::vector<Vector>& GM) {
  const auto n = Eigen::Index(directions_.size());
  dragged_.setZero(n, n);
  Vector W, FW(std::size_t(K_.velocities()));
  for (Eigen::Index k = 0; k < n; ++k) {
    const SparseVector& own = directions_[std::size_t(k)].W;
    W.assign(FW.size(), 0.0);
    add_scaled(W, 1, own);
    K_.faces().multiply(W, FW);
    add_scaled(FW, -1, GM[std::size_t(k)]);
    for (Eigen::Index l = 0; l < n; ++l)
      dragged_(l, k) = local_dot(directions_[std::size_t(l)].W, FW) - local_dot(own, GM[std::size_t(l)]);
  }
  K_.ranks().global_sum(std::span<double>(dragged_.data(), std::size_t(dragged_.size())));
  dragged_ = (0.5 * (dragged_ + dragged_.transpose())).eval();
}

// H + C, with C the entries of dragged_ for the rigid unknowns.
SparseMatrix VelocityPreconditioner::body_part() const {
  const SparseMatrix& H = K_.bodies().matrix();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < rigid_; ++k)
    for (std::size_t l = 0; l < rigid_; ++l)
      entries.emplace_back(directions_[k].unknown, directions_[l].unknown, dragged_(Eigen::Index(k), Eigen::Index(l)));
  SparseMatrix C(H.rows(), H.cols());
  C.setFromTriplets(entries.begin(), entries.end());
  return H + C;
}

bool VelocityPreconditioner::refresh() {
  if (!good_) return false;
  const auto n = Eigen::Index(directions_.size()), r = Eigen::Index(rigid_);
  energies_ = dragged_;
  if (n == 0) return true;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd Hm = K_.bodies().matrix() * directions_[std::size_t(k)].m;
    for (Eigen::Index l = 0; l < n; ++l) energies_(l, k) += directions_[std::size_t(l)].m.dot(Hm);
  }
  energies_.topRightCorner(r, n - r).setZero();
  energies_.bottomLeftCorner(n - r, r).setZero();
  if (n > r) E_.compute(energies_.bottomRightCorner(n - r, n - r));
  return T_.set(body_part(), K_.bodies().constraints().rows()) && (n == r || E_.is_positive());
}

void VelocityPreconditioner::apply(const Vector& ru, const Eigen::VectorXd& rv, Vector& zu, Eigen::VectorXd& zv) {
  zu.resize(ru.size());
  B_->apply(ru, zu);
  zv.setZero(K_.unknowns());
  const auto n = Eigen::Index(directions_.size()), r = Eigen::Index(rigid_);
  if (n == 0) return;
  Eigen::VectorXd felt(n);  // [-W; m]' (ru, rv); for rigid directions -W'ru only, the rest enters through T
  for (Eigen::Index k = 0; k < n; ++k) {
    felt[k] = -local_dot(directions_[std::size_t(k)].W, ru);
  }
  K_.ranks().global_sum(std::span<double>(felt.data(), std::size_t(n)));
  Eigen::VectorXd b = rv, amount(n);
  for (Eigen::Index k = 0; k < r; ++k) b[directions_[std::size_t(k)].unknown] += felt[k];
  zv = T_.solve(b);
  for (Eigen::Index k = 0; k < r; ++k) amount[k] = zv[directions_[std::size_t(k)].unknown];
  if (n > r) {
    for (Eigen::Index k = r; k < n; ++k) felt[k] += directions_[std::size_t(k)].m.dot(rv);
    amount.tail(n - r) = E_.solve(felt.tail(n - r));
    for (Eigen::Index k = r; k < n; ++k) zv += amount[k] * directions_[std::size_t(k)].m;
  }
  for (Eigen::Index k = 0; k < n; ++k) add_scaled(zu, -amount[k], directions_[std::size_t(k)].W);
}

}  // namespace seiche
