#include <catch2/catch.hpp>

#include "linalg/core/dense_factors.h"
#include "linalg/core/symmetric_eigen.h"
#include "linalg/saddle/lsc_preconditioner.h"
#include "linalg/saddle/wall_distance.h"
#include "unit/linalg/saddle_cases.h"

namespace lsc_preconditioner_tests {
using namespace seiche;
using cases::Cell;
using cases::Kind;
using cases::Stokes;
using cases::StokesMatrices;

namespace {

// A square `jump` times as viscous as the rest of the box, below air if `surface`.
Stokes square(int n, double viscosity, double jump, bool surface) {
  Stokes s;
  s.box.dimension = 2;
  s.box.size = {n, n, 1};
  s.body_density = -1;
  s.viscosity = [=](Cell c) {
    return viscosity * (std::max(std::abs(2 * c[0] - n), std::abs(2 * c[1] - n)) < n / 3 ? jump : 1);
  };
  if (surface) s.box.kind = [=](Cell c) { return c[1] > n * 3 / 4 + (c[0] > n / 2) ? Kind::air : Kind::liquid; };
  return s;
}

std::vector<char> without_pressure(const StokesMatrices& m) {
  std::vector<char> pressure_free(std::size_t(m.Dt.rows()));
  for (std::size_t i = 0; i < pressure_free.size(); ++i) pressure_free[i] = m.Dt.row_start[i] == m.Dt.row_start[i + 1];
  return pressure_free;
}

struct Parts {
  StokesMatrices m;
  SaddleSystem system;
  SaddleOperator K;
  PressureFreeRows pressure_free;
  LscPreconditioner B;
  Parts(const Stokes& s, const Communicator& ranks)
      : m(cases::StokesBuilder(s, ranks).make()),
        system(m.system()),
        K(system, ranks),
        pressure_free(K.faces(), without_pressure(m)),
        B(K, &pressure_free, [] {
          AmgSettings settings;
          settings.aggressive_levels = 0;
          return settings;
        }()) {}
};

Eigen::MatrixXd dense(const DistributedMatrix& A, Eigen::Index columns) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(A.rows(), columns);
  for (int i = 0; i < A.rows(); ++i)
    for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k) M(i, A.column[k]) += A.value[k];
  return M;
}

// Eigenvalues of B S without those of the null space, ascending. One rank.
Eigen::VectorXd spectrum(const Stokes& s, bool surface) {
  const Communicator alone(MPI_COMM_SELF);
  Parts p(s, alone);
  const Eigen::MatrixXd D = dense(p.m.D, p.m.F.global_rows), F = dense(p.m.F, p.m.F.global_rows);
  const Eigen::MatrixXd S = D * DenseLdlt(F).solve_columns(D.transpose());
  Eigen::MatrixXd B(S.rows(), S.cols());
  for (Eigen::Index k = 0; k < S.cols(); ++k) {
    Vector e(std::size_t(S.rows()), 0.0), z;
    e[std::size_t(k)] = 1;
    p.B.apply(e, z);
    B.col(k) = Eigen::Map<const Eigen::VectorXd>(z.data(), S.rows());
  }
  CHECK((B - B.transpose()).norm() <= 1e-10 * B.norm());
  const SymmetricEigen modes = symmetric_eigen(0.5 * (B + B.transpose()));
  const Eigen::MatrixXd root = modes.vectors * modes.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  const Eigen::VectorXd all = symmetric_eigenvalues(root.transpose() * S * root);
  return surface ? all : all.tail(all.size() - 1);
}

}  // namespace

TEST_CASE("LSC preconditioner: near the inverse of the Schur complement, whatever the jump") {
  const double viscosity = GENERATE(1.0, 1e4), jump = GENERATE(1e-5, 1.0, 1e5);
  const bool surface = GENERATE(false, true);
  const Eigen::VectorXd eigenvalues = spectrum(square(18, viscosity, jump, surface), surface);
  CAPTURE(viscosity, jump, surface);
  // With exact L^-1 no eigenvalue is below 1 (Cauchy-Schwarz); a cycle leaves up to a quarter of an error, and enters
  // twice. The upper end is due to the LSC preconditioner: largest for a high-viscosity square in a box (7.2; 1.0
  // to 1.9 without a jump).
  CHECK(eigenvalues.minCoeff() >= 0.5);
  CHECK(eigenvalues.maxCoeff() <= 8);
}

TEST_CASE("LSC preconditioner: rows are counted from the walls") {
  const Communicator ranks;
  const Parts p(square(12, 10, 1, false), ranks);
  const std::vector<int> rows = rows_from_walls(p.K.faces(), p.m.axis, p.m.mass, 4);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double wall = 12;  // distance in cells
    for (const auto a : {0u, 1u}) wall = std::min({wall, p.m.position[i][a], 12 - p.m.position[i][a]});
    CHECK(rows[i] == std::min(4, int(std::ceil(wall))));
  }
}

TEST_CASE("loose faces: solved for exactly wherever ranks cut") {
  const Communicator ranks;
  const Parts p(square(24, 100, 1e3, true), ranks);
  REQUIRE(p.pressure_free.good());
  const std::vector<char> pressure_free = without_pressure(p.m);
  const Vector r = cases::noise_vector(p.m.F, 1);
  Vector z(r.size(), 0.0), rest(r.size());
  p.pressure_free.add_solved(r, z);
  p.K.faces().residual(r, z, rest);
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (pressure_free[i]) CHECK(std::abs(rest[i]) <= 1e-10);  // round-off times the viscosity
    if (!pressure_free[i]) CHECK(z[i] == 0);
  }
}

}  // namespace lsc_preconditioner_tests
