#include <catch2/catch.hpp>

#include <memory>

#include "linalg/precond/rigid_motion_deflation.h"
#include "unit/linalg/saddle_cases.h"

namespace stiff_tests {
using namespace seiche;
using cases::Cell;
using cases::Stokes;
using cases::StokesMatrices;

namespace {

// Two squares of 8 x 8 and 4 x 4 cells, 1e5 times as viscous as the box around them.
Stokes two_squares() {
  Stokes s;
  s.box.dimension = 2;
  s.box.size = {32, 32, 1};
  s.body_density = -1;
  s.viscosity = [](Cell c) {
    const bool large = c[0] >= 4 && c[0] < 12 && c[1] >= 12 && c[1] < 20;
    const bool small = c[0] >= 20 && c[0] < 24 && c[1] >= 20 && c[1] < 24;
    return large || small ? 1e5 : 1.0;
  };
  return s;
}

struct Matrices {
  RowGrid no_grid;
  NullSpace none;
  StokesMatrices m;
  LinearSystem F;
  Matrices(const Stokes& s, const Communicator& ranks)
      : m(cases::StokesBuilder(s, ranks).make()), F(m.F, no_grid, none, ranks) {}
  FacePlaces places() const { return {m.axis, m.position}; }
};

class Diagonal : public Preconditioner {
 public:
  explicit Diagonal(const LinearSystem& F) : F_(F) {}
  void apply(const Vector& r, Vector& z) override {
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = 0.5 * r[i] / F_.diagonal(int(i));
  }

 private:
  const LinearSystem& F_;
};

}  // namespace

TEST_CASE("stiff: regions are found whole on any number of ranks") {
  const Communicator ranks;
  const Matrices f(two_squares(), ranks);
  const std::vector<ViscousRegion> regions = find_viscous_regions(f.F, 6, 16);
  REQUIRE(regions.size() == 3);
  CHECK(regions[0].size == f.m.F.global_rows);
  CHECK(regions[1].size == 2 * 9 * 8);  // faces within and around it
  CHECK(regions[2].size == 2 * 5 * 4);
  for (const ViscousRegion& r : regions) CHECK(ranks.global_sum(std::int64_t(r.row.size())) == r.size);
}

TEST_CASE("stiff: what moves and turns at no cost, and no more") {
  const Communicator ranks;
  const Matrices f(two_squares(), ranks);
  const std::vector<NearNullVector> motions = find_near_null_space(f.F, f.places(), 2);
  REQUIRE(motions.size() == 9);  // includes those of the box, soft relative to the squares' diagonals
  for (const NearNullVector& m : motions) CHECK(m.whole);
}

TEST_CASE("stiff: products of few entries") {
  const Communicator ranks;
  const Matrices f(two_squares(), ranks);
  SparseProduct multiply(f.F);
  for (const Row at : {Row(7), Row(900), f.m.F.global_rows / 2, f.m.F.global_rows - 1}) {
    Vector x(std::size_t(f.F.rows()), 0.0), Fx(x.size()), y(x.size(), 0.0);
    if (at >= f.m.F.first_row && at < f.m.F.first_row + f.F.rows()) x[std::size_t(at - f.m.F.first_row)] = 3;
    f.F.multiply(x, Fx);
    add_scaled(y, 1, multiply(nonzeros(x)));
    CHECK(y == Fx);
  }
}

TEST_CASE("stiff: motions are solved for exactly, by a symmetric and positive operator") {
  const Communicator ranks;
  const Matrices f(two_squares(), ranks);
  RigidMotionDeflation B(f.F, f.places(), 2, std::make_unique<Diagonal>(f.F));
  REQUIRE(B.motions().size() == 9);
  const Vector a = cases::noise_vector(f.m.F, 1), b = cases::noise_vector(f.m.F, 2);
  Vector Ba(a.size()), Bb(a.size()), rest(a.size());
  B.apply(a, Ba), B.apply(b, Bb);
  const double ab = dot(a, Bb, ranks), aa = dot(a, Ba, ranks);
  CHECK(aa > 0);
  CHECK(std::abs(ab - dot(b, Ba, ranks)) <= 1e-10 * std::sqrt(aa * dot(b, Bb, ranks)));
  f.F.residual(a, Ba, rest);
  for (const NearNullVector& m : B.motions()) {
    const double left = ranks.global_sum(local_dot(m.z, rest)), before = ranks.global_sum(local_dot(m.z, a));
    CHECK(std::abs(left) <= 1e-6 * (1 + std::abs(before)));  // round-off times the viscosity ratio
  }
}

}  // namespace stiff_tests
