// What a solve with elastic bodies costs: iterations at any stiffness, density and resolution.
#include <catch2/catch.hpp>

#include "coupling/liquid_problem.h"
#include "coupling/transport.h"
#include "rigid_scenes.h"

using namespace seiche;

namespace {

// A block in the middle of a pool, wholly under water.
Scene immersed_block(int cells, double youngs_modulus, double ratio) {
  Scene s = test::box_scene(3, cells);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 0.8);
  SolidSpec block;
  block.name = "block";
  block.kind = SolidKind::elastic;
  block.shape.kind = "box";
  block.shape.lower = {0.3, 0.25, 0.35};
  block.shape.upper = {0.7, 0.55, 0.65};
  block.shape.where = "test";
  block.rigid.density = 1000 * ratio;
  block.elastic.youngs_modulus = youngs_modulus;
  block.elastic.poisson_ratio = 0.4;
  block.elastic.element_size = 0.05;
  s.solids.push_back(block);
  return s;
}

// Iterations of the first Newton step of a first step of 1 ms, from zero pressure.
int iterations(const Scene& scene) {
  constexpr int Dim = 3;
  constexpr double dt = 1e-3;
  const Setup<Dim> s(scene, Communicator());
  State<Dim> state = initial_state(s);
  StepGeometry<Dim> g = s.solids.measure(place_bodies(s, state), 0);
  const ProjectionInput<Dim> in{s.layout, s.halo, s.ranks, state.phi, g.faces, s.density(), dt};
  const PressureRows<Dim> rows = number_rows(in);
  const SolidCoupling<Dim> coupling = couple_solids(s, g, rows, state, dt, dt);
  const double c1 = s.density() * s.layout.h() / dt, c2 = dt * s.layout.geometry().face_area();
  const DistributedMatrix A = assemble_pressure_matrix(in, rows);
  const RowGrid grid = row_grid(in, rows);
  SpdSolver solver(A, grid, find_closed_components(in, rows), coupling.J, c1 * c2, {.tolerance = 1e-8}, s.ranks);
  const Vector b = pressure_right_side(in, rows, transport_velocity(s, state, state.phi, dt));
  Vector p(b.size());
  LiquidProblem<Dim> problem(coupling, solver, b, p, c1, c2, s.ranks);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(coupling.size());
  std::vector<Eigen::Triplet<double>> entries;
  coupling.potential->add_terms(Eigen::VectorXd::Zero(coupling.size()), Curvature::exact, gradient, entries);
  SparseMatrix K(coupling.size(), coupling.size());
  K.setFromTriplets(entries.begin(), entries.end());
  const InertiaResponse response = problem.minimise(K, -gradient);
  INFO(response.failure);
  REQUIRE(response.failure.empty());
  REQUIRE(response.shape == Shape::convex);
  CHECK(problem.report().ladder.empty());
  return problem.report().iterations;
}

void check_block(int cells) {
  const std::array<std::pair<double, int>, 3> bars{{{1, 12}, {0.1, 14}, {0.01, 24}}};
  for (const auto& [ratio, bar] : bars)
    for (const double E : {1e3, 1e5, 1e7, 1e9}) {
      const int n = iterations(immersed_block(cells, E, ratio));
      if (Communicator().is_root())
        WARN(cells << "^3, ratio " << ratio << ", E " << E << ": " << n << " iterations (bar " << bar << ")");
      CHECK(n <= bar);
    }
}

}  // namespace

TEST_CASE("iterations depend little on the stiffness and density of an immersed block", "[elastic][ranks]") {
  check_block(32);
  check_block(48);
}

TEST_CASE("iterations depend little on the stiffness and density of an immersed block in 64^3 cells", "[elastic]") {
  check_block(64);
}
