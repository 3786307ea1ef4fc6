#include "coupling/solve/joint_turns.h"

#include <fmt/format.h>

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

template <int Dim>
JointTurns<Dim>::JointTurns(const SolidCoupling<Dim>& coupling, const Communicator& ranks, const Eigen::VectorXd& near)
    : coupling_(coupling), motion_(*coupling.joints), mass_(ranks) {
  Eigen::VectorXd none = Eigen::VectorXd::Zero(coupling.size());
  if (!mass_.set(uncouple_held(coupling, mass_of_jointed(coupling), none), coupling.J.constraints)) return;
  Eigen::VectorXd v = near + mass_.prescribed(motion_.rate - coupling.J.constraints * near);
  close(v);
}

// Fixed point of rate and velocity, with the masses alone. Takes the best rate and v that are met: near singular places
// of closed loops the turns stall above the tolerance.
template <int Dim>
void JointTurns<Dim>::close(Eigen::VectorXd& v) const {
  const SparseMatrix& C = coupling_.J.constraints;
  Eigen::VectorXd best = v, best_rate = motion_.rate, gaps = motion_.gaps(v);
  double least = motion_.excess(gaps);
  for (int n = 0, worse = 0; least > fine && n < most_inner_turns && worse < most_worse; ++n) {
    motion_.rate -= gaps / motion_.horizon();
    v += mass_.prescribed(motion_.rate - C * v);
    gaps = motion_.gaps(v);
    const double excess = motion_.excess(gaps);
    worse = excess < 0.5 * least ? 0 : worse + 1;
    if (excess < least) least = excess, best = v, best_rate = motion_.rate;
  }
  v = best;
  motion_.rate = best_rate;
}

template <int Dim>
std::string JointTurns<Dim>::correct(Eigen::VectorXd& v, double small) {
  const Eigen::VectorXd gaps = motion_.gaps(v);
  if (!gaps.allFinite()) return "the velocities of jointed bodies are not finite";
  motion_.left = gaps;
  done_ = motion_.excess(gaps) <= (small > 0 ? fine : 1);
  if (done_) return {};
  Eigen::VectorXd closed = v;
  close(closed);
  const Eigen::VectorXd left = motion_.gaps(closed);
  const double excess = motion_.excess(left);
  if (!(excess <= most_excess) || ++turns_ > most_turns)
    return fmt::format("joints {} do not close: {:.2g} m are left after {} turns", motion_.names_of_open(left),
                       motion_.largest_gap(left), turns_);
  motion_.turns = turns_;
  if (excess > 1 && turns_ > 1 && !(excess < 0.5 * last_excess_)) small = 1;
  last_excess_ = excess;
  if ((closed - v).norm() > small * v.norm()) return {};
  motion_.left = motion_.gaps(closed);
  shift_ = closed - v;
  v = closed;
  done_ = true;
  return {};
}

template <int Dim>
void JointTurns<Dim>::finish(Eigen::VectorXd residual) const {
  if (shift_.size() > 0) residual += coupling_.mass * shift_;
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    if (coupling_.is_held(i)) residual[i] = 0;
  motion_.impulse = mass_.multipliers_against(residual);
  const SparseMatrix& C = coupling_.J.constraints;
  if (Eigen::Index(mass_.constraints().independent().size()) == C.rows()) return;
  // Joints that hold a motion more than once share its load by the least squares.
  motion_.impulse = shortest_least_squares(Eigen::MatrixXd(C.transpose()), C.transpose() * motion_.impulse);
}

template class JointTurns<2>;
template class JointTurns<3>;

}  // namespace seiche
