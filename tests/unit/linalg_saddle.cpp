#include <catch2/catch.hpp>

#include <Eigen/QR>

#include "linalg_saddle_cases.h"

using namespace seiche;
using cases::Cell;
using cases::Kind;
using cases::Stokes;
using cases::StokesMatrices;

namespace {

double distance_squared(const Stokes& s, const Cell& c, std::array<double, 3> centre) {
  double sum = 0;
  for (int a = 0; a < s.box.dimension; ++a) sum += std::pow(c[a] + 0.5 - centre[a] * s.box.size[a], 2);
  return sum;
}

Stokes liquid(int dimension, int n, double viscosity) {
  Stokes s;
  s.box.dimension = dimension;
  s.box.size = {n, n, dimension == 3 ? n : 1};
  s.viscosity = [viscosity](Cell) { return viscosity; };
  s.body_density = -1;
  return s;
}

// A ball `jump` times as viscous as the rest.
void add_inclusion(Stokes& s, double viscosity, double jump) {
  const Stokes box = s;
  s.viscosity = [=](Cell c) {
    return viscosity * (distance_squared(box, c, {0.7, 0.3, 0.5}) < std::pow(0.2 * box.box.size[0], 2) ? jump : 1);
  };
}

void add_ball(Stokes& s, double density, double radius = 0.15) {
  const Stokes box = s;
  s.body_density = density;
  s.body = [=](Cell c) { return distance_squared(box, c, {0.45, 0.4, 0.5}) < std::pow(radius * box.box.size[0], 2); };
  for (int a = 0; a < 3; ++a) s.centre[a] = std::array{0.45, 0.4, 0.5}[a] * s.box.size[a];
  s.box.kind = [body = s.body, kind = s.box.kind](Cell c) { return body(c) ? Kind::wall : kind(c); };
}

// A wavy one, across the second axis.
void add_surface(Stokes& s) {
  s.box.kind = [n = s.box.size[0], kind = s.box.kind](Cell c) {
    return c[1] + 0.5 > 0.7 * n + 0.1 * n * std::sin(6.0 * c[0] / n) ? Kind::air : kind(c);
  };
}

struct Problem {
  Vector f, q;
  Eigen::VectorXd g;
};

// Forces that would give the faces velocities of the order of one, rough and smooth; and pushes on the body.
Problem pose(const StokesMatrices& m) {
  Problem p{Vector(m.mass), Vector(m.schur_mass.size(), 0.0), Eigen::VectorXd::Zero(m.H.rows())};
  for (std::size_t i = 0; i < p.f.size(); ++i)
    p.f[i] *= cases::noise(m.F.first_row + Row(i)) + std::sin(0.001 * double(m.F.first_row + Row(i)));
  for (Eigen::Index k = 0; k < p.g.size(); ++k) p.g[k] = 1 + 0.5 * double(k);
  return p;
}

struct Answer {
  Vector u, p;
  Eigen::VectorXd v;
  SaddleReport report;
};

Answer start(const StokesMatrices& m) {
  return {Vector(m.mass.size(), 0.0), Vector(m.schur_mass.size(), 0.0), Eigen::VectorXd::Zero(m.H.rows()), {}};
}

Answer solve(const StokesMatrices& m, const Problem& p, const Communicator& ranks, const SaddleOptions& options = {}) {
  BodyMatrix H(ranks);
  REQUIRE(H.set(m.H));
  SaddleSolver solver(m.system(), options, ranks);
  Answer a = start(m);
  a.report = solver.solve(H, p.f, p.g, p.q, a.u, a.v, a.p);
  return a;
}

// The same on every rank.
Vector gathered(const Vector& own, Row first, Row total, const Communicator& ranks) {
  Vector all(std::size_t(total), 0.0);
  std::copy(own.begin(), own.end(), all.begin() + first);
  ranks.global_sum(all);
  return all;
}

// The whole matrix, entry by entry: no code of src/linalg.
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

// Against a dense factorisation; pressures up to what no velocity feels.
void check_against_dense(const Stokes& s) {
  const Communicator ranks;
  const StokesMatrices m = cases::StokesBuilder(s, ranks).make();
  const Problem p = pose(m);
  const Answer a = solve(m, p, ranks, {.tolerance = 1e-11});
  CAPTURE(a.report.ladder, a.report.momentum, a.report.continuity);
  CHECK(a.report.converged);
  const Eigen::MatrixXd K = dense(m, ranks);
  CHECK((K - K.transpose()).norm() <= 1e-13 * K.norm());
  const Eigen::VectorXd b = dense(m, p.f, p.g, p.q, ranks), x = dense(m, a.u, a.v, a.p, ranks);
  const Eigen::VectorXd exact = K.completeOrthogonalDecomposition().solve(b);
  const Eigen::Index n = m.F.global_rows + m.H.rows();
  // 1e-11 of the residual, times the condition of velocities against forces.
  CHECK((x - exact).head(n).norm() <= 1e-7 * exact.head(n).norm());
  CHECK((K * x - b).norm() <= 1e-8 * b.norm());
}

int iterations(const Stokes& s) {
  const Communicator ranks;
  const StokesMatrices m = cases::StokesBuilder(s, ranks).make();
  const Problem p = pose(m);
  const Answer a = solve(m, p, ranks);
  CAPTURE(s.box.size, a.report.used, a.report.ladder);
  CHECK(a.report.converged);
  CHECK(a.report.ladder.empty());
  CHECK(a.report.residual <= 1e-8);
  return a.report.iterations;
}

// A thread in air, six cells across and so long, that hangs from the box's side; ranks cut it across.
Stokes thread(int length, double viscosity) {
  Stokes s = liquid(3, length, viscosity);
  s.box.size = {10, 10, length};
  s.box.kind = [](Cell c) { return std::hypot(c[0] - 4.5, c[1] - 4.5) < 3.2 && c[2] > 2 ? Kind::liquid : Kind::air; };
  return s;
}

// The same lying down: ranks cut it lengthwise, and its loose faces in chains.
Stokes thread_across(int length, double viscosity) {
  Stokes s = liquid(3, length, viscosity);
  s.box.size = {length, 10, 10};
  s.box.kind = [](Cell c) { return std::hypot(c[1] - 4.5, c[2] - 4.5) < 3.2 && c[0] > 2 ? Kind::liquid : Kind::air; };
  return s;
}

// The iterations at each size: at most so many, and not growing; on any number of ranks.
void check_flat(const std::function<Stokes(int)>& make, const std::vector<int>& sizes, int most) {
  constexpr int scatter = 5;
  std::vector<int> counts;
  for (const int n : sizes) counts.push_back(iterations(make(n)));
  CAPTURE(counts);
  CHECK(*std::max_element(counts.begin(), counts.end()) <= most);
  CHECK(counts.back() <= counts.front() + scatter);
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

TEST_CASE("saddle: iterations stay where they are on finer grids") {
  const double viscosity = GENERATE(1e-3, 0.1, 1.0, 10.0, 1e3, 1e5);
  CAPTURE(viscosity);
  SECTION("full stress") {
    check_flat([&](int n) { return liquid(2, n, viscosity); }, {32, 64}, 40);
  }
  SECTION("component Laplacian") {
    const auto make = [&](int n) {
      Stokes s = liquid(2, n, viscosity);
      s.kappa = 0;
      return s;
    };
    check_flat(make, {32, 64}, 45);
  }
  SECTION("a body, massless to heavy") {
    const double density = GENERATE(0.0, 1.0, 1000.0);
    const auto make = [&](int n) {
      Stokes s = liquid(2, n, viscosity);
      add_ball(s, density);
      return s;
    };
    check_flat(make, {32, 64}, 45);
  }
  SECTION("a free surface, whose faces in air have next to no mass") {
    const auto make = [&](int n) {
      Stokes s = liquid(2, n, viscosity);
      add_surface(s);
      return s;
    };
    check_flat(make, {32, 64}, 45);
  }
  SECTION("an inclusion 1e5 times as viscous, or 1e-5, in a box or below a surface") {
    const double jump = GENERATE(1e5, 1e-5);
    const bool surface = GENERATE(false, true);
    const auto make = [&](int n) {
      Stokes s = liquid(2, n, viscosity);
      if (surface) add_surface(s);
      add_inclusion(s, viscosity, jump);
      return s;
    };
    CAPTURE(jump, surface);
    check_flat(make, {32, 64}, 40);
  }
  SECTION("an inclusion, a surface and a body that touches the inclusion") {
    const auto make = [&](int n) {
      Stokes s = liquid(2, n, viscosity);
      add_surface(s);
      add_inclusion(s, viscosity, 1e5);
      add_ball(s, 0.01);
      return s;
    };
    check_flat(make, {32, 64}, 45);
  }
}

TEST_CASE("saddle: iterations in 3D") {
  const double viscosity = GENERATE(1e-3, 1.0, 1e5);
  CAPTURE(viscosity);
  SECTION("a light ball") {
    const auto make = [&](int n) {
      Stokes s = liquid(3, n, viscosity);
      add_ball(s, 0.01);
      return s;
    };
    check_flat(make, {12, 20}, 30);
  }
  SECTION("an inclusion 1e5 times as viscous, with and without a ball that touches it") {
    const double density = GENERATE(-1.0, 1.0);
    const auto make = [&](int n) {
      Stokes s = liquid(3, n, viscosity);
      add_inclusion(s, viscosity, 1e5);
      if (density > 0) add_ball(s, density);
      return s;
    };
    CAPTURE(density);
    check_flat(make, {12, 20}, 45);
  }
  SECTION("an inclusion 1e-5 times as viscous below a surface") {
    const auto make = [&](int n) {
      Stokes s = liquid(3, n, viscosity);
      add_surface(s);
      add_inclusion(s, viscosity, 1e-5);
      return s;
    };
    check_flat(make, {16, 24}, 25);
  }
}

TEST_CASE("saddle: iterations of a thread do not grow with its length") {
  SECTION("cut across") {
    check_flat([](int length) { return thread(length, 300); }, {16, 32, 64}, 40);
  }
  SECTION("cut lengthwise") {
    check_flat([](int length) { return thread_across(length, 300); }, {16, 32, 64}, 40);
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
  const Eigen::VectorXd exact = dense(m, ranks).topLeftCorner(n, n).ldlt().solve(dense(m, p.f, p.g, {}, ranks).head(n));
  CHECK((dense(m, a.u, a.v, {}, ranks).head(n) - exact).norm() <= 1e-7 * exact.norm());
}

TEST_CASE("saddle: a solver that is wrong is found out, and the next one asked") {
  const Communicator ranks;
  Stokes s = liquid(2, 16, 10);
  add_ball(s, 0.1);
  const StokesMatrices m = cases::StokesBuilder(s, ranks).make();
  SaddleOptions options;
  options.fail_rungs = GENERATE(1, 2, 3);
  const Answer a = solve(m, pose(m), ranks, options);
  CHECK(a.report.ladder.size() == std::size_t(options.fail_rungs));
  CHECK(a.report.converged == (options.fail_rungs < 3));
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
    CHECK(a.report.converged);  // of what is possible
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
    REQUIRE(a.report.ladder.size() == 1);
    CHECK(a.report.ladder[0] == "the right-hand side is not finite");
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
