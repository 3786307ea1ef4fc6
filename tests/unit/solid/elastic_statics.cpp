// Static solutions against the literature: Cook's membrane, large deflection, CSM1 of Turek and Hron, locking.
#include "unit/solid/elastic_cases.h"

namespace elastic_statics_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

// u_y (mm) of the corner (48, 60) of Cook's membrane (0,0) (48,44) (48,60) (0,44), clamped on the left, sheared by 6.25
// MPa on the right. E = 70 MPa, nu = 1/3, plane strain, small strain: 1e-6 of the load, result times 1e6.
double cook(int cells, int order) {
  auto mesh = box_mesh<2>(Vec<2>::Zero(), Vec<2>::Ones(), IVec<2>::Constant(cells), order);
  for (auto& X : mesh.nodes) X = Vec<2>(48 * X[0], 44 * X[0] + X[1] * (44 - 28 * X[0]));
  const auto body = elastic_body<2>(std::move(mesh), "st_venant_kirchhoff", 1, 70, 1. / 3);
  const auto right = faces_where(body.mesh, [](const Vec<2>& X) { return X[0] > 48 - 1e-6; });
  const Eigen::VectorXd load = 1e-6 * traction_force<2>(body, right, [](const Vec<2>&) -> Vec<2> { return {0, 6.25}; });
  const Pins clamp = pin_nodes<2>(nodes_where(body.mesh, [](const Vec<2>& X) { return X[0] < 1e-6; }));
  ElasticWorkspace workspace;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(body.size());
  const auto report = solve_static<2>(body, load, clamp, 1, {}, workspace, u);
  CHECK(report.converged);
  return 1e6 * u[2 * node_nearest<2>(body.mesh, Vec<2>(48, 60)) + 1];
}

struct Bent {
  double deflection, shortening;
  MinimizeReport report;
};

// Displacement of the tip, across and along, over the length, under a dead tip load P with the given P L^2 / (E I).
Bent bend(const Strip& s, double bending_stiffness, double load_number, int load_steps) {
  const double P = load_number * bending_stiffness / (s.length * s.length);
  const Eigen::VectorXd load = traction_force<2>(s.body, s.end, [&](const Vec<2>&) -> Vec<2> {
    return {0, P / s.height};
  });
  ElasticWorkspace workspace;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(s.body.size());
  const auto report = solve_static<2>(s.body, load, s.clamp, load_steps, {}, workspace, u);
  INFO(report.failure);
  CHECK(report.converged);
  return {u[2 * s.tip + 1] / s.length, -u[2 * s.tip] / s.length, report};
}

}  // namespace

TEST_CASE("Cook's membrane deflects as published", "[elastic]") {
  const double fine = cook(32, 2);
  CHECK(std::abs(fine - 32.26) < 0.005 * 32.26);
  WARN("Cook's membrane, published 32.20 to 32.28 mm: P2 8x8 " << cook(8, 2) << ", 16x16 " << cook(16, 2) << ", 32x32 "
                                                               << fine << "; P1 32x32 " << cook(32, 1));
}

// Elastica under a dead tip load. nu = 0 makes plane strain the beam's uniaxial stress; L / h = 100 makes shear and
// stretch small.
TEST_CASE("A cantilever deflects far as the elastica does", "[elastic]") {
  struct Row {
    double load, deflection, shortening;
  };
  for (const Row& row : {Row{1, 0.30172, 0.05643}, Row{5, 0.71379, 0.38763}, Row{10, 0.81061, 0.55500}}) {
    const auto strip = clamped_strip(1, 0.01, IVec<2>(50, 1), 2, "st_venant_kirchhoff", 1, 1e7, 0);
    const Bent bent = bend(strip, 1e7 * 1e-6 / 12, row.load, 4);
    WARN("PL2/EI = " << row.load << ": deflection " << bent.deflection << " (" << row.deflection << "), shortening "
                     << bent.shortening << " (" << row.shortening << "), Newton steps " << bent.report.iterations
                     << ", " << bent.report.projected << " projected");
    CHECK(std::abs(bent.deflection / row.deflection - 1) < 0.01);
    CHECK(std::abs(bent.shortening / row.shortening - 1) < 0.01);
  }
}

// Small deflection over P L^3 / (3 D) (1 + shear), D = E h^3 / (12 (1 - nu^2)), shear 3 D / (5/6 G h L^2).
double bending_share(double nu, const IVec<2>& cells, int order) {
  const double L = 1, h = 0.1, E = 1e6, D = E * h * h * h / (12 * (1 - nu * nu)), G = E / (2 * (1 + nu));
  const double beam = 1e-4 / 3 * (1 + 3 * D / (5. / 6 * G * h * L * L));
  return bend(clamped_strip(L, h, cells, order, "stable_neo_hookean", 1, E, nu), D, 1e-4, 1).deflection / beam;
}

// The clamp also fixes the cross section of the end, unlike beam theory, so the reference is the finest strip.
TEST_CASE("Quadratic elements do not lock in bending", "[elastic]") {
  for (double nu : {0.3, 0.49, 0.4999}) {
    const double fine = bending_share(nu, IVec<2>(80, 8), 2);
    WARN("bending, nu " << nu << ": P2 with 8 elements through the thickness has " << fine
                        << " of the beam's deflection");
    for (int order : {1, 2}) {
      for (const IVec<2>& cells : {IVec<2>(10, 1), IVec<2>(20, 2), IVec<2>(40, 4)}) {
        const double share = bending_share(nu, cells, order) / fine;
        WARN("bending, nu " << nu << ", P" << order << ", " << cells[1] << " through the thickness: " << share
                            << " of the finest");
        if (order == 2 && cells[1] >= 2) CHECK(std::abs(share - 1) < 0.05);
      }
    }
  }
}

}  // namespace elastic_statics_tests
