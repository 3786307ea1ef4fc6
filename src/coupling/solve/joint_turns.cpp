#include "coupling/solve/joint_turns.h"

#include <fmt/format.h>

#include "coupling/solids/joint_bow.h"
#include "coupling/solve/coupled_problem.h"
#include "linalg/core/dense_factors.h"

namespace seiche {
namespace {

constexpr int most_turns = 15, most_inner_turns = 20, most_worse = 4;
// Share of the tolerance to which the masses alone close the gaps, since that costs little. What is left opens joints
// at the next solve, and moving bodies there to close them changes their momenta.
constexpr double fine = 1e-3;
// Gaps up to this multiple of the tolerance, 1e-5 of a body, are left to the bodies' placement at the next solve.
constexpr double most_excess = 1e5;
// The bow's impulses change velocities by the square of the turn in a step, so few turns settle them.
constexpr int most_bow_turns = 6;
constexpr double bow_settled = 1e-9;  // of the velocities

// The rows of C and their columns where the joints act; elsewhere the identity, whose size does not matter there.
template <int Dim>
SparseMatrix mass_of_jointed(const SolidCoupling<Dim>& coupling) {
  std::vector<char> jointed(std::size_t(coupling.size()), 0);
  std::vector<int> block(std::size_t(coupling.size()), 0);
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b)
    for (int i = coupling.first[b]; i < coupling.first[b + 1]; ++i) block[std::size_t(i)] = int(b);
  std::vector<char> touched(coupling.bodies.size(), 0);
  const SparseMatrix& C = coupling.J.constraints;
  for (int k = 0; k < C.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(C, k); it; ++it) touched[std::size_t(block[std::size_t(k)])] = 1;
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < int(coupling.size()); ++k) {
    const bool own = touched[std::size_t(block[std::size_t(k)])] != 0;
    if (!own) entries.emplace_back(k, k, 1.0);
    for (SparseMatrix::InnerIterator it(coupling.mass, k); it && own; ++it)
      if (touched[std::size_t(block[std::size_t(it.row())])]) entries.emplace_back(int(it.row()), k, it.value());
  }
  SparseMatrix M(coupling.size(), coupling.size());
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

}  // namespace

// Without liquid and elastic solids the masses alone give the solution, but for contact.
template <int Dim>
JointTurns<Dim>::JointTurns(const SolidCoupling<Dim>& coupling, const Communicator& ranks, const Eigen::VectorXd& near)
    : coupling_(coupling), motion_(*coupling.joints), mass_(std::make_shared<BodyMatrix>(ranks)), ranks_(ranks) {
  Eigen::VectorXd push = push_with_bow(coupling);
  const bool rigid = !coupling.potential || coupling.potential == motion_.potential;
  const SparseMatrix M = rigid ? coupling.mass : mass_of_jointed(coupling);
  if (!mass_->set(uncouple_held(coupling, M, push), coupling.J.constraints)) return;
  if (rigid && !coupling.any_held()) motion_.inertia = mass_;
  Eigen::VectorXd v = motion_.any_wet() || coupling.potential ? near : mass_->solve(push);
  v += mass_->prescribed(motion_.rate - coupling.J.constraints * v);
  close(v);
}

// K has all columns: solves with joints use factors, and only those without share columns out.
template <int Dim>
void JointTurns<Dim>::stiffen(const SparseMatrix& K) {
  if (K.nonZeros() == 0) return;
  Eigen::VectorXd none = Eigen::VectorXd::Zero(coupling_.size());
  auto stiff = std::make_shared<BodyMatrix>(ranks_);
  if (!stiff->set(uncouple_held(coupling_, SparseMatrix(coupling_.mass + K), none), coupling_.J.constraints)) return;
  mass_ = std::move(stiff);
  stiffness_ = K;
}

// Velocities change by impulses of the bow with the masses alone.
template <int Dim>
Eigen::VectorXd JointTurns<Dim>::follow_bow(const Eigen::VectorXd& v) const {
  return motion_.bow ? mass_->solve(motion_.bow->follow(v)) : Eigen::VectorXd::Zero(v.size());
}

// Changes shrink by a steady factor, which tells what the next one would be.
template <int Dim>
void JointTurns<Dim>::close(Eigen::VectorXd& v) const {
  double before = 0;
  for (int n = 0; n < most_bow_turns; ++n) {
    const Eigen::VectorXd change = follow_bow(v);
    const double now = change.norm(), next = before > 0 ? now * now / before : now;
    v += change;
    close_gaps(v);
    if (std::min(now, next) <= bow_settled * v.norm()) return;
    before = now;
  }
}

// Fixed point of rate and velocity, with the masses alone. Takes the best rate and v that are met: near singular places
// of closed loops the turns stall above the tolerance.
template <int Dim>
void JointTurns<Dim>::close_gaps(Eigen::VectorXd& v) const {
  const SparseMatrix& C = coupling_.J.constraints;
  Eigen::VectorXd best = v, best_rate = motion_.rate, gaps = motion_.gaps(v);
  double least = motion_.excess(gaps);
  for (int n = 0, worse = 0; least > fine && n < most_inner_turns && worse < most_worse; ++n) {
    motion_.rate -= gaps / motion_.horizon();
    v += mass_->prescribed(motion_.rate - C * v);
    gaps = motion_.gaps(v);
    const double excess = motion_.excess(gaps);
    worse = excess < 0.5 * least ? 0 : worse + 1;
    if (excess < least) least = excess, best = v, best_rate = motion_.rate;
  }
  v = best;
  motion_.rate = best_rate;
}

template <int Dim>
std::string JointTurns<Dim>::correct(Eigen::VectorXd& v, const std::function<bool(const Eigen::VectorXd&)>& is_small) {
  const Eigen::VectorXd gaps = motion_.gaps(v);
  if (!gaps.allFinite()) return "the velocities of jointed bodies are not finite";
  motion_.left = gaps;
  if (motion_.bow) solved_with_ = motion_.bow->impulse();
  const Eigen::VectorXd bent = follow_bow(v);
  done_ = motion_.excess(gaps) <= fine && is_small(bent);
  if (done_) return {};
  Eigen::VectorXd closed = v + bent;
  close_gaps(closed);
  close(closed);
  const Eigen::VectorXd left = motion_.gaps(closed);
  const double excess = motion_.excess(left);
  if (!(excess <= most_excess) || ++turns_ > most_turns)
    return fmt::format("joints {} do not close: {:.2g} m are left after {} turns", motion_.names_of_open(left),
                       motion_.largest_gap(left), turns_);
  const bool stalls = excess > 1 && turns_ > 1 && !(excess < 0.5 * last_excess_);
  last_excess_ = excess;
  if (!stalls && !is_small(closed - v)) {
    ++motion_.turns;
    return {};
  }
  motion_.left = motion_.gaps(closed);
  shift_ = closed - v;
  v = closed;
  done_ = true;
  return {};
}

template <int Dim>
void JointTurns<Dim>::finish(Eigen::VectorXd residual) const {
  if (shift_.size() > 0) {
    residual += coupling_.mass * shift_;
    if (stiffness_.size() > 0) residual += stiffness_ * shift_;
    if (motion_.bow) residual -= motion_.bow->impulse() - solved_with_;
  }
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    if (coupling_.is_held(i)) residual[i] = 0;
  motion_.impulse = mass_->multipliers_against(residual);
  const SparseMatrix& C = coupling_.J.constraints;
  if (Eigen::Index(mass_->constraints().independent().size()) == C.rows()) return;
  // Joints that hold a motion more than once share its load by the least squares.
  motion_.impulse = shortest_least_squares(Eigen::MatrixXd(C.transpose()), C.transpose() * motion_.impulse);
}

template class JointTurns<2>;
template class JointTurns<3>;

}  // namespace seiche
