// Consistency of energy, force and stiffness; masses; the patch test; steps without inversion.
#include <Eigen/Dense>
#include <random>

#include "unit/solid/elastic_cases.h"

namespace elastic_body_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

template <int Dim>
ElasticMesh<Dim> distorted_box(int cells, int order, double shift) {
  auto mesh = box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Constant(cells), 1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> move(-shift / cells, shift / cells);
  for (auto& X : mesh.nodes) {
    if ((X.array() > 1e-9).all() && (X.array() < 1 - 1e-9).all())
      X += Vec<Dim>::NullaryExpr([&] { return move(random); });
  }
  return order == 1 ? mesh : promote_to_quadratic(mesh);
}

template <int Dim>
std::vector<int> boundary_nodes(const ElasticMesh<Dim>& mesh) {
  return nodes_where(mesh, [](const Vec<Dim>& X) { return (X.array() < 1e-9).any() || (X.array() > 1 - 1e-9).any(); });
}

Eigen::VectorXd random_vector(int size, double amplitude) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> entry(-amplitude, amplitude);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return entry(random); });
}

// Central differences along one direction: truncation and cancellation about 1e-9 relative.
template <int Dim>
void check_differences(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, double h) {
  const Eigen::VectorXd d = random_vector(body.size(), 1).reverse();
  const double slope = (elastic_energy(body, u + h * d) - elastic_energy(body, u - h * d)) / (2 * h);
  const Eigen::VectorXd g = elastic_gradient(body, u);
  CHECK(std::abs(slope - g.dot(d)) < 1e-7 * g.norm() * d.norm());
  SparseMatrix K = body.pattern;
  add_stiffness(body, u, HessianProjection::exact, K);
  const Eigen::VectorXd bend = (elastic_gradient(body, u + h * d) - elastic_gradient(body, u - h * d)) / (2 * h);
  CHECK((K * d - bend).norm() < 1e-7 * bend.norm());
  CHECK(SparseMatrix(K - SparseMatrix(K.transpose())).norm() < 1e-14 * K.norm());
}

// With u = A X + b on the boundary the inside follows for any material, since stress is uniform.
template <int Dim>
void check_patch(int order, std::string_view material) {
  ElasticProperties properties;
  properties.lame = lame_of(2e11, 0.3);
  const auto body =
      make_elastic_body<Dim>(distorted_box<Dim>(3, order, 0.25), elastic_material<Dim>(material), properties);
  Gradient<Dim> A = Gradient<Dim>::Zero();
  A.template topLeftCorner<2, 2>() << 2e-6, 3e-6, 5e-6, 6e-6;
  const Eigen::VectorXd exact =
      at_nodes(body.mesh, [&](const Vec<Dim>& X) -> Vec<Dim> { return A * X + Vec<Dim>::Constant(1e-6); });
  Pins pins = pin_nodes<Dim>(boundary_nodes(body.mesh));
  for (size_t i = 0; i < pins.dofs.size(); ++i) pins.targets[i] = exact[pins.dofs[i]];
  MinimizeOptions options;
  options.step_tolerance = 1e-12;  // for a body of size 1 that moves by 1e-5
  ElasticWorkspace workspace;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(body.size());
  const auto report = solve_static<Dim>(body, u, pins, 1, options, workspace, u);
  INFO(Dim << "D, order " << order << ", " << material << ": " << report.failure);
  REQUIRE(report.converged);
  const double error = (u - exact).lpNorm<Eigen::Infinity>() / exact.lpNorm<Eigen::Infinity>();
  CHECK(error < 1e-9);  // F = 1 + 1e-6 has round-off 1e-16: 1e-10 of the strain
  WARN("patch test " << Dim << "D, order " << order << ", " << material << ": " << error);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Force and stiffness of a body are derivatives of its energy", "[elastic]", ((int Dim), Dim), 2,
                       3) {
  for (int order : {1, 2}) {
    const auto body = elastic_body<Dim>(distorted_box<Dim>(2, order, 0.2), "stable_neo_hookean", 1000, 1e4, 0.4);
    const Eigen::VectorXd shake = random_vector(body.size(), 0.02);
    check_differences<Dim>(body, shake, 1e-6);
    // Compressed along x to 6 % of the volume, where the guard acts at every point; it varies over much shorter steps.
    check_differences<Dim>(
        body,
        0.01 * shake +
            at_nodes(body.mesh, [](const Vec<Dim>& X) -> Vec<Dim> { return -0.94 * X[0] * Vec<Dim>::Unit(0); }),
        1e-7);
  }
}

TEMPLATE_TEST_CASE_SIG("An elastic body has the mass of its volume", "[elastic]", ((int Dim), Dim), 2, 3) {
  for (int order : {1, 2}) {
    const auto body = elastic_body<Dim>(distorted_box<Dim>(2, order, 0.2), "corotated", 700, 1, 0);
    CHECK(std::abs(body.mass.sum() / Dim - 700) < 1e-10);
    CHECK(std::abs(body.lumped_mass.sum() / Dim - 700) < 1e-10);
    CHECK(body.lumped_mass.minCoeff() > 0);
    const auto x = at_nodes(body.mesh, [](const Vec<Dim>& X) { return X; });  // integral of rho |X|^2 = rho Dim / 3
    CHECK(std::abs(x.dot(body.mass * x) - 700 * Dim / 3.) < 1e-10);
    const Eigen::VectorXd weight = body_force<Dim>(body, [](const Vec<Dim>&) -> Vec<Dim> { return Vec<Dim>::Unit(1); });
    CHECK(std::abs(weight.sum() - 1) < 1e-13);
  }
}

TEMPLATE_TEST_CASE_SIG("The patch test is met to round-off", "[elastic]", ((int Dim), Dim), 2, 3) {
  for (int order : {1, 2}) {
    for (const auto& row : elastic_materials<Dim>()) check_patch<Dim>(order, row.name);
  }
}

// A step to the mirror image would invert all elements; the bound stops just before the first inversion.
TEMPLATE_TEST_CASE_SIG("The inversion bound keeps every volume", "[elastic]", ((int Dim), Dim), 2, 3) {
  for (int order : {1, 2}) {
    const auto body = elastic_body<Dim>(distorted_box<Dim>(2, order, 0.2), "corotated", 1, 1, 0);
    const Eigen::VectorXd u = Eigen::VectorXd::Zero(body.size()), d = random_vector(body.size(), 3);
    const double share = inversion_bound(body, u, d);
    CHECK(share < 1);
    CHECK(share > 0);
    for (double t = 0; t <= 1; t += 1. / 64) CHECK(least_volume_ratio(body, u + t * share * d) >= 0.1 - 1e-12);
    CHECK(least_volume_ratio(body, u + share * d) < 0.102);
    CHECK(inversion_bound(body, u, 1e-4 * d) == 1);
  }
}

// Pins compress a block to a fifth of its height in one step.
TEST_CASE("A squeezed block stays free of inversions", "[elastic]") {
  for (const auto& row : elastic_materials<2>()) {
    if (row.name == "st_venant_kirchhoff") continue;  // no minimum under such compression
    for (int order : {1, 2}) {
      const auto body = elastic_body<2>(distorted_box<2>(4, order, 0.2), std::string(row.name).c_str(), 1, 1e5, 0.4);
      Pins pins = pin_nodes<2>(nodes_where(body.mesh, [](const Vec<2>& X) { return X[1] < 1e-9 || X[1] > 1 - 1e-9; }));
      for (size_t i = 0; i < pins.dofs.size(); ++i) {
        if (pins.dofs[i] % 2 == 1 && body.mesh.nodes[pins.dofs[i] / 2][1] > 0.5) pins.targets[i] = -0.4;
      }
      ElasticWorkspace workspace;
      Eigen::VectorXd u = Eigen::VectorXd::Zero(body.size());
      const auto report = solve_static<2>(body, u, pins, 1, {}, workspace, u);
      INFO(row.name << ", order " << order << ": " << report.failure << ", " << report.iterations << " steps");
      CHECK(report.converged);
      CHECK(report.least_volume_ratio > 0);
    }
  }
}

}  // namespace elastic_body_tests
