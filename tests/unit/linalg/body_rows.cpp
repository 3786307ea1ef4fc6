// Deformable bodies in the solve for pressure: preconditioners on the grid's stencil against algebraic multigrid.
#include <catch2/catch.hpp>

#include "linalg/krylov/krylov.h"
#include "linalg/spd/body_rows.h"
#include "linalg/spd/solve.h"
#include "unit/linalg/cases.h"

namespace body_rows_tests {
using namespace seiche;
using cases::Cell;
using cases::Kind;

namespace {

// A block of side n/3 in liquid in a box of n cells a side. Each of the block's faces is a degree of freedom, its
// normal velocity; springs join faces that share an edge.
struct SoftBlock {
  int n;
  cases::Poisson poisson;
  cases::System system;
  BlockColumns J;
  SparseMatrix H;

  SoftBlock(int cells, Kind top, double mass, double stiffness, const Communicator& ranks) : n(cells) {
    poisson.size = {n, n, n};
    poisson.kind = [this](Cell c) { return within(c) ? Kind::wall : Kind::liquid; };
    poisson.outside = top;
    system = cases::build(poisson, ranks);
    couple(mass, stiffness);
  }

  bool within(const Cell& c) const {
    return std::all_of(c.begin(), c.end(), [this](int i) { return i >= n / 3 && i < 2 * n / 3; });
  }

 private:
  struct Face {
    Cell outside;
    int axis, sign;  // the normal out of the block
  };
  std::vector<Face> faces() const {
    std::vector<Face> list;
    cases::for_cells({0, 0, 0}, poisson.size, [&](Cell c) {
      for (int a = 0; a < 3 && !within(c); ++a)
        for (const int step : {-1, 1}) {
          Cell next = c;
          next[std::size_t(a)] += step;
          if (within(next)) list.push_back({c, a, -step});
        }
    });
    return list;
  }
  static bool joined(const Face& f, const Face& g) {
    int distance = 0;
    for (std::size_t a = 0; a < 3; ++a) distance += std::abs(f.outside[a] - g.outside[a]);
    return distance == (f.axis == g.axis ? 1 : 2);
  }

  void couple(double mass, double stiffness) {
    const std::vector<Face> list = faces();
    const auto size = Eigen::Index(list.size());
    ColumnBlock block;
    block.width = int(size);
    block.loads = Eigen::MatrixXd::Zero(size, 3);
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index i = 0; i < size; ++i) {
      const Face& f = list[std::size_t(i)];
      add_flux(f, int(i), block);
      block.loads(i, f.axis) = f.sign;
      entries.emplace_back(i, i, mass);
      for (Eigen::Index j = 0; j < size; ++j)
        if (i != j && joined(f, list[std::size_t(j)])) {
          entries.emplace_back(i, i, stiffness);
          entries.emplace_back(i, j, -stiffness * f.sign * list[std::size_t(j)].sign);
        }
    }
    J.blocks.push_back(std::move(block));
    H.resize(size, size);
    H.setFromTriplets(entries.begin(), entries.end());
  }

  // Faces are listed in the order of the rows that they touch.
  void add_flux(const Face& f, int column, ColumnBlock& block) const {
    const RowGrid& grid = system.grid;
    const Cell& c = f.outside;
    if (c[2] < grid.lower[2] || c[2] >= grid.upper[2]) return;
    const int row = grid.row_of_cell[std::size_t(c[0] + n * (c[1] + n * (c[2] - grid.lower[2])))];
    block.add(row, column, -1);
  }
};

Vector random_vector(const cases::System& s, int seed) {
  return cases::noise_vector(s.A, seed);
}

double difference(const Vector& x, const Vector& y, const Communicator& ranks) {
  Vector d = x;
  add_scaled(d, -1, y);
  return norm(d, ranks) / norm(x, ranks);
}

struct Solved {
  Vector x;
  SolveReport report;
};

Solved solve(const SoftBlock& s, const std::string& preconditioner, const Communicator& ranks) {
  SpdSolver solver(s.system.A, s.system.grid, s.system.null_space, s.J, 1, {.preconditioner = preconditioner}, ranks);
  BodyMatrix H(ranks);
  REQUIRE(H.set(s.H));
  const Vector b = random_vector(s.system, 3);
  Solved r{Vector(b.size(), 0.0), {}};
  r.report = solver.solve(H, b, r.x);
  return r;
}

}  // namespace

// Iterations are those measured, 6 to 14, plus two.
TEST_CASE("multigrid on the stencil solves liquid with deformable bodies of any stiffness and mass") {
  const Communicator ranks;
  const Kind top = GENERATE(Kind::air, Kind::wall);
  const double mass = GENERATE(1e-2, 1.0, 1e2), stiffness = GENERATE(0.0, 1.0, 1e3, 1e6);
  const SoftBlock s(18, top, mass, stiffness, ranks);
  const Solved algebraic = solve(s, "boomeramg", ranks), geometric = solve(s, "geometric", ranks);
  CAPTURE(int(top), mass, stiffness, algebraic.report.iterations, geometric.report.iterations);
  CHECK(geometric.report.converged);
  CHECK(geometric.report.failed_attempts.empty());
  CHECK(geometric.report.used == "geometric");
  CHECK(geometric.report.iterations <= 16);
  // Both have residuals of 1e-8; the softest mode of this box amplifies them a thousand times.
  CHECK(difference(algebraic.x, geometric.x, ranks) < 1e-5);
}

TEST_CASE("elimination of the rows of bodies is symmetric and positive, and exact in those rows") {
  const Communicator ranks;
  const SoftBlock s(12, Kind::air, 0.1, 10, ranks);
  const LinearSystem A(s.system.A, s.system.grid, s.system.null_space, ranks);
  BodyMatrix H(ranks);
  H.keep(s.H);
  const BodyCoupling C = body_coupling(A, s.J, H, 1);
  const auto made = eliminate_body_rows(A, C, make_preconditioner("none", A).preconditioner);
  REQUIRE(made.preconditioner);
  const Vector x = random_vector(s.system, 1), y = random_vector(s.system, 2);
  Vector Px(x.size()), Py(x.size());
  made.preconditioner->apply(x, Px);
  made.preconditioner->apply(y, Py);
  CHECK(dot(Px, y, ranks) == Approx(dot(x, Py, ranks)).epsilon(1e-12));
  CHECK(dot(Px, x, ranks) > 0);
  // (A + C) P x = x in the rows of C, whatever the inner solve.
  const DistributedMatrix filled = add_body_coupling(A, C);
  const LinearSystem S(filled, s.system.grid, s.system.null_space, ranks);
  Vector SPx(x.size());
  S.multiply(Px, SPx);
  double worst = 0;
  for (int i = 0; i < A.rows(); ++i)
    if (index_of(C.rows, s.system.A.first_row + i) >= 0)
      worst = std::max(worst, std::abs(SPx[std::size_t(i)] - x[std::size_t(i)]));
  CHECK(ranks.global_max(worst) < 1e-11);
}

}  // namespace body_rows_tests
