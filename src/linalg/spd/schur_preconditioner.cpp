#include "linalg/spd/schur_preconditioner.h"

#include <algorithm>
#include <cassert>

#include "linalg/spd/body_coupling.h"

namespace seiche {
namespace {

// "auto" means BoomerAMG. A diagonal is no preconditioner of a Schur complement. PFMG fails in some cases (closed boxes
// of odd sizes; a channel half closed by a flap on its floor, where it is not positive), and nothing would detect that.
std::string choose(const std::string& name, const BlockColumns& J) {
  return name == "auto" || J.any_deforms() ? "boomeramg" : name;
}

}  // namespace

SchurPreconditioner::SchurPreconditioner(const LinearSystem& A, const BlockColumns& J, double c, Vector mass,
                                         const std::string& name, const AmgSettings& settings)
    : A_(A),
      J_(J),
      coupled_(A, J, c),
      mass_(std::move(mass)),
      used_(choose(name, J)),
      settings_(settings),
      deforms_(J.any_deforms()) {}

void SchurPreconditioner::set_liquid(std::unique_ptr<Preconditioner> inverse) {
  assert(!deforms_);
  B_.preconditioner = std::move(inverse);
  mass_.clear();
}

void SchurPreconditioner::set_directions(std::vector<Vector> Jd) {
  Jd_ = std::move(Jd);
  for (Vector& column : Jd_)
    for (const int i : A_.identity_list()) column[std::size_t(i)] = 0;
  Y_.clear();
}

void SchurPreconditioner::make_hierarchy(const BodyMatrix& H) {
  const LinearSystem* system = &A_;
  if (deforms_) {
    matrix_ = std::make_unique<DistributedMatrix>(add_body_coupling(A_, body_coupling(A_, J_, H, coupled_.scale())));
    filled_ = std::make_unique<LinearSystem>(*matrix_, A_.grid(), A_.null_space(), A_.ranks());
    diagonal_ = H.diagonal();
    system = filled_.get();
  }
  B_ = used_ == "boomeramg" ? make_boomeramg(*system, settings_) : make_preconditioner(used_, *system);
}

// Smaller changes cost fewer iterations than a new hierarchy.
bool SchurPreconditioner::is_outdated(const BodyMatrix& H) const {
  return deforms_ && has_changed_much(H.diagonal(), diagonal_);
}

// On an indicator chi the Schur complement is c chi'J H^-1 J'chi (H by its diagonal). If only rigid bodies feel chi,
// the directions Jd supply this term, so S0 gets a small fraction of it.
void SchurPreconditioner::find_constants(const BodyMatrix& H) {
  constexpr double next_to_nothing = 1e-5;
  constants_.clear();
  const Eigen::VectorXd diagonal = H.diagonal();
  const auto& component = A_.null_space().component;
  for (const int c : coupled_.sensed_components()) {
    Vector chi(component.size(), 0.0);
    Constant constant;
    for (std::size_t i = 0; i < component.size(); ++i)
      if (component[i] == c) constant.rows.push_back(int(i)), chi[i] = 1;
    const Eigen::VectorXd force = multiply_transposed(J_, chi, A_.ranks());
    const double schur = coupled_.scale() * force.cwiseAbs2().cwiseQuotient(diagonal).sum();
    constant.inverse = 1 / ((deforms_ ? 1 : next_to_nothing) * schur);
    constants_.push_back(std::move(constant));
  }
}

std::string SchurPreconditioner::refresh(const BodyMatrix& H, const Eigen::MatrixXd& N) {
  if (H.size() > 0) coupled_.set_bodies(H);
  const bool fresh = !B_.preconditioner || is_outdated(H);
  if (fresh) make_hierarchy(H);
  if (!B_.preconditioner) return B_.failure;
  if (H.size() > 0) find_constants(H);
  if (Jd_.empty()) return {};
  if (fresh || Y_.empty() || !constants_.empty()) solve_columns();
  small_.compute(N / coupled_.scale() + JdY_);
  return small_.is_positive() ? "" : "the bodies' part could not be factored";
}

void SchurPreconditioner::solve_columns() {
  const auto n = Eigen::Index(Jd_.size());
  Y_.assign(Jd_.size(), Vector(std::size_t(A_.rows())));
  JdY_.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    apply_without_directions(Jd_[std::size_t(k)], Y_[std::size_t(k)]);
    for (Eigen::Index l = 0; l < n; ++l) JdY_(l, k) = local_dot(Jd_[std::size_t(l)], Y_[std::size_t(k)]);
  }
  A_.ranks().global_sum(std::span<double>(JdY_.data(), std::size_t(JdY_.size())));
  JdY_ = (0.5 * (JdY_ + JdY_.transpose())).eval();
}

// z = S0^-1 r
void SchurPreconditioner::apply_without_directions(const Vector& r, Vector& z) {
  Vector b = r;
  A_.project(b);
  B_.preconditioner->apply(b, z);
  A_.project(z);
  for (std::size_t i = 0; i < mass_.size(); ++i) z[i] += mass_[i] * r[i];
  if (constants_.empty()) return;
  std::vector<double> sums(constants_.size(), 0.0);
  for (std::size_t c = 0; c < sums.size(); ++c)
    for (const int i : constants_[c].rows) sums[c] += r[std::size_t(i)];
  A_.ranks().global_sum(sums);
  for (std::size_t c = 0; c < sums.size(); ++c)
    for (const int i : constants_[c].rows) z[std::size_t(i)] += constants_[c].inverse * sums[c];
}

Eigen::VectorXd SchurPreconditioner::felt(const std::vector<Vector>& columns, const Vector& r) const {
  Eigen::VectorXd y(Eigen::Index(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) y[Eigen::Index(k)] = local_dot(columns[k], r);
  A_.ranks().global_sum(std::span<double>(y.data(), columns.size()));
  return y;
}

// (S0 + c Jd N^-1 Jd')^-1 = S0^-1 - Y (N / c + Jd'Y)^-1 Y'
void SchurPreconditioner::apply(const Vector& r, Vector& z) {
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
