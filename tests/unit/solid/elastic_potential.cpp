// Energy of elastic bodies as a function of velocities, and fixed degrees of freedom.
#include <random>

#include "solid/elastic/potential.h"
#include "solid/energy/rigid_problem.h"
#include "unit/solid/elastic_cases.h"

namespace elastic_potential_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

// Two blocks whose velocities begin at `gap` and after those of the first block; other unknowns lie before and between.
template <int Dim>
struct TwoBlocks {
  ElasticBody<Dim> body = elastic_body<Dim>(box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Ones(), 2),
                                            "stable_neo_hookean", 1000, 1e4, 0.3);
  Eigen::VectorXd one, other, v;
  double dt = 0.02, horizon = 0.015;

  TwoBlocks() {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> range(-1, 1);
    one = Eigen::VectorXd::NullaryExpr(body.size(), [&] { return 0.05 * range(random); });
    other = Eigen::VectorXd::NullaryExpr(body.size(), [&] { return 0.05 * range(random); });
    v = Eigen::VectorXd::NullaryExpr(2 * body.size() + 5, [&] { return range(random); });
  }
  ElasticPotential<Dim> potential() const {
    constexpr double most = 3e3;  // Pa; below the stress of some points, above that of others
    return {{{&body, &one, 3, {}}, {&body, &other, 5 + body.size(), hold_pressure(body, other, most)}},
            int(v.size()),
            dt,
            horizon};
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("the energy of elastic bodies by velocities has the derivatives it claims", "[elastic]",
                       ((int Dim), Dim), 2, 3) {
  const TwoBlocks<Dim> blocks;
  const auto potential = blocks.potential();
  const auto gradient = [&](const Eigen::VectorXd& v) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(v.size());
    potential.add_gradient(v, g);
    return g;
  };
  Eigen::VectorXd g = Eigen::VectorXd::Constant(blocks.v.size(), 7);
  potential.add_gradient(blocks.v, g);
  g.array() -= 7;  // existing entries are kept
  const Eigen::SparseMatrix<double> K =
      potential.hessian(blocks.v, HessianProjection::exact, {0, int(blocks.v.size())});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range(-1, 1);
  const double h = 1e-4;
  for (int sample = 0; sample < 5; ++sample) {
    const Eigen::VectorXd p = Eigen::VectorXd::NullaryExpr(g.size(), [&] { return range(random); });
    const auto E = [&](double s) { return potential.energy(blocks.v + s * h * p); };
    CHECK((8 * (E(1) - E(-1)) - (E(2) - E(-2))) / (12 * h) == Approx(g.dot(p)).epsilon(1e-8));
    const Eigen::VectorXd difference = (gradient(blocks.v + h * p) - gradient(blocks.v - h * p)) / (2 * h);
    CHECK((difference - K * p).norm() < 1e-7 * (K * p).norm());
  }
  CHECK(g.head(3).isZero(0));
}

TEMPLATE_TEST_CASE_SIG("held pressure adds neither energy nor force where it is held, and takes all stiffness from it",
                       "[elastic]", ((int Dim), Dim), 2, 3) {
  const auto body = elastic_body<Dim>(box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Ones(), 2),
                                      "st_venant_kirchhoff", 1000, 1e4, 0.3);
  Eigen::VectorXd u(body.size()), turned(body.size());
  constexpr double squeeze = 0.05, angle = 0.02;
  for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n) {
    const Vec<Dim> X = body.mesh.nodes[n];
    u.template segment<Dim>(Dim * Eigen::Index(n)) = -squeeze * X;
    Vec<Dim> x = (1 - squeeze) * X;
    x.template head<2>() = Eigen::Rotation2Dd(angle) * Vec<2>(x.template head<2>());
    turned.template segment<Dim>(Dim * Eigen::Index(n)) = x - X;
  }
  const HeldPressure<Dim> held = hold_pressure<Dim>(body, u, 1e9);
  CHECK(held.pressure.size() == body.weights.size());
  CHECK(elastic_energy(body, u, held) == elastic_energy(body, u));
  const double size = elastic_gradient(body, u).norm();
  CHECK((elastic_gradient(body, u, held) - elastic_gradient(body, u)).norm() < 1e-14 * size);
  // The force of a uniform pressure rotates with the body. Without that, stress in a rotated body leaves a force.
  const Eigen::VectorXd dead = elastic_gradient(body, turned) - elastic_gradient(body, u),
                        follows = elastic_gradient(body, turned, held) - elastic_gradient(body, u, held);
  CHECK(dead.norm() > 0.5 * angle * size);
  CHECK(follows.norm() < 1e-12 * size);
  CHECK(hold_pressure<Dim>(body, -u, 1e9).pressure == std::vector<double>(body.weights.size()));  // none if stretched
}

TEST_CASE("a step of elastic bodies is bounded where one of them would turn inside out", "[elastic]") {
  TwoBlocks<2> blocks;
  blocks.one.setZero();
  blocks.other.setZero();
  const auto potential = blocks.potential();
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(blocks.v.size());
  Eigen::VectorXd squeeze = rest;  // x -> -x within the interval
  for (size_t n = 0; n < blocks.body.mesh.nodes.size(); ++n)
    squeeze[5 + blocks.body.size() + 2 * Eigen::Index(n)] = -2 * blocks.body.mesh.nodes[n][0] / blocks.horizon;
  const double share = potential.step_bound(rest, squeeze);
  CHECK(share == Approx(0.45).epsilon(0.01));  // at a tenth of the volume
  CHECK(std::isfinite(potential.energy(share * squeeze)));
  CHECK(!std::isfinite(potential.energy(squeeze)));
}

TEST_CASE("held degrees of freedom have their velocities and pull on the others") {
  const int n = 4;
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n) * 3, K = Eigen::MatrixXd::Constant(n, n, 0.3);
  M(0, 1) = M(1, 0) = 0.5;
  K.diagonal().array() += 2;
  const Eigen::VectorXd target = Eigen::Vector4d(1, -2, 3, 0.5), r = Eigen::Vector4d(0.1, 0.2, -0.3, 1);
  DryProblem problem(M.sparseView(), target, {Freedom::free, Freedom::fixed, Freedom::free, Freedom::fixed},
                     Eigen::Vector4d(9, 0.7, 9, -0.4));
  CHECK(!problem.holds(Eigen::VectorXd::Zero(n)));
  const InertiaResponse response = problem.minimise(K.sparseView(), r);
  const Eigen::VectorXd& v = response.velocity;
  CHECK(v[1] == 0.7);
  CHECK(v[3] == -0.4);
  CHECK(problem.holds(v));
  const Eigen::VectorXd residual = M * (v - target) + K * v - r;  // no force on free ones
  CHECK(std::abs(residual[0]) < 1e-14);
  CHECK(std::abs(residual[2]) < 1e-14);
  DryProblem still(M.sparseView(), target, {Freedom::free, Freedom::fixed});
  CHECK(still.holds(Eigen::VectorXd::Zero(n)));
  CHECK(still.minimise(K.sparseView(), r).velocity[1] == 0);
}

}  // namespace elastic_potential_tests
