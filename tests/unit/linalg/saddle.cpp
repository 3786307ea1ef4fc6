#include "linalg/core/dense_factors.h"

#include "unit/linalg/saddle_problems.h"

namespace saddle_tests {
using namespace seiche;
using namespace seiche::cases;

namespace {

// The same on every rank.
Vector gathered(const Vector& own, Row first, Row total, const Communicator& ranks) {
  Vector all(std::size_t(total), 0.0);
  std::copy(own.begin(), own.end(), all.begin() + first);
  ranks.global_sum(all);
  return all;
}

// The whole matrix, entry by entry, without code of src/linalg.
Eigen::MatrixXd dense(const StokesMatrices& m, const Communicator& ranks) {
  const auto nf = Eigen::Index(m.F.global_rows), nv = Eigen::Index(m.H.rows()), np = Eigen::Index(m.D.global_rows);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(nf + nv + np, nf + nv + np);
  const auto put = [&](const DistributedMatrix& A, Eigen::Index row, Eigen::Index column) {
    for (int i = 0; i < A.rows(); ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        K(row + A.first_row + i, column + A.column[k]) += A.value[k];
  };
  put(m.F, 0, 0);
  put(m.Dt, 0, nf + nv);
  put(m.D, nf + nv, 0);
  const auto put_columns = [&](const BlockColumns& B, Eigen::Index row) {
    B.for_each([&](int i, int k, double value) { K(row + i, nf + k) += value, K(nf + k, row + i) += value; });
  };
  put_columns(m.G, m.F.first_row);
  put_columns(m.J, nf + nv + m.D.first_row);
  ranks.global_sum(std::span<double>(K.data(), std::size_t(K.size())));
  K.block(nf, nf, nv, nv) = Eigen::MatrixXd(m.H);
  return K;
}

Eigen::VectorXd dense(const StokesMatrices& m, const Vector& u, const Eigen::VectorXd& v, const Vector& p,
                      const Communicator& ranks) {
  const Vector all_u = gathered(u, m.F.first_row, m.F.global_rows, ranks);
  const Vector all_p = gathered(p, m.D.first_row, m.D.global_rows, ranks);
  Eigen::VectorXd x(Eigen::Index(all_u.size() + all_p.size()) + v.size());
  x << Eigen::Map<const Eigen::VectorXd>(all_u.data(), Eigen::Index(all_u.size())), v,
      Eigen::Map<const Eigen::VectorXd>(all_p.data(), Eigen::Index(all_p.size()));
  return x;
}

// Compares with a dense factorisation; pressures up to the null space.
void check_against_dense(const Stokes& s) {
  const Communicator ranks;
  const StokesMatrices m = cases::StokesBuilder(s, ranks).make();
  const Problem p = pose(m);
  const Answer a = solve(m, p, ranks, {.tolerance = 1e-11});
  CAPTURE(a.report.failed_attempts, a.report.momentum, a.report.continuity);
  CHECK(a.report.converged);
  const Eigen::MatrixXd K = dense(m, ranks);
  CHECK((K - K.transpose()).norm() <= 1e-13 * K.norm());
  const Eigen::VectorXd b = dense(m, p.f, p.g, p.q, ranks), x = dense(m, a.u, a.v, a.p, ranks);
  const Eigen::VectorXd exact = K.completeOrthogonalDecomposition().solve(b);
  const Eigen::Index n = m.F.global_rows + m.H.rows();
  // Residual of 1e-11 times the condition of velocities against forces.
  CHECK((x - exact).head(n).norm() <= 1e-7 * exact.head(n).norm());
  CHECK((K * x - b).norm() <= 1e-8 * b.norm());
}

}  // namespace

TEST_CASE("saddle: equal to a dense factorisation") {
  const double viscosity = GENERATE(1e-3, 1.0, 1e4);
  CAPTURE(viscosity);
  SECTION("a closed box with a ball") {
    Stokes s = liquid(2, 10, viscosity);
    add_ball(s, GENERATE(0.0, 1.0, 1000.0));
    check_against_dense(s);
  }
  SECTION("a free surface and an inclusion") {
    Stokes s = liquid(2, 10, viscosity);
    add_surface(s);
    add_inclusion(s, viscosity, 100);
    check_against_dense(s);
  }
  SECTION("3D") {
    Stokes s = liquid(3, 6, viscosity);
    add_ball(s, 0.1, 0.25);
    check_against_dense(s);
  }
  SECTION("periodic") {
    Stokes s = liquid(2, 9, viscosity);
    s.box.periodic = {1, 1, 0};
    add_ball(s, 0.1);
    check_against_dense(s);
  }
  SECTION("liquid shut in behind a body that feels its pressure") {
    Stokes s = liquid(2, 10, viscosity);
    s.box.periodic = {1, 0, 0};
    s.body_density = 1;
    s.centre = {5, 5, 0};
    s.body = [](Cell c) { return c[1] == 4 || c[1] == 5; };
    s.box.kind = [](Cell c) { return c[1] == 4 || c[1] == 5 ? Kind::wall : c[1] == 9 ? Kind::air : Kind::liquid; };
    check_against_dense(s);
  }
}

TEST_CASE("saddle: the same on one rank as on several") {
  const Communicator ranks, alone(MPI_COMM_SELF);
  Stokes s = liquid(2, 24, 100);
  add_surface(s);
  add_ball(s, 0.1);
  const auto answer = [&](const Communicator& c) {
    const StokesMatrices m = cases::StokesBuilder(s, c).make();
    const Answer a = solve(m, pose(m), c, {.tolerance = 1e-11});
    CHECK(a.report.converged);
    return dense(m, a.u, a.v, {}, c);
  };
  const StokesMatrices m = cases::StokesBuilder(s, alone).make();
  const Eigen::Index n = m.F.global_rows;
  const Eigen::VectorXd one = answer(alone), many = answer(ranks);
  CHECK((one - many).head(n).norm() <= 1e-8 * one.head(n).norm());
}

TEST_CASE("saddle: the viscous part alone") {
  const Communicator ranks;
  const double viscosity = GENERATE(1e-3, 1.0, 1e5);
  Stokes s = liquid(2, 10, viscosity);
  add_surface(s);
  add_ball(s, 0.01);
  const StokesMatrices m = cases::StokesBuilder(s, ranks).make();
  const Problem p = pose(m);
  BodyMatrix H(ranks);
  REQUIRE(H.set(m.H));
  SaddleSolver solver(m.system(), {.tolerance = 1e-11}, ranks);
  Answer a = start(m);
  const SaddleReport report = solver.solve_viscous(H, p.f, p.g, a.u, a.v);
  CHECK(report.converged);
  CHECK(report.iterations <= 25);
  const Eigen::Index n = m.F.global_rows + m.H.rows();
  const Eigen::VectorXd exact =
      DenseLdlt(dense(m, ranks).topLeftCorner(n, n)).solve(dense(m, p.f, p.g, {}, ranks).head(n));
  CHECK((dense(m, a.u, a.v, {}, ranks).head(n) - exact).norm() <= 1e-7 * exact.norm());
}

// Below round-off, the residual of the recurrence converges and the true one does not.
TEST_CASE("saddle: attempts at the viscous part that miss the tolerance without a failure name none") {
  const Communicator ranks;
  const StokesMatrices m = cases::StokesBuilder(liquid(2, 10, 1.0), ranks).make();
  const Problem p = pose(m);
  BodyMatrix H(ranks);
  REQUIRE(H.set(m.H));
  SaddleSolver solver(m.system(), {.tolerance = 1e-18}, ranks);
  Answer a = start(m);
  const SaddleReport report = solver.solve_viscous(H, p.f, p.g, a.u, a.v);
  CHECK_FALSE(report.converged);
  REQUIRE(report.failed_attempts.size() == 2);
  for (const std::string& attempt : report.failed_attempts) {
    INFO(attempt);
    CHECK(attempt.substr(attempt.size() - 10) == "iterations");
  }
}

TEST_CASE("saddle: a solver that is wrong is found out, and the next one asked") {
  const Communicator ranks;
  Stokes s = liquid(2, 16, 10);
  add_ball(s, 0.1);
  const StokesMatrices m = cases::StokesBuilder(s, ranks).make();
  SaddleOptions options;
  options.fail_first = GENERATE(1, 2, 3);
  const Answer a = solve(m, pose(m), ranks, options);
  CHECK(a.report.failed_attempts.size() == std::size_t(options.fail_first));
  CHECK(a.report.converged == (options.fail_first < 3));
  CHECK((a.report.residual <= options.tolerance) == a.report.converged);
}

TEST_CASE("saddle: right sides that are zero, impossible or not finite") {
  const Communicator ranks;
  const StokesMatrices m = cases::StokesBuilder(liquid(2, 12, 10), ranks).make();
  Problem p = pose(m);
  SECTION("zero") {
    std::fill(p.f.begin(), p.f.end(), 0.0);
    const Answer a = solve(m, p, ranks);
    CHECK(a.report.converged);
    CHECK(norm(a.u, ranks) == 0);
  }
  SECTION("a closed box that is to gain volume") {
    std::fill(p.q.begin(), p.q.end(), 1.0);
    const Answer a = solve(m, p, ranks);
    CHECK(a.report.mismatch == Approx(1));
    CHECK(a.report.converged);  // in the compatible part
  }
  SECTION("sources and sinks") {
    for (std::size_t i = 0; i < p.q.size(); ++i) p.q[i] = (m.D.first_row + Row(i)) % 2 ? 1 : -1;
    const Answer a = solve(m, p, ranks);
    CHECK(a.report.mismatch < 1e-12);
    CHECK(a.report.converged);
  }
  SECTION("not a number") {
    if (!p.f.empty()) p.f[0] = NAN;
    const Answer a = solve(m, p, ranks);
    CHECK_FALSE(a.report.converged);
    REQUIRE(a.report.failed_attempts.size() == 1);
    CHECK(a.report.failed_attempts[0] == "the right-hand side is not finite");
  }
}

TEST_CASE("saddle: contact may come and go between solves") {
  const Communicator ranks;
  Stokes s = liquid(2, 24, 10);
  add_ball(s, 0.1);
  const StokesMatrices m = cases::StokesBuilder(s, ranks).make();
  const Problem p = pose(m);
  SaddleSolver solver(m.system(), {}, ranks);
  for (const double stiffness : {0.0, 1e8, 0.0}) {
    SparseMatrix K = m.H;
    K.coeffRef(1, 1) += stiffness;
    BodyMatrix H(ranks);
    REQUIRE(H.set(K));
    Answer a = start(m);
    const SaddleReport report = solver.solve(H, p.f, p.g, p.q, a.u, a.v, a.p);
    CHECK(report.converged);
    CHECK(report.iterations <= 50);
    CHECK((std::abs(a.v[1]) < 1e-6) == (stiffness > 0));
  }
}

}  // namespace saddle_tests
