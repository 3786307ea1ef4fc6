#include "solid/contact/reflections.h"

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

constexpr int most_sweeps = 1000;
constexpr double swept = 1e-10;  // of the fastest approach: smaller changes of speed end the sweeps

// Rounds of reflections, and the share of the fastest approach that the last ones leave to an inelastic impact.
constexpr int most_rounds = 200;
constexpr double settled = 1e-3;

double fastest_approach(const Eigen::VectorXd& w) {
  return w.size() == 0 ? 0 : std::max(0.0, -w.minCoeff());
}

// Projected Gauss-Seidel over the pairs for which `acts` is set; the others have no impulse.
Eigen::VectorXd stop(const Eigen::MatrixXd& A, const Eigen::VectorXd& w, const Eigen::Array<bool, -1, 1>& acts) {
  Eigen::VectorXd l = Eigen::VectorXd::Zero(w.size()), u = w;
  const double end = swept * fastest_approach(w);
  for (int n = 0; n < most_sweeps; ++n) {
    double change = 0;
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      if (!acts[i] || A(i, i) <= 0) continue;
      const double step = std::max(-l[i], -u[i] / A(i, i));
      l[i] += step;
      u += step * A.col(i);
      change = std::max(change, std::abs(step) * A(i, i));
    }
    if (change <= end) break;
  }
  return l;
}

// l of an inelastic impact with the rebounds e l. Pairs of one coefficient get back e^2 of the energy that l takes; of
// several, the largest bounds it.
Eigen::VectorXd with_rebound(const Eigen::MatrixXd& A, const Eigen::VectorXd& u, const Eigen::VectorXd& l,
                             const Eigen::VectorXd& e) {
  const Eigen::VectorXd back = e.cwiseProduct(l), change = A * l;
  const double most = (l.array() > 0).select(e, 0.0).maxCoeff(), taken = -l.dot(u + 0.5 * change);
  return l + std::min(1.0, share_within(back.dot(u + change), back.dot(A * back), most * most * taken)) * back;
}

}  // namespace

Eigen::VectorXd stopping_impulses(const Eigen::MatrixXd& A, const Eigen::VectorXd& w) {
  return stop(A, w, Eigen::Array<bool, -1, 1>::Constant(w.size(), true));
}

Eigen::VectorXd rebound_impulses(const Eigen::MatrixXd& A, const Eigen::VectorXd& w, const Eigen::VectorXd& e) {
  Eigen::VectorXd l = Eigen::VectorXd::Zero(w.size()), u = w;
  const double least = settled * fastest_approach(w);
  for (int n = 0; n < most_rounds && fastest_approach(u) > least; ++n) {
    l += with_rebound(A, u, stop(A, u, u.array() < -least), e);
    u = w + A * l;
  }
  return l + stopping_impulses(A, u);
}

double share_within(double slope, double curvature, double energy) {
  if (curvature <= 0) return 0;
  const double root = slope * slope + 2 * curvature * energy;
  return std::max(0.0, (-slope + std::sqrt(std::max(0.0, root))) / curvature);
}

}  // namespace seiche
