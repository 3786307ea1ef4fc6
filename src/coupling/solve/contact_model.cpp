#include "coupling/solve/contact_model.h"

#include "linalg/core/dense_factors.h"

namespace seiche {

AddedMassModel::AddedMassModel(Eigen::MatrixXd T, const Eigen::VectorXd& v0, const Eigen::VectorXd& g0,
                               std::vector<Freedom> freedom, const SparseMatrix& C, Eigen::VectorXd slack)
    : T_(std::move(T)), v0_(v0), freedom_(std::move(freedom)), C_(C), slack_(std::move(slack)) {
  hold_fixed(T_);
  g0_ = masked(g0);
}

void AddedMassModel::hold_fixed(Eigen::MatrixXd& T) const {
  for (Eigen::Index i = 0; i < T.rows(); ++i) {
    if (freedom_[std::size_t(i)] == Freedom::free) continue;
    const double own = T(i, i);
    T.row(i).setZero();
    T.col(i).setZero();
    T(i, i) = own;
  }
}

Eigen::VectorXd AddedMassModel::masked(Eigen::VectorXd g) const {
  for (Eigen::Index i = 0; i < g.size(); ++i)
    if (freedom_[std::size_t(i)] == Freedom::fixed) g[i] = 0;
  return g;
}

InertiaResponse AddedMassModel::minimise(const SparseMatrix& K, const Eigen::VectorXd& r) {
  Eigen::MatrixXd H = T_;
  if (K.nonZeros() > 0) H += K;
  hold_fixed(H);
  const DenseLlt factor(H);
  if (!factor.succeeded()) return {{}, Shape::indefinite, {}, {}};
  const Eigen::VectorXd v = factor.solve(T_ * v0_ - g0_ + masked(r));
  return respond(C_.rows() > 0 ? constraints_with(factor).moved_onto(v, C_ * v0_) : v);
}

ConstraintRows AddedMassModel::constraints_with(const DenseLlt& factor) const {
  return {C_, factor.solve_columns(Eigen::MatrixXd(C_.transpose()))};
}

bool AddedMassModel::holds(const Eigen::VectorXd& v) const {
  if (C_.rows() == 0) return true;
  constexpr double rounding = 1e-9;
  const Eigen::VectorXd size = C_.cwiseAbs() * (v.cwiseAbs() + v0_.cwiseAbs());
  return ((C_ * (v - v0_)).cwiseAbs().array() <= rounding * size.array() + slack_.array()).all();
}

InertiaResponse AddedMassModel::respond(const Eigen::VectorXd& v) {
  return {{}, Shape::convex, v, g0_ + T_ * (v - v0_)};
}

Eigen::VectorXd AddedMassModel::error(const Eigen::VectorXd& v, const Eigen::VectorXd& g) const {
  const DenseLlt factor(T_);
  const Eigen::VectorXd off = factor.solve(masked(g) - g0_ - T_ * (v - v0_));
  return C_.rows() > 0 ? constraints_with(factor).moved_onto(off, Eigen::VectorXd::Zero(C_.rows())) : off;
}

// BFGS: T <- T - T s s'T/(s'T s) + y y'/(y's) for the step s = v - v0 and the true change y of the gradient along it.
void AddedMassModel::learn(const Eigen::VectorXd& v, const Eigen::VectorXd& g) {
  const Eigen::VectorXd s = v - v0_, y = masked(g) - g0_, Ts = T_ * s;
  const double sTs = s.dot(Ts), ys = y.dot(s);
  constexpr double least = 1e-6;  // share of the expected curvature; less is round-off of the two solves
  if (ys > least * sTs && sTs > 0) T_ += y * y.transpose() / ys - Ts * Ts.transpose() / sTs;
  v0_ = v;
  g0_ = masked(g);
}

namespace {

constexpr std::size_t few = 30;  // bodies
constexpr int most_corrections = 30;
// Tolerance for the agreement of contact and liquid: a multiple of the tolerance of the liquid's solves, and at least
// the accuracy that round-off in the model's factors permits.
constexpr double tolerances = 100, least_tolerance = 1e-9;

// True if nothing touches at the minimum `alone`, which is then the result. Not looked for among few bodies, where the
// model costs less than the search for contacts: with 5 and 6 bodies that do touch, the look took 9 to 17 % of a step.
template <int Dim>
bool without_contact(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions, double horizon,
                     double dt, const SolidCoupling<Dim>& coupling, const InertiaResponse& alone,
                     const ContactOptions& options, ContactInLiquid& r) {
  if (coupling.potential || coupling.bodies.size() <= few) return false;
  std::optional<ContactReport> report = report_without_contact(scene, motions, horizon, dt, alone, options);
  if (report) r.contact = std::move(*report);
  r.agreed = report.has_value();
  return r.agreed;
}

// True where no liquid touches many bodies, which joints hold. Their rows are sparse without the model.
template <int Dim>
bool is_long_dry_chain(const SolidCoupling<Dim>& coupling) {
  return coupling.bodies.size() > few && coupling.joints && !coupling.joints->any_wet();
}

}  // namespace

template <int Dim>
ContactInLiquid solve_contact_in_liquid(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions,
                                        double horizon, double dt, const SolidCoupling<Dim>& coupling,
                                        const SpdSolver& solver, LiquidProblem<Dim>& problem,
                                        const Eigen::VectorXd& speeds, double tolerance, const ContactOptions& options,
                                        const Eigen::VectorXd& start) {
  const double agreed = std::max(tolerances * tolerance, least_tolerance);
  ContactInLiquid r;
  const int n = problem.size();
  const InertiaResponse alone = problem.minimise(SparseMatrix(n, n), Eigen::VectorXd::Zero(n));
  r.contact.failure = alone.failure;
  if (!alone.failure.empty()) return r;
  if (without_contact(scene, motions, horizon, dt, coupling, alone, options, r)) return r;
  r.contact.velocity = start;
  if (is_long_dry_chain(coupling)) return r;
  AddedMassModel model(Eigen::MatrixXd(coupling.mass) + solver.added_mass_estimate(), alone.velocity, alone.gradient,
                       coupling.freedom, coupling.J.constraints,
                       coupling.joints ? coupling.joints->slack : Eigen::VectorXd());
  int newton_iterations = 0;
  while (r.corrections < most_corrections) {
    r.contact =
        solve_contact(scene, motions, horizon, dt, model, options, r.contact.velocity, coupling.potential.get());
    newton_iterations += r.contact.newton_iterations;
    r.agreed = r.corrections == 0 && r.contact.newton_iterations == 0;  // no contact
    if (!r.contact.failure.empty() || r.agreed) return r;
    const InertiaResponse liquid = problem.respond(r.contact.velocity);
    ++r.corrections;
    r.contact.failure = liquid.failure;
    r.contact.newton_iterations = newton_iterations;
    if (!liquid.failure.empty()) return r;
    const double off = model.error(liquid.velocity, liquid.gradient).cwiseProduct(speeds).cwiseAbs().maxCoeff();
    const double fastest = liquid.velocity.cwiseProduct(speeds).cwiseAbs().maxCoeff();
    r.agreed = off <= agreed * (fastest + options.usual_speed);
    if (r.agreed) return r;
    model.learn(liquid.velocity, liquid.gradient);
  }
  return r;
}

#define SEICHE_INSTANTIATE(D)                                                                                    \
  template ContactInLiquid solve_contact_in_liquid<D>(const ContactScene<D>&, const std::vector<ContactMotion>&, \
                                                      double, double, const SolidCoupling<D>&, const SpdSolver&, \
                                                      LiquidProblem<D>&, const Eigen::VectorXd&, double,         \
                                                      const ContactOptions&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
