// Contact of elastic bodies with each other, rigid bodies, prescribed bodies and walls.
#include <random>

#include "linalg/core/symmetric_eigen.h"
#include "unit/solid/soft_cases.h"

namespace soft_contact_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

using contact_cases::box;

// A soft block on a wall, a second one, a free rigid box and a prescribed one, stacked within reach of each other.
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
    v.segment(Dim, twist_size<Dim> - Dim).setZero();  // K neglects the derivative of the left Jacobian
    friction = contact::friction_points<Dim>(scene->data(), at(v), pairs(v), weights);
    for (auto& f : friction) {  // where force and slip agree, as at the minimum
      const auto u = contact::slip<Dim>(f, at(v).velocities);
      f.direction = contact::next_direction<Dim>(f, u, 0 * u, weights.creep_speed);
    }
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
  contact::ContactTerms terms(const Eigen::VectorXd& u, HessianProjection curvature, double share = 0.6) const {
    return contact::contact_terms<Dim>(scene->data(), interval, at(u, share), pairs(u), friction, weights, curvature,
                                       {0, int(u.size())});
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("barrier and friction of deformable bodies have the derivatives they claim", "[soft]",
                       ((int Dim), Dim), 2, 3) {
  const Crowd<Dim> crowd;
  const auto terms = crowd.terms(crowd.v, HessianProjection::exact);
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
    const auto slope = [&](double s) {
      return crowd.terms(crowd.v + s * h * p, HessianProjection::exact).gradient.dot(p);
    };
    CHECK((slope(1) - slope(-1)) / (2 * h) == Approx(p.dot(K * p)).epsilon(1e-5));
  }
  const auto gradient_at = [&](double share) { return crowd.terms(crowd.v, HessianProjection::exact, share).gradient; };
  const Eigen::VectorXd differences =
      (8 * (gradient_at(0.6 + h) - gradient_at(0.6 - h)) - (gradient_at(0.6 + 2 * h) - gradient_at(0.6 - 2 * h))) /
      (12 * h);
  CHECK((0.4 * differences - terms.drag).norm() < 1e-5 * terms.drag.norm());
  const Eigen::MatrixXd convex = crowd.terms(crowd.v, HessianProjection::convex).K;
  CHECK((convex - convex.transpose()).norm() < 1e-13 * convex.norm());
  const Eigen::VectorXd values = symmetric_eigenvalues(convex);
  CHECK(values.minCoeff() > -1e-13 * values.maxCoeff());
}

// The impulse on each body is minus the sum of the gradient over its degrees of freedom.
TEMPLATE_TEST_CASE_SIG("impulses on deformable bodies are sums over their nodes", "[soft]", ((int Dim), Dim), 2, 3) {
  const Crowd<Dim> crowd;
  const auto& data = crowd.scene->data();
  const auto at = crowd.at(crowd.v, 1);
  const auto pairs = contact::find_candidates<Dim>(data, at.points, at.points, crowd.weights.reach);
  const auto terms = contact::contact_terms<Dim>(data, crowd.interval, at, pairs, crowd.friction, crowd.weights,
                                                 HessianProjection::exact, {});
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
    REQUIRE(
        advance<Dim>(s.body, ElasticScheme::backward_euler, 0.02, {force, true}, {}, {}, workspace, other).converged);
    CHECK((s.state.u - other.u).template lpNorm<Eigen::Infinity>() < 1e-7);
  }
  CHECK(world.report.active == 0);
}

TEMPLATE_TEST_CASE_SIG("soft blocks rest on each other", "[soft]", ((int Dim), Dim), 2, 3) {
  SoftWorld<Dim> world;
  world.gravity = Vec3(0, -10, 0);
  world.walls = {{Vec3::Zero(), Vec3(0, 1, 0)}};
  const double g = 10, density = 1000, dt = 0.1;
  for (int i = 0; i < 2; ++i) {
    const Vec<Dim> low = Vec<Dim>::Unit(1) * (1.001 * i + 0.001) + Vec<Dim>::Unit(0) * 0.05 * i;
    world.add(box_mesh<Dim>(low, low + Vec<Dim>::Ones(), IVec<Dim>::Constant(2), 1), density, 1e6, 0).friction =
        0.5;  // without friction the upper block slides off the unevenly compressed lower one
  }
  for (int n = 0; n < 80; ++n) world.step(dt);
  double speed = 0;
  for (const auto& s : world.soft) speed = std::max(speed, s.state.v.template lpNorm<Eigen::Infinity>());
  WARN(Dim << "D, two blocks: speeds " << speed << " m/s, smallest gap " << world.report.smallest_gap << " m, "
           << world.newton_iterations / 80. << " iterations a step");
  CHECK(speed < 1e-4);
  CHECK(world.report.smallest_gap > 0.05 * world.options.reach);
  for (int b : {0, 1}) CHECK(world.report.impulses[b].linear[1] == Approx(dt * density * g).epsilon(1e-3));
  CHECK(world.overlaps() == 0);
}

// The weight of the heaviest body presses one pair to half the reach. Pairs below a lighter body and below a heavy
// rigid body keep similar gaps: no stiffening occurs, which would throw bodies up.
TEMPLATE_TEST_CASE_SIG("heavy bodies on soft ones keep their gaps", "[soft]", ((int Dim), Dim), 2, 3) {
  SoftWorld<Dim> world;
  world.gravity = Vec3(0, -9.81, 0);
  world.walls = {{Vec3::Zero(), Vec3(0, 1, 0)}};
  world.add(box_mesh<Dim>(Vec<Dim>::Unit(1) * 1e-3, Vec<Dim>::Ones(), IVec<Dim>::Constant(2), 1), 20000, 2e6, 0.3)
      .friction = 0.5;
  Vec3 half = Vec3::Constant(0.5);
  half[1] = 1.2508;
  const double mass = Dim == 2 ? 2000 : 1000;
  world.add_rigid(box<Dim>(Vec3::Constant(0.5)), half, mass, Vec3::Constant(mass / 24)).contact.friction = 0.5;
  for (int n = 0; n < 60; ++n) world.step(0.05);
  const double weighs = world.report.impulses[0].linear[1] / (0.05 * mass * 9.81);
  const double usual = contact::stiffness_for(world.mass(world.soft[0]) * 9.81, world.options.reach);
  WARN(Dim << "D, heavy: gap " << world.report.smallest_gap << " m, stiffness " << world.report.stiffness / usual
           << " times the usual, the upper weighs " << weighs);
  CHECK(world.report.stiffness == Approx(usual));
  CHECK(world.report.smallest_gap > 0.2 * world.options.reach);
  CHECK(weighs == Approx(1).epsilon(0.01));
}

// Pinned nodes drive one block, a prescribed piston the other, until they press on each other.
TEMPLATE_TEST_CASE_SIG("held nodes and prescribed bodies press soft bodies together", "[soft]", ((int Dim), Dim), 2,
                       3) {
  SoftWorld<Dim> world;
  auto& piston = world.add_rigid(box<Dim>(Vec3(1, 0.5, 1)), Vec3(0.5, 2.26, 0.5), 0, Vec3::Ones());
  piston.contact.control = BodyControl::prescribed;
  for (int i = 0; i < 2; ++i) {
    const Vec<Dim> low = Vec<Dim>::Unit(1) * 1.005 * i;
    world.add(box_mesh<Dim>(low, low + Vec<Dim>::Ones(), IVec<Dim>::Constant(2), 1), 1000, 1e5, 0.3);
  }
  auto& s = world.soft[0];
  for (int n : nodes_where(s.body.mesh, [](const Vec<Dim>& X) { return X[1] < 1e-9; }))
    for (int axis = 0; axis < Dim; ++axis) s.held[Dim * n + axis] = axis == 1 ? 0.2 : 0;
  for (int n = 0; n < 10; ++n) {
    Pose end = world.rigid[0].pose;
    end.displacement[1] -= 0.02;
    world.step(0.1, {{0, end}});
    REQUIRE(world.overlaps() == 0);
  }
  for (const auto& [dof, speed] : world.soft[0].held)
    CHECK(world.soft[0].state.u[dof] == Approx(10 * 0.1 * speed).margin(1e-15));
  const auto& impulses = world.report.impulses;
  const double push = impulses[0].linear[1] / 0.1;
  WARN(Dim << "D: squeezed by 0.4 m with " << push << " N, " << world.newton_iterations / 10. << " iterations a step");
  CHECK(push > 1e4);
  CHECK((impulses[0].linear + impulses[1].linear + impulses[2].linear).norm() < 1e-12 * push);
}

// A comb whose teeth are closer than the reach at rest does not push itself apart; a body that crosses itself is
// reported.
TEST_CASE("what is near by its shape does not push, what crosses itself is reported", "[soft]") {
  SoftWorld<2> world;
  world.options.reach = 0.3;
  ElasticMesh<2> comb = box_mesh<2>(Vec<2>::Zero(), Vec<2>(1, 1), IVec<2>(5, 5), 1), cut = comb;
  cut.elements.clear();
  for (int e = 0; e < comb.element_count(); ++e) {  // removes every second column of the upper part
    Vec<2> middle = Vec<2>::Zero();
    for (int a = 0; a < 3; ++a) middle += comb.nodes[comb.element(e)[a]] / 3;
    if (middle[1] < 0.2 || int(middle[0] * 5) % 2 == 0)
      cut.elements.insert(cut.elements.end(), comb.element(e), comb.element(e) + 3);
  }
  std::vector<std::string> notes;
  check_mesh<2>(cut, "comb", notes);
  auto& s = world.add(cut, 1000, 1e5, 0.3);
  world.step(0.01);
  CHECK(world.report.active == 0);
  CHECK(s.state.v.isZero(1e-12));
  CHECK(world.overlaps() == 0);
  for (size_t n = 0; n < s.body.mesh.nodes.size(); ++n) {  // the left tooth leans over the gap
    const Vec<2> X = s.body.mesh.nodes[n];
    if (X[0] < 0.21 && X[1] > 0.21) s.state.u[2 * Eigen::Index(n)] = 0.5 * (X[1] - 0.2);
  }
  const auto found = find_initial_overlaps<2>(world.scene(), world.motions(), 1e-6);
  REQUIRE(found.size() == 1);
  CHECK(found[0].body == 0);
  CHECK(found[0].other == 0);
  CHECK(found[0].message == "body 0 intersects itself");
}

TEST_CASE("a deformable surface off its mesh's nodes is refused", "[soft]") {
  ContactBody body{box<2>(Vec3::Ones()), BodyControl::deformable, 1, {}, "jelly", {0, 1, 4, 3}, 4};
  CHECK_THROWS_WITH(ContactScene<2>({body}, {}), "jelly: point 2 of its surface coincides with no node of its mesh");
}

TEMPLATE_TEST_CASE_SIG("soft bodies go straight as far as is surely free, and a solve goes on from an earlier one",
                       "[soft]", ((int Dim), Dim), 2, 3) {
  SoftWorld<Dim> world;
  world.walls = {{Vec3(0, -0.1, 0), Vec3(0, 1, 0)}};
  auto& s = world.add(box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Constant(2), 1), 1000, 1e5, 0.3);
  for (int i = 1; i < s.body.size(); i += Dim) s.state.v[i] = -2;
  const double dt = 0.1, share = largest_safe_fraction<Dim>(world.scene(), world.motions(), dt, s.state.v);
  CHECK(share <= 0.4);  // a fifth of the gap of 0.1 m is kept; the path is 0.2 m
  CHECK(share > 0.39);
  DryProblem inertia = world.problem(dt);
  const auto potential = world.potential(dt, inertia.size());
  const auto solve = [&](const Eigen::VectorXd& start) {
    return solve_contact<Dim>(world.scene(), world.motions(), dt, dt, inertia, world.options, start, &potential);
  };
  const ContactReport cold = solve({}), warm = solve(cold.velocity);
  REQUIRE(cold.failure.empty());
  REQUIRE(warm.failure.empty());
  CHECK(cold.active > 0);
  CHECK(cold.straight_share == 1);
  CHECK(warm.newton_iterations < cold.newton_iterations);
  CHECK((warm.velocity - cold.velocity).template lpNorm<Eigen::Infinity>() < world.options.speed_tolerance);
}

namespace {

// Bodies without liquid that note where the first gradient was asked for.
struct NotedProblem : DryProblem {
  NotedProblem(const DryProblem& problem, bool notices) : DryProblem(problem), notices(notices) {}
  InertiaResponse respond(const Eigen::VectorXd& v) override {
    if (first.size() == 0) first = v;
    return DryProblem::respond(v);
  }
  bool notices_indefinite() const override { return notices; }

  bool notices;
  Eigen::VectorXd first;
};

}  // namespace

TEST_CASE("a solve starts from a guess only where an indefinite Hessian is noticed", "[soft]") {
  for (const bool notices : {true, false}) {
    SoftWorld<2> world;
    auto& ball = world.add(ball_mesh<2>(0.5, {0, 0}, 4, 1), 1000, 1e5, 0.3);
    ball.state.v.setConstant(0.1);
    NotedProblem problem(world.problem(0.01), notices);
    const auto energy = world.potential(0.01, problem.size());
    auto motions = world.motions();
    motions[0].guess = ball.state.v;
    const ContactReport report =
        solve_contact<2>(world.scene(), motions, 0.01, 0.01, problem, world.options, {}, &energy);
    REQUIRE(report.failure.empty());
    CHECK((report.velocity - ball.state.v).norm() < 1e-9);
    CHECK(problem.first.isZero(0) == !notices);
  }
}

}  // namespace soft_contact_tests
