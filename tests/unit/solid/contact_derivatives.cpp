// Gradients against differences; Hessians without negative eigenvalues.
#include <random>

#include "linalg/core/symmetric_eigen.h"
#include "solid/contact/system.h"
#include "unit/solid/contact_cases.h"

namespace contact_derivatives_tests {
using namespace seiche;
using namespace seiche::contact_cases;

namespace {

struct Random {
  std::mt19937 engine{7};
  double operator()(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine); }
  Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
};

// Two translating and rotating bodies near a wall and near each other; all within reach.
template <int Dim>
struct Crowd {
  static constexpr int n = twist_size<Dim>;
  DryWorld<Dim> world;
  contact::Interval<Dim> interval;
  contact::Weights weights{0.01, 0.5, 100, 0.3};
  Eigen::VectorXd v;
  std::vector<contact::FrictionPoint<Dim>> friction;

  explicit Crowd(Random& random) {
    world.walls = {{Vec3(0, -0.6, 0), Vec3(0.1, 1, 0)}};
    for (int i = 0; i < 2; ++i) {
      auto& b = world.add_box(Vec3(1, 0.8, 0.9), Vec3(0, 1.05 * i, 0) + random.vector(0.02), 1);
      const Vec3 axis = Dim == 2 ? Vec3(0, 0, 1) : random.vector(1).normalized();
      b.pose.rotation = Eigen::AngleAxisd(random(-0.1, 0.1), axis).toRotationMatrix();
      b.contact.friction = 0.4;
    }
    std::vector<ContactMotion> motions;
    for (const auto& b : world.bodies) motions.push_back({b.pose, b.pose});
    interval = contact::make_interval<Dim>(world.scene().data(), motions, 0.02);
    v.resize(2 * n);
    for (int i = 0; i < v.size(); ++i) v[i] = random(-1, 1);
    friction = contact::friction_points<Dim>(world.scene().data(), at(v), pairs(v), weights);
    for (auto& f : friction) f.direction = truncate<Dim - 1>(random.vector(1)).normalized();
  }
  contact::Placement<Dim> at(const Eigen::VectorXd& u) {
    const auto& scene = world.scene().data();
    return contact::place<Dim>(scene, interval, contact::all_velocities<Dim>(scene, interval, u, 1));
  }
  std::vector<contact::Candidate> pairs(const Eigen::VectorXd& u) {
    const auto points = at(u).points;
    return contact::find_candidates<Dim>(world.scene().data(), points, points, weights.reach);
  }
  double energy(const Eigen::VectorXd& u) {
    return contact::contact_energy<Dim>(world.scene().data(), interval, at(u), pairs(u), friction, weights);
  }
  contact::ContactTerms terms(HessianProjection curvature) {
    return contact::contact_terms<Dim>(world.scene().data(), interval, at(v), pairs(v), friction, weights, curvature,
                                       {0, int(v.size())});
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("the gradient of barrier and friction is that of the energy", "", ((int Dim), Dim), 2, 3) {
  Random random;
  for (int sample = 0; sample < 20; ++sample) {
    Crowd<Dim> crowd(random);
    const contact::ContactTerms terms = crowd.terms(HessianProjection::exact);
    REQUIRE(terms.active > 4);
    REQUIRE(crowd.friction.size() > 2);
    CHECK(terms.energy == Approx(crowd.energy(crowd.v)).epsilon(1e-12));
    const double h = 1e-5;  // fourth-order differences; their error is then round-off
    Eigen::VectorXd differences(crowd.v.size());
    for (int i = 0; i < crowd.v.size(); ++i) {
      const Eigen::VectorXd e = h * Eigen::VectorXd::Unit(crowd.v.size(), i);
      differences[i] = (8 * (crowd.energy(crowd.v + e) - crowd.energy(crowd.v - e)) -
                        (crowd.energy(crowd.v + 2 * e) - crowd.energy(crowd.v - 2 * e))) /
                       (12 * h);
    }
    CHECK((differences - terms.gradient).norm() < 1e-6 * terms.gradient.norm());
  }
}

TEMPLATE_TEST_CASE_SIG("the Hessian of barrier and friction has no negative eigenvalue", "", ((int Dim), Dim), 2, 3) {
  Random random;
  for (int sample = 0; sample < 20; ++sample) {
    const Eigen::MatrixXd K = Crowd<Dim>(random).terms(HessianProjection::convex).K;
    CHECK((K - K.transpose()).norm() < 1e-13 * K.norm());
    const Eigen::VectorXd values = symmetric_eigenvalues(K);
    CHECK(values.minCoeff() > -1e-13 * values.maxCoeff());
  }
}

TEST_CASE("barrier and slip law have the derivatives they claim") {
  const double h = 1e-6;
  for (double d : {0.01, 0.1, 0.5, 0.9, 0.99}) {
    const auto at = [](double x) { return contact::barrier(x, 1, 3); };
    CHECK((at(d * (1 + h)).value - at(d * (1 - h)).value) / (2 * h * d) == Approx(at(d).slope).epsilon(1e-6));
    CHECK((at(d * (1 + h)).slope - at(d * (1 - h)).slope) / (2 * h * d) == Approx(at(d).curvature).epsilon(1e-6));
    CHECK(at(d).slope < 0);
    CHECK(at(d).curvature > 0);
  }
  for (double y : {0.1, 0.5, 0.9, 2.}) {
    const auto at = [](double x) { return contact::slip_law(x, 1); };
    const double slope = (at(y + h).value - at(y - h).value) / (2 * h);
    CHECK(slope == Approx(at(y).over_speed * y).epsilon(1e-8));
    CHECK((at(y + h).over_speed * (y + h) - at(y - h).over_speed * (y - h)) / (2 * h) ==
          Approx(at(y).curvature).margin(1e-8));
  }
}

TEST_CASE("the friction of a pair") {
  CHECK(contact::pair_friction(0.4, 0.9) == Approx(0.6));
  CHECK(contact::pair_friction(0.4, {}) == 0.4);
  CHECK(contact::pair_friction({}, 0.9) == 0.9);
  CHECK(contact::pair_friction({}, {}) == 0);
  CHECK(contact::pair_friction(0.0, 0.9) == 0);
}

}  // namespace contact_derivatives_tests
