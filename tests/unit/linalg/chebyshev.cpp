#include <catch2/catch.hpp>

#include "linalg/krylov/krylov.h"
#include "linalg/precond/chebyshev.h"
#include "unit/linalg/cases.h"

namespace chebyshev_tests {
using namespace seiche;
using cases::Kind;

namespace {

// Mass plus viscosity on a box with a hole: 1 + nu (sum of differences).
struct Helmholtz {
  cases::System system;
  LinearSystem F;
  Helmholtz(double viscosity, const Communicator& ranks)
      : system(make(viscosity, ranks)), F(system.A, system.grid, {}, ranks) {}

  static cases::System make(double viscosity, const Communicator& ranks) {
    cases::Poisson box;
    box.size = {9, 8, 11};
    box.kind = [](cases::Cell c) { return c[0] == 4 && c[1] > 2 && c[1] < 6 ? Kind::wall : Kind::liquid; };
    cases::System s = build(box, ranks);
    for (int i = 0; i < s.A.rows(); ++i)
      for (int k = s.A.row_start[i]; k < s.A.row_start[i + 1]; ++k)
        s.A.value[k] = viscosity * s.A.value[k] + (k == s.A.row_start[i] ? 1 : 0);
    return s;
  }
  Vector solved_for(const Vector& b, const Communicator& ranks) const {
    Vector x(b.size(), 0.0);
    const auto none = make_preconditioner("none", F);
    REQUIRE(conjugate_gradients(F, *none.preconditioner, b, x, {1e-13 * norm(b, ranks), 1000}, ranks).failure.empty());
    return x;
  }
};

Vector difference(Vector a, const Vector& b) {
  add_scaled(a, -1, b);
  return a;
}

}  // namespace

TEST_CASE("chebyshev: the interval holds what matters of the spectrum") {
  const Communicator ranks;
  const double viscosity = GENERATE(0.1, 1.0, 10.0);
  const Helmholtz h(viscosity, ranks);
  const SpectralInterval i = estimate_interval(h.F);
  // The constant is an eigenvector of F with eigenvalue 1: 1 over the largest diagonal is a lower bound.
  CHECK(i.low >= 1 / (1 + 6 * viscosity));
  CHECK(i.low <= 1 / (1 + 3 * viscosity));
  CHECK(i.high <= 2);
  CHECK(i.high >= 1);
}

// 0/0 became a number of steps: found by clang's sanitizer in a scene whose liquid is a few cells.
TEST_CASE("chebyshev: without unknowns the interval is a point") {
  const Communicator ranks;
  cases::Poisson box;
  box.size = {3, 3, 3};
  box.kind = [](cases::Cell) { return Kind::wall; };
  const cases::System system = build(box, ranks);
  const SpectralInterval i = estimate_interval(LinearSystem(system.A, system.grid, {}, ranks));
  CHECK(i.condition() == 1);
  CHECK(chebyshev_steps(i, 0.1) == 2);
}

TEST_CASE("chebyshev: symmetric, positive, and leaves the share of an error that it should") {
  const Communicator ranks;
  const Helmholtz h(2, ranks);
  const SpectralInterval i = estimate_interval(h.F);
  const double share = GENERATE(0.5, 0.1, 1e-3);
  Chebyshev B(h.F, i, chebyshev_steps(i, share));
  const Vector b = cases::noise_vector(h.system.A, 1), c = cases::noise_vector(h.system.A, 2);
  Vector Bb(b.size()), Bc(b.size());
  B.apply(b, Bb);
  B.apply(c, Bc);
  CHECK(dot(b, Bc, ranks) == Approx(dot(c, Bb, ranks)).epsilon(1e-12));
  CHECK(dot(b, Bb, ranks) > 0);
  // Error in the norm of F; the lowest eigenvalue lies slightly below the interval.
  const Vector x = h.solved_for(b, ranks), e = difference(x, Bb);
  Vector Fe(e.size());
  h.F.multiply(e, Fe);
  CHECK(dot(e, Fe, ranks) <= std::pow(1.5 * share, 2) * dot(x, b, ranks));
}

TEST_CASE("chebyshev: on the rows that it reaches alone, the same") {
  const Communicator ranks;
  const Helmholtz h(2, ranks);
  const SpectralInterval i = estimate_interval(h.F);
  const int steps = GENERATE(1, 3, 6);
  Vector b(std::size_t(h.F.rows()), 0.0);
  const Row at = h.system.A.global_rows / 2;
  if (at >= h.system.A.first_row && at < h.system.A.first_row + h.F.rows())
    b[std::size_t(at - h.system.A.first_row)] = 1;
  Vector whole(b.size());
  Chebyshev(h.F, i, steps).apply(b, whole);
  const std::vector<SparseVector> local = solve_locally(h.F, i, steps, {b, Vector(b.size(), 0.0)});
  REQUIRE(local.size() == 2);
  Vector z(b.size(), 0.0);
  add_scaled(z, 1, local[0]);
  CHECK(norm(difference(z, whole), ranks) <= 1e-15 * norm(whole, ranks));
  CHECK(local[1].row.empty());
  CHECK(ranks.global_sum(std::int64_t(local[0].row.size())) < h.system.A.global_rows);
}

TEST_CASE("GMRES needs no preconditioned directions where the preconditioner is linear") {
  const Communicator ranks;
  const Helmholtz h(20, ranks);
  const SpectralInterval i = estimate_interval(h.F);
  Chebyshev B(h.F, i, 3);
  const Vector b = cases::noise_vector(h.system.A, 1);
  Vector kept(b.size(), 0.0), summed = kept;
  const KrylovLimits limits{1e-10 * norm(b, ranks), 100};
  const int restart = GENERATE(4, 40);
  const KrylovResult one = gmres(h.F, B, b, kept, limits, ranks, Directions::kept, restart);
  const KrylovResult other = gmres(h.F, B, b, summed, limits, ranks, Directions::summed, restart);
  CHECK(one.failure.empty());
  CHECK(other.failure.empty());
  CHECK(one.iterations == other.iterations);
  CHECK(norm(difference(kept, summed), ranks) <= 1e-12 * norm(kept, ranks));
}

}  // namespace chebyshev_tests
