// Elastic bodies that touch each other, rigid bodies, prescribed ones and walls.
#include <random>

#include "solid_soft_cases.h"

using namespace seiche;
using namespace seiche::testing;

namespace {

using contact_cases::box;

// A soft block on a wall, a second one, a free rigid box and a prescribed one above each other, all within reach.
template <int Dim>
struct Crowd {
  SoftWorld<Dim> world;
  std::unique_ptr<ContactScene<Dim>> scene;
  contact::Interval<Dim> interval;
  contact::Weights weights{0.01, 0.3, 100, 0.3};
  Eigen::VectorXd v;
  std::vector<contact::FrictionPoint<Dim>> friction;

  Crowd() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> range(-1, 1);
    world.walls = {{Vec3(0, -0.1, 0), Vec3(0.05, 1, 0)}};
    world.add_rigid(box<Dim>(Vec3::Ones()), Vec3(0.5, 2.75, 0.45), 1, Vec3::Ones()).contact.friction = 0.4;
    auto& driven = world.add_rigid(box<Dim>(Vec3::Ones()), Vec3(0.55, 3.9, 0.5), 1, Vec3::Ones());
    driven.contact.control = BodyControl::prescribed;
    auto& side = world.add_rigid(box<Dim>(Vec3::Ones()), Vec3(1.6, 0.55, 0.45), 1, Vec3::Ones());
    side.contact.control = BodyControl::prescribed;
    for (int i = 0; i < 2; ++i) {
      auto& s = world.add(box_mesh<Dim>(Vec<Dim>::Unit(1) * 1.1 * i, Vec<Dim>::Ones() + Vec<Dim>::Unit(1) * 1.1 * i,
                                        IVec<Dim>::Ones(), 2),
                          1, 1, 0.3);
      s.friction = 0.5;
      for (int k = 0; k < s.body.size(); ++k) s.state.u[k] = 0.02 * range(random);
    }
    scene = std::make_unique<ContactScene<Dim>>(world.scene());
    Pose end = driven.pose, aside = side.pose;
    end.displacement[0] += 0.01;
    aside.displacement[1] += 0.01;
    interval = contact::make_interval<Dim>(scene->data(), world.motions({{1, end}, {2, aside}}), 0.02);
    v = Eigen::VectorXd::NullaryExpr(scene->data().size, [&] { return range(random); });
    v.segment(Dim, twist_size<Dim> - Dim).setZero();  // K leaves out how the left Jacobian changes
    friction = contact::friction_points<Dim>(scene->data(), at(v), pairs(v), weights);
  }
  contact::Placement<Dim> at(const Eigen::VectorXd& u, double share = 0.6) const {
    const auto& data = scene->data();
    return contact::place<Dim>(data, interval, contact::all_velocities<Dim>(data, interval, u, share));
  }
  std::vector<contact::Candidate> pairs(const Eigen::VectorXd& u) const {
    const auto points = at(u).points;
    return contact::find_candidates<Dim>(scene->data(), points, points, weights.reach);
  }
  double energy(const Eigen::VectorXd& u) const {
    return contact::contact_energy<Dim>(scene->data(), interval, at(u), pairs(u), friction, weights);
  }
  contact::ContactTerms terms(const Eigen::VectorXd& u, Curvature curvature, double share = 0.6) const {
    return contact::contact_terms<Dim>(scene->data(), interval, at(u, share), pairs(u), friction, weights, curvature);
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("barrier and friction of deformable bodies have the derivatives they claim", "[soft]",
                       ((int Dim), Dim), 2, 3) {
  const Crowd<Dim> crowd;
  const auto terms = crowd.terms(crowd.v, Curvature::exact);
  REQUIRE(terms.active > 20);
  REQUIRE(crowd.friction.size() > 10);
  CHECK(terms.energy == Approx(crowd.energy(crowd.v)).epsilon(1e-12));
  const Eigen::MatrixXd K = terms.K;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range(-1, 1);
  const double h = 1e-5;
  for (int sample = 0; sample < 8; ++sample) {
    const Eigen::VectorXd p = Eigen::VectorXd::NullaryExpr(crowd.v.size(), [&] { return range(random); });
    const auto E = [&](double s) { return crowd.energy(crowd.v + s * h * p); };
    CHECK((8 * (E(1) - E(-1)) - (E(2) - E(-2))) / (12 * h) == Approx(terms.gradient.dot(p)).epsilon(1e-6));
    const auto slope = [&](double s) { return crowd.terms(crowd.v + s * h * p, Curvature::exact).gradient.dot(p); };
    CHECK((slope(1) - slope(-1)) / (2 * h) == Approx(p.dot(K * p)).epsilon(1e-5));
  }
  const Eigen::VectorXd differences = (crowd.terms(crowd.v, Curvature::exact, 0.6 + h).gradient -
                                       crowd.terms(crowd.v, Curvature::exact, 0.6 - h).gradient) /
                                      (2 * h);
  CHECK((0.4 * differences - terms.drag).norm() < 1e-5 * terms.drag.norm());
  const Eigen::MatrixXd convex = crowd.terms(crowd.v, Curvature::convex).K;
  CHECK((convex - convex.transpose()).norm() < 1e-13 * convex.norm());
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(convex).eigenvalues();
  CHECK(values.minCoeff() > -1e-13 * values.maxCoeff());
}

// Each body's impulse is minus the gradient of its degrees of freedom summed up, and all together are those of the
// walls.
TEMPLATE_TEST_CASE_SIG("impulses on deformable bodies are sums over their nodes", "[soft]", ((int Dim), Dim), 2, 3) {
  const Crowd<Dim> crowd;
  const auto& data = crowd.scene->data();
  const auto at = crowd.at(crowd.v, 1);
  const auto pairs = contact::find_candidates<Dim>(data, at.points, at.points, crowd.weights.reach);
  const auto terms =
      contact::contact_terms<Dim>(data, crowd.interval, at, pairs, crowd.friction, crowd.weights, Curvature::exact);
  const auto impulses = contact::contact_impulses<Dim>(data, at, pairs, crowd.friction, crowd.weights);
  for (int b : {3, 4}) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (int n = 0; n < data.node_count[b]; ++n)
      sum -= terms.gradient.template segment<Dim>(data.first_dof[b] + Dim * n);
    CHECK((truncate<Dim>(impulses[b].linear) - sum).norm() < 1e-12 * sum.norm());
  }
}

TEMPLATE_TEST_CASE_SIG("a soft body that touches nothing moves as the elastic solver moves it", "[soft]",
                       ((int Dim), Dim), 2, 3) {
  SoftWorld<Dim> world;
  world.gravity = Vec3(0, -9.81, 0);
  world.walls = {{Vec3(0, -5, 0), Vec3(0, 1, 0)}};
  auto& s = world.add(box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Constant(2), 2), 1000, 1e5, 0.3);
  s.state.v = at_nodes<Dim>(s.body.mesh, [](const Vec<Dim>& X) { return Vec<Dim>(0.5 * X.reverse()); });
  ElasticState other = s.state;
  ElasticWorkspace workspace;
  const Eigen::VectorXd force =
      body_force<Dim>(s.body, [](const Vec<Dim>&) { return Vec<Dim>(-9810 * Vec<Dim>::Unit(1)); });
  for (int n = 0; n < 5; ++n) {
    world.step(0.02);
    REQUIRE(advance<Dim>(s.body, ElasticScheme::backward_euler, 0.02, force, {}, {}, workspace, other).converged);
    CHECK((s.state.u - other.u).template lpNorm<Eigen::Infinity>() < 1e-7);
  }
  CHECK(world.report.active == 0);
}

TEMPLATE_TEST_CASE_SIG("soft blocks rest on each other", "[soft]", ((int Dim), Dim), 2, 3) {
  SoftWorld<Dim> world;
  world.gravity = Vec3(0, -10, 0);
  world.walls = {{Vec3::Zero(), Vec3(0, 1, 0)}};
  world.options.reach = 1e-3;
  world.options.acceleration = 10;
  const double g = 10, density = 1000, E = 1e5;
  for (int i = 0; i < 2; ++i) {
    const Vec<Dim> low = Vec<Dim>::Unit(1) * (1.001 * i + 0.001) + Vec<Dim>::Unit(0) * 0.05 * i;
    world.add(box_mesh<Dim>(low, low + Vec<Dim>::Ones(), IVec<Dim>::Constant(2), 1), density, E, 0).friction =
        0.5;  // without it the upper one slides off: the lower one gives way more where it hangs over
  }
  for (int n = 0; n < 150; ++n) world.step(0.05);
  double speed = 0;
  for (const auto& s : world.soft) speed = std::max(speed, s.state.v.template lpNorm<Eigen::Infinity>());
  CAPTURE(speed, world.report.smallest_gap, world.report.stiffness, world.newton_iterations);
  CHECK(speed < 1e-4);
  CHECK(world.report.smallest_gap > 0.05 * world.options.reach);
  CHECK(world.report.impulses[0].linear[1] == Approx(0.05 * density * g).epsilon(1e-3));
  CHECK(world.report.impulses[1].linear[1] == Approx(0.05 * density * g).epsilon(1e-3));
  CHECK(world.overlaps() == 0);
  WARN(Dim << "D, two blocks: smallest gap " << world.report.smallest_gap / world.options.reach << " of the reach, "
           << world.newton_iterations / 150. << " iterations a step");
}
