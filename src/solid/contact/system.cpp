#include "solid/contact/system.h"

#include <limits>
#include <map>

#include "linalg/core/symmetric_eigen.h"
#include "solid/contact/deformable.h"

namespace seiche::contact {
namespace {

// Derivatives by the twists of a pair's two bodies.
template <int Dim>
using PairVector = Eigen::Matrix<double, 2 * twist_size<Dim>, 1>;
template <int Dim>
using PairMatrix = Eigen::Matrix<double, 2 * twist_size<Dim>, 2 * twist_size<Dim>>;

// Nearest positive semi-definite matrix, where negative eigenvalues become zero, in unknowns of one unit: velocities,
// and rotations times the given lengths (1 for velocities).
Eigen::MatrixXd without_negative(const Eigen::MatrixXd& symmetric, const Eigen::VectorXd& lengths) {
  const Eigen::MatrixXd units = lengths * lengths.transpose();
  const SymmetricEigen eigen = symmetric_eigen(symmetric.cwiseQuotient(units));
  if (eigen.values[0] >= 0) return symmetric;
  return positive_part(eigen).cwiseProduct(units);
}

// Sums pairs by the two bodies they join. The ordered map keeps sums identical from run to run.
template <int Dim>
class Assembly {
 public:
  static constexpr int n = twist_size<Dim>;
  Assembly(const Scene<Dim>& scene, const Interval<Dim>& interval, double share_left, HessianProjection curvature,
           IndexRange columns)
      : scene_(scene), interval_(interval), left_(share_left), curvature_(curvature), columns_(columns) {
    gradient_.setZero(scene.size);
    drag_.setZero(scene.size);
  }

  void add(int a, int b, const PairVector<Dim>& gradient) {
    if (first_dof(a) >= 0) gradient_.template segment<n>(first_dof(a)) += gradient.template head<n>();
    if (first_dof(b) >= 0) gradient_.template segment<n>(first_dof(b)) += gradient.template tail<n>();
  }

  void add(int a, int b, const PairMatrix<Dim>& hessian) {
    const auto [place, fresh] = hessians_.try_emplace({a, b}, hessian);
    if (!fresh) place->second += hessian;
  }

  // Adds a pair with a deformable side.
  void add(const PairDofs<Dim>& dofs, const typename PairDofs<Dim>::Vector& gradient,
           const typename PairDofs<Dim>::Matrix& exact) {
    const typename PairDofs<Dim>::Matrix hessian =
        curvature_ == HessianProjection::exact ? exact
                                               : typename PairDofs<Dim>::Matrix(without_negative(exact, dofs.lengths));
    const typename PairDofs<Dim>::Vector drag = hessian * (left_ * dofs.prescribed);
    for (int i = 0; i < dofs.count; ++i) {
      if (dofs.dof[i] < 0) continue;
      gradient_[dofs.dof[i]] += gradient[i];
      drag_[dofs.dof[i]] += drag[i];
      for (int j = 0; j < dofs.count; ++j)
        if (columns_.holds(dofs.dof[j])) entries_.emplace_back(dofs.dof[i], dofs.dof[j], hessian(i, j));
    }
  }

  void finish(ContactTerms& terms) {
    std::vector<Eigen::Triplet<double>>& entries = entries_;
    for (const auto& [bodies, sum] : hessians_) {
      const PairMatrix<Dim> hessian =
          curvature_ == HessianProjection::exact ? sum : PairMatrix<Dim>(without_negative(sum, lengths(bodies)));
      const std::array<int, 2> body{bodies.first, bodies.second};
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) scatter(body[i], body[j], hessian.template block<n, n>(n * i, n * j), entries);
    }
    terms.gradient = gradient_;
    terms.drag = drag_;
    terms.K.resize(gradient_.size(), gradient_.size());
    terms.K.setFromTriplets(entries.begin(), entries.end());
  }

 private:
  int first_dof(int body) const { return body < 0 ? -1 : scene_.first_dof[body]; }

  // 1 for velocities and the body's radius for rotations, of both bodies (second: -1 for a wall).
  PairVector<Dim> lengths(const std::pair<int, int>& bodies) const {
    PairVector<Dim> r = PairVector<Dim>::Ones();
    r.template segment<n - Dim>(Dim).setConstant(interval_.radius[bodies.first]);
    if (bodies.second >= 0) r.template tail<n - Dim>().setConstant(interval_.radius[bodies.second]);
    return r;
  }

  void scatter(int row, int column, const Eigen::Matrix<double, n, n>& part,
               std::vector<Eigen::Triplet<double>>& entries) {
    const int i = first_dof(row), j = first_dof(column);
    if (i < 0 || column < 0) return;
    if (j < 0) {
      drag_.template segment<n>(i) += part * (left_ * interval_.prescribed[column]);
      return;
    }
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c)
        if (columns_.holds(j + c)) entries.emplace_back(i + r, j + c, part(r, c));
  }

  const Scene<Dim>& scene_;
  const Interval<Dim>& interval_;
  double left_;
  HessianProjection curvature_;
  IndexRange columns_;
  Eigen::VectorXd gradient_, drag_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::map<std::pair<int, int>, PairMatrix<Dim>> hessians_;
};

int second_body(const Candidate& pair) {
  return pair.kind == PairKind::point_wall ? -1 : pair.second;
}

template <int Dim>
using TurnJacobians = std::vector<Eigen::Matrix<double, turn_size<Dim>, turn_size<Dim>>>;

template <int Dim>
TurnJacobians<Dim> turn_jacobians(const Interval<Dim>& interval, const Twists<Dim>& twists) {
  TurnJacobians<Dim> r;
  for (const auto& twist : twists)
    r.push_back(left_jacobian<Dim>(interval.horizon * twist.template tail<turn_size<Dim>>()));
  return r;
}

// Derivative of the points by the bodies' velocities and rotations: d x = d v + d theta x arm.
template <int Dim>
using PointMatrix = Eigen::Matrix<double, 4 * Dim, 2 * twist_size<Dim>>;

template <int Dim>
PointMatrix<Dim> point_derivative(const Candidate& pair, const Placement<Dim>& at, const PairPoints<Dim>& x) {
  PointMatrix<Dim> J = PointMatrix<Dim>::Zero();
  const int first = points_of_first(pair.kind);
  for (int i = 0; i < points_of(pair.kind, Dim); ++i) {
    const int side = i < first ? 0 : twist_size<Dim>;
    const Vec<Dim> arm = x[i] - at.centers[i < first ? pair.first : pair.second];
    J.template block<Dim, Dim>(Dim * i, side).setIdentity();
    for (int k = 0; k < turn_size<Dim>; ++k)
      J.template block<Dim, 1>(Dim * i, side + Dim + k) = turned<Dim>(Turn<Dim>::Unit(k), arm);
  }
  return J;
}

// Curvature of the points' circular paths: f . d2x = sym(f r') - (f . r) 1 in the rotations of each body (2D: -f . r).
template <int Dim>
void add_turning(const Candidate& pair, const Placement<Dim>& at, const PairPoints<Dim>& x,
                 const Eigen::Matrix<double, Dim, 4>& forces, PairMatrix<Dim>& hessian) {
  const int first = points_of_first(pair.kind);
  for (int i = 0; i < points_of(pair.kind, Dim); ++i) {
    const int side = (i < first ? 0 : twist_size<Dim>)+Dim;
    const Vec<Dim> r = x[i] - at.centers[i < first ? pair.first : pair.second], f = forces.col(i);
    auto block = hessian.template block<turn_size<Dim>, turn_size<Dim>>(side, side);
    block.diagonal().array() -= f.dot(r);
    if constexpr (Dim == 3) block += 0.5 * (f * r.transpose() + r * f.transpose());
  }
}

// Maps angular velocities to rotations: d theta = J_l d omega.
template <int Dim>
PairMatrix<Dim> turns_by_twists(const Candidate& pair, const TurnJacobians<Dim>& jacobians) {
  constexpr int n = twist_size<Dim>, turn = turn_size<Dim>;
  PairMatrix<Dim> J = PairMatrix<Dim>::Identity();
  J.template block<turn, turn>(Dim, Dim) = jacobians[pair.first];
  if (second_body(pair) >= 0) J.template block<turn, turn>(n + Dim, n + Dim) = jacobians[pair.second];
  return J;
}

template <int Dim>
PairVector<Dim> flat_product(const PointMatrix<Dim>& J, const Eigen::Matrix<double, Dim, 4>& forces) {
  return J.transpose() * Eigen::Map<const Eigen::Matrix<double, 4 * Dim, 1>>(forces.data());
}

// Derivative of each slip component by the twists of both bodies.
template <int Dim>
using SlipDerivative = Eigen::Matrix<double, 2 * twist_size<Dim>, Dim - 1>;

template <int Dim>
SlipDerivative<Dim> slip_derivative(const FrictionPoint<Dim>& f) {
  SlipDerivative<Dim> r;
  for (int k = 0; k < Dim - 1; ++k) {
    const Vec<Dim> t = f.tangent.col(k);
    r.col(k) << t, moment<Dim>(f.arm_first, t), -t, -moment<Dim>(f.arm_second, t);
  }
  return r;
}

template <int Dim>
void add_friction(const Scene<Dim>& scene, const Interval<Dim>& interval,
                  const std::vector<FrictionPoint<Dim>>& friction, const Placement<Dim>& at, const Weights& w,
                  ContactTerms& terms, Assembly<Dim>& assembly) {
  for (const FrictionPoint<Dim>& f : friction) {
    const SlipEnergy<Dim> e = slip_energy<Dim>(f, slip<Dim>(f, at.velocities), w.creep_speed);
    terms.energy += w.dt * e.value;
    if (f.deforms()) {
      const PairDofs<Dim> dofs = pair_dofs<Dim>(scene, interval, f.pair);
      const typename PairDofs<Dim>::SlipDerivative S = slip_derivative<Dim>(f, dofs), dt_S = w.dt * S;
      assembly.add(dofs, dt_S * e.gradient, dt_S * e.hessian * S.transpose());
      continue;
    }
    const SlipDerivative<Dim> S = slip_derivative<Dim>(f), dt_S = w.dt * S;
    assembly.add(f.first, f.second, PairVector<Dim>(dt_S * e.gradient));
    assembly.add(f.first, f.second, PairMatrix<Dim>(dt_S * e.hessian * S.transpose()));
  }
}

// Barrier of two rigid bodies, or of a rigid body and a wall.
template <int Dim>
void add_rigid(const Interval<Dim>& interval, const Placement<Dim>& at, const TurnJacobians<Dim>& jacobians,
               const Candidate& pair, const PairPoints<Dim>& x, const PairEnergy<Dim>& e, const Weights& w,
               Assembly<Dim>& assembly) {
  const PointMatrix<Dim> J = point_derivative<Dim>(pair, at, x);
  const PairMatrix<Dim> turns = turns_by_twists<Dim>(pair, jacobians);
  PairMatrix<Dim> hessian = J.transpose() * e.hessian * J;
  add_turning<Dim>(pair, at, x, e.gradient, hessian);
  const PairVector<Dim> gradient = turns.transpose() * flat_product<Dim>(J, e.gradient);
  hessian = turns.transpose() * hessian * turns;
  assembly.add(pair.first, second_body(pair), PairVector<Dim>(w.dt * gradient));
  assembly.add(pair.first, second_body(pair), PairMatrix<Dim>(w.dt * interval.horizon * hessian));
}

template <int Dim>
void add_deformable(const Scene<Dim>& scene, const Interval<Dim>& interval, const Placement<Dim>& at,
                    const Candidate& pair, const PairPoints<Dim>& x, const PairEnergy<Dim>& e, const Weights& w,
                    Assembly<Dim>& assembly) {
  const PairDofs<Dim> dofs = pair_dofs<Dim>(scene, interval, pair);
  const PairTerms<Dim> terms = pair_terms<Dim>(scene, interval, at, pair, dofs, x, e);
  assembly.add(dofs, w.dt * terms.gradient, w.dt * interval.horizon * terms.hessian);
}

// Friction point of a pair, without its bound.
template <int Dim>
FrictionPoint<Dim> friction_point(const Scene<Dim>& scene, const Placement<Dim>& at, const Candidate& pair,
                                  const PairPoints<Dim>& x, const Separation<Dim>& apart) {
  const int second = second_body(pair);
  const bool first_deforms = scene.deforms(pair.first), second_deforms = second >= 0 && scene.deforms(second);
  const double first_share = first_deforms ? 0 : second_deforms ? 1 : 0.5;  // of the gap, from the first body
  const double second_share = second_deforms ? 1 : first_deforms ? 0 : 0.5;
  const auto arm = [&](int body, double share) -> Vec<Dim> {
    if (body < 0) return Vec<Dim>::Zero();
    Vec<Dim> point = -share * apart.distance * apart.normal;
    for (int i = 0; i < points_of_first(pair.kind); ++i) point += apart.weight[i] * x[i];
    return point - at.centers[body];
  };
  return {pair.first,
          second,
          0,
          arm(pair.first, first_share),
          arm(second, second_share),
          tangents<Dim>(apart.normal),
          first_deforms,
          second_deforms,
          pair,
          apart.weight};
}

template <int Dim>
bool deforms(const Scene<Dim>& scene, const Candidate& pair) {
  return scene.deforms(pair.first) || (second_body(pair) >= 0 && scene.deforms(pair.second));
}

template <int Dim>
PairEnergy<Dim> energy_of(const Candidate& pair, const PairPoints<Dim>& x, const Separation<Dim>& apart,
                          const Weights& w) {
  return pair_energy<Dim>(pair.kind, x, apart, pair.reach(w.reach), w.stiffness, pair.edges_at_rest);
}

template <int Dim>
double share_left(const Scene<Dim>& scene, const Interval<Dim>& interval, const Twists<Dim>& twists) {
  double left = 0;
  for (size_t b = 0; b < twists.size(); ++b) {
    const double whole = interval.prescribed[b].squaredNorm();
    if (!scene.moves(static_cast<int>(b)) && whole > 0)
      left = std::max(left, 1 - twists[b].dot(interval.prescribed[b]) / whole);
  }
  return left;
}

}  // namespace

template <int Dim>
double contact_energy(const Scene<Dim>& scene, const Interval<Dim>& interval, const Placement<Dim>& at,
                      const std::vector<Candidate>& pairs, const std::vector<FrictionPoint<Dim>>& friction,
                      const Weights& w) {
  double energy = 0;
  for (const Candidate& pair : pairs) {
    const PairPoints<Dim> x = gather<Dim>(pair, at.points);
    const Separation<Dim> apart = separate<Dim>(scene, pair, x);
    if (apart.distance >= pair.reach(w.reach)) continue;
    if (apart.distance <= 0) return std::numeric_limits<double>::infinity();
    energy += w.dt / interval.horizon *
              pair_value<Dim>(pair.kind, x, apart.distance, pair.reach(w.reach), w.stiffness, pair.edges_at_rest);
  }
  for (const FrictionPoint<Dim>& f : friction)
    energy += w.dt * slip_energy<Dim>(f, slip<Dim>(f, at.velocities), w.creep_speed).value;
  return energy;
}

template <int Dim>
ContactTerms contact_terms(const Scene<Dim>& scene, const Interval<Dim>& interval, const Placement<Dim>& at,
                           const std::vector<Candidate>& pairs, const std::vector<FrictionPoint<Dim>>& friction,
                           const Weights& w, HessianProjection curvature, IndexRange columns) {
  ContactTerms terms;
  terms.smallest_gap = terms.tightest = w.reach;
  Assembly<Dim> assembly(scene, interval, share_left<Dim>(scene, interval, at.velocities.twists), curvature, columns);
  const TurnJacobians<Dim> jacobians = turn_jacobians<Dim>(interval, at.velocities.twists);
  for (const Candidate& pair : pairs) {
    const PairPoints<Dim> x = gather<Dim>(pair, at.points);
    const Separation<Dim> apart = separate<Dim>(scene, pair, x);
    if (apart.distance >= pair.reach(w.reach)) continue;
    const PairEnergy<Dim> e = energy_of<Dim>(pair, x, apart, w);
    ++terms.active;
    terms.smallest_gap = std::min(terms.smallest_gap, apart.distance);
    terms.tightest = std::min(terms.tightest, w.reach / pair.reach(w.reach) * apart.distance);
    terms.energy += w.dt / interval.horizon * e.value;
    if (deforms<Dim>(scene, pair))
      add_deformable<Dim>(scene, interval, at, pair, x, e, w, assembly);
    else
      add_rigid<Dim>(interval, at, jacobians, pair, x, e, w, assembly);
  }
  add_friction<Dim>(scene, interval, friction, at, w, terms, assembly);
  assembly.finish(terms);
  return terms;
}

template <int Dim>
std::vector<FrictionPoint<Dim>> friction_points(const Scene<Dim>& scene, const Placement<Dim>& at,
                                                const std::vector<Candidate>& pairs, const Weights& w) {
  std::vector<FrictionPoint<Dim>> found;
  for (const Candidate& pair : pairs) {
    const double mu = scene.friction_between(pair.first, second_body(pair));
    if (mu == 0) continue;
    const PairPoints<Dim> x = gather<Dim>(pair, at.points);
    const Separation<Dim> apart = separate<Dim>(scene, pair, x);
    if (apart.distance >= pair.reach(w.reach)) continue;
    const double force = energy_of<Dim>(pair, x, apart, w).force;
    if (force <= 0) continue;
    found.push_back(friction_point<Dim>(scene, at, pair, x, apart));
    found.back().bound = mu * force;
  }
  return found;
}

template <int Dim>
std::vector<BodyImpulse> contact_impulses(const Scene<Dim>& scene, const Placement<Dim>& at,
                                          const std::vector<Candidate>& pairs,
                                          const std::vector<FrictionPoint<Dim>>& friction, const Weights& w) {
  constexpr int n = twist_size<Dim>;
  std::vector<BodyImpulse> impulses(scene.surfaces.size());
  const auto add = [&](int body, const Eigen::Matrix<double, n, 1>& gradient) {
    if (body < 0) return;
    impulses[body].linear -= w.dt * extend<Dim>(gradient.template head<Dim>());
    impulses[body].angular.template tail<turn_size<Dim>>() -= w.dt * gradient.template tail<turn_size<Dim>>();
  };
  const auto add_pair = [&](int first, int second, const PairVector<Dim>& gradient) {
    add(first, gradient.template head<n>());
    add(second, gradient.template tail<n>());
  };
  for (const Candidate& pair : pairs) {
    const PairPoints<Dim> x = gather<Dim>(pair, at.points);
    const Separation<Dim> apart = separate<Dim>(scene, pair, x);
    if (apart.distance >= pair.reach(w.reach)) continue;
    const PairEnergy<Dim> e = energy_of<Dim>(pair, x, apart, w);
    add_pair(pair.first, second_body(pair), flat_product<Dim>(point_derivative<Dim>(pair, at, x), e.gradient));
  }
  for (const FrictionPoint<Dim>& f : friction) {
    const SlipEnergy<Dim> e = slip_energy<Dim>(f, slip<Dim>(f, at.velocities), w.creep_speed);
    add_pair(f.first, f.second, slip_derivative<Dim>(f) * e.gradient);
  }
  return impulses;
}

#define SEICHE_INSTANTIATE(Dim)                                                                                   \
  template double contact_energy<Dim>(const Scene<Dim>&, const Interval<Dim>&, const Placement<Dim>&,             \
                                      const std::vector<Candidate>&, const std::vector<FrictionPoint<Dim>>&,      \
                                      const Weights&);                                                            \
  template ContactTerms contact_terms<Dim>(const Scene<Dim>&, const Interval<Dim>&, const Placement<Dim>&,        \
                                           const std::vector<Candidate>&, const std::vector<FrictionPoint<Dim>>&, \
                                           const Weights&, HessianProjection, IndexRange);                        \
  template std::vector<FrictionPoint<Dim>> friction_points<Dim>(const Scene<Dim>&, const Placement<Dim>&,         \
                                                                const std::vector<Candidate>&, const Weights&);   \
  template std::vector<BodyImpulse> contact_impulses<Dim>(const Scene<Dim>&, const Placement<Dim>&,               \
                                                          const std::vector<Candidate>&,                          \
                                                          const std::vector<FrictionPoint<Dim>>&, const Weights&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)
#undef SEICHE_INSTANTIATE

}  // namespace seiche::contact
