#include "linalg/saddle_pressure.h"

#include <algorithm>

#include "linalg/body_coupling.h"

namespace seiche {
namespace {

bool any_deforms(const BlockColumns& J) {
  return std::any_of(J.blocks.begin(), J.blocks.end(), [](const ColumnBlock& b) { return b.deforms(); });
}

// The diagonal alone is no preconditioner of a Schur complement, however small. PFMG may fail on closed boxes of odd
// sizes, and would go unnoticed here.
std::string choose(const std::string& name, const SaddleOperator& K) {
  const std::string chosen = choose_preconditioner(name, K.liquid());
  const bool poor = chosen == "none" || K.liquid().null_space().count > 0 || K.unknowns() > 0;
  return name == "auto" && poor ? "boomeramg" : chosen;
}

double local_dot(const Vector& x, const Vector& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace

PressurePreconditioner::PressurePreconditioner(const SaddleOperator& K, const VelocityPreconditioner& velocity,
                                               const std::string& name, const AmgSettings& settings)
    : K_(K),
      velocity_(velocity),
      coupled_(K.liquid(), K.system().J, 1 / K.system().schur_scale),
      used_(choose(name, K)),
      settings_(settings),
      deforms_(any_deforms(K.system().J)) {
  if (deforms_) used_ = "boomeramg";
  find_jd();
}

// Jd = J m - D W
void PressurePreconditioner::find_jd() {
  for (const Direction& d : velocity_.directions()) {
    Vector w = d.W;
    for (double& entry : w) entry = -entry;
    Jd_.emplace_back();
    K_.divergence(w, d.m, Jd_.back());
    for (const int i : K_.liquid().identity_list()) Jd_.back()[std::size_t(i)] = 0;
  }
}

void PressurePreconditioner::make_hierarchy() {
  const LinearSystem* system = &K_.liquid();
  if (deforms_) {
    matrix_ = std::make_unique<DistributedMatrix>(
        add_body_coupling(*system, K_.system().J, K_.bodies().matrix(), 1 / K_.system().schur_scale));
    filled_ = std::make_unique<LinearSystem>(*matrix_, system->grid(), system->null_space(), K_.ranks());
    diagonal_ = K_.bodies().matrix().diagonal();
    system = filled_.get();
  }
  B_ = used_ == "boomeramg" ? make_boomeramg(*system, settings_) : make_preconditioner(used_, *system);
}

// Stiffness or contact has come or gone; less costs fewer iterations than a new hierarchy takes.
bool PressurePreconditioner::is_outdated() const {
  constexpr double much = 4;
  if (!deforms_) return false;
  const Eigen::ArrayXd change = K_.bodies().matrix().diagonal().array() / diagonal_.array();
  return change.maxCoeff() > much || change.minCoeff() < 1 / much;
}

// S is chi'J H^-1 J'chi there. Where only rigid bodies feel them, directions bring that in: S0 is to be next to
// nothing.
void PressurePreconditioner::find_constants() {
  constexpr double next_to_nothing = 1e-5;
  constants_.clear();
  const auto& component = K_.liquid().null_space().component;
  const SparseMatrix& H = K_.bodies().matrix();
  for (const int c : coupled_.sensed_components()) {
    Vector chi(component.size(), 0.0);
    Constant constant;
    for (std::size_t i = 0; i < component.size(); ++i)
      if (component[i] == c) constant.rows.push_back(int(i)), chi[i] = 1;
    const Eigen::VectorXd force = multiply_transposed(K_.system().J, chi, K_.ranks());
    const double schur = force.cwiseAbs2().cwiseQuotient(H.diagonal()).sum();
    constant.inverse = 1 / ((deforms_ ? 1 : next_to_nothing) * schur);
    constants_.push_back(std::move(constant));
  }
}

std::string PressurePreconditioner::refresh() {
  if (K_.unknowns() > 0) coupled_.set_bodies(K_.bodies());
  const bool fresh = !B_.preconditioner || is_outdated();
  if (fresh) make_hierarchy();
  if (!B_.preconditioner) return B_.failure;
  if (Jd_.empty()) return {};
  find_constants();
  if (fresh || !constants_.empty()) solve_columns();
  small_.compute(velocity_.direction_energies() + JdY_);
  return small_.info() == Eigen::Success && small_.isPositive() ? "" : "the bodies' part could not be factored";
}

void PressurePreconditioner::solve_columns() {
  const auto n = Eigen::Index(Jd_.size());
  Y_.assign(Jd_.size(), Vector(std::size_t(K_.pressures())));
  JdY_.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    apply_without_directions(Jd_[std::size_t(k)], Y_[std::size_t(k)]);
    for (Eigen::Index l = 0; l < n; ++l) JdY_(l, k) = local_dot(Jd_[std::size_t(l)], Y_[std::size_t(k)]);
  }
  K_.ranks().global_sum(std::span<double>(JdY_.data(), std::size_t(JdY_.size())));
  JdY_ = (0.5 * (JdY_ + JdY_.transpose())).eval();
}

// z = S0^-1 r
void PressurePreconditioner::apply_without_directions(const Vector& r, Vector& z) {
  const LinearSystem& A = K_.liquid();
  Vector b = r;
  A.project(b);
  B_.preconditioner->apply(b, z);
  A.project(z);
  const Vector& mass = K_.system().schur_mass;
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = z[i] / K_.system().schur_scale + mass[i] * r[i];
  if (constants_.empty()) return;
  std::vector<double> sums(constants_.size(), 0.0);
  for (std::size_t c = 0; c < sums.size(); ++c)
    for (const int i : constants_[c].rows) sums[c] += r[std::size_t(i)];
  K_.ranks().global_sum(sums);
  for (std::size_t c = 0; c < sums.size(); ++c)
    for (const int i : constants_[c].rows) z[std::size_t(i)] += constants_[c].inverse * sums[c];
}

Eigen::VectorXd PressurePreconditioner::felt(const std::vector<Vector>& columns, const Vector& r) const {
  Eigen::VectorXd y(Eigen::Index(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) y[Eigen::Index(k)] = local_dot(columns[k], r);
  K_.ranks().global_sum(std::span<double>(y.data(), columns.size()));
  return y;
}

// (S0 + Jd N^-1 Jd')^-1 = S0^-1 - Y (N + Jd'Y)^-1 Y'
void PressurePreconditioner::apply(const Vector& r, Vector& z) {
  Vector b = r;
  project(b);
  z.resize(r.size());
  apply_without_directions(b, z);
  if (!Y_.empty()) {
    const Eigen::VectorXd q = small_.solve(felt(Y_, b));
    for (std::size_t k = 0; k < Y_.size(); ++k) add_scaled(z, -q[Eigen::Index(k)], Y_[k]);
  }
  project(z);
}

}  // namespace seiche
