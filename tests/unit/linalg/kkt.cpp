#include <catch2/catch.hpp>

#include "linalg/core/shared_columns.h"
#include "linalg/kkt/solver.h"
#include "linalg/spd/body_coupling.h"
#include "linalg/spd/solve.h"
#include "unit/linalg/cases.h"

namespace kkt_tests {
using namespace seiche;
using cases::Cell;
using cases::Kind;

namespace {

// An elastic block of cells: masses at the corners, springs along edges and diagonals of each cell.
struct Lattice {
  int dimension, low, cells;  // the block spans cells low <= i < low + cells
  int side() const { return cells + 1; }
  int nodes() const { return dimension == 3 ? side() * side() * side() : side() * side(); }
  bool contains(const Cell& c) const {
    for (int a = 0; a < dimension; ++a)
      if (c[a] < low || c[a] >= low + cells) return false;
    return true;
  }
  int node(const Cell& at) const {
    const int z = dimension == 3 ? at[2] - low : 0;
    return at[0] - low + side() * (at[1] - low + side() * z);
  }
  // Nodes of the box with steps 0 or 1 along the axes of `free`, from `at`.
  std::vector<Cell> corners(Cell at, const std::array<bool, 3>& free) const {
    std::vector<Cell> all{at};
    for (int a = 0; a < dimension; ++a)
      for (std::size_t n = all.size(); free[a] && n-- > 0;) all.push_back(all[n]), ++all.back()[a];
    return all;
  }
  template <class Visit>
  void for_cells(Visit visit) const {
    const int high = low + cells;
    cases::for_cells({low, low, dimension == 3 ? low : 0}, {high, high, dimension == 3 ? high : 1}, visit);
  }
};

// Mass of a cell's share, stiffness dt^2 k of a spring.
SparseMatrix inertia_and_stiffness(const Lattice& l, double mass, double stiffness) {
  std::vector<Eigen::Triplet<double>> entries;
  const int d = l.dimension;
  l.for_cells([&](Cell c) {
    const auto corners = l.corners(c, {true, true, d == 3});
    for (const Cell& x : corners) {
      for (int a = 0; a < d; ++a)
        entries.emplace_back(d * l.node(x) + a, d * l.node(x) + a, mass / double(corners.size()));
      for (const Cell& y : corners) {
        Eigen::VectorXd along(d);
        for (int a = 0; a < d; ++a) along[a] = y[a] - x[a];
        if (along.isZero() || l.node(x) > l.node(y)) continue;
        along.normalize();
        for (int a = 0; a < d; ++a)
          for (int b = 0; b < d; ++b)
            for (const auto& [i, j, sign] : {std::tuple{x, x, 1}, {y, y, 1}, {x, y, -1}, {y, x, -1}})
              entries.emplace_back(d * l.node(i) + a, d * l.node(j) + b, sign * stiffness * along[a] * along[b]);
      }
    }
  });
  SparseMatrix H(d * l.nodes(), d * l.nodes());
  H.setFromTriplets(entries.begin(), entries.end());
  return H;
}

struct Case {
  cases::System liquid;
  BlockColumns J;
  SparseMatrix H;
  Vector b;
  Eigen::VectorXd g;
};

// Net outflow of each liquid cell by the motion of the block's faces, each with the mean of its corners.
ColumnBlock columns(const Lattice& l, const cases::System& s, const cases::Poisson& p) {
  ColumnBlock block;
  const int d = l.dimension;
  block.width = d * l.nodes();
  std::size_t cell = 0;
  cases::for_cells(s.grid.lower, s.grid.upper, [&](Cell c) {
    const int row = s.grid.row_of_cell[cell++];
    if (row < 0) return;
    for (int axis = 0; axis < d; ++axis)
      for (const int step : {-1, 1}) {
        Cell n = c;
        cases::neighbour(p, n, axis, step);
        if (!l.contains(n)) continue;
        Cell at = step < 0 ? c : n;  // lowest corner of the face
        std::array<bool, 3> free{true, true, d == 3};
        free[axis] = false;
        const auto corners = l.corners(at, free);
        for (const Cell& x : corners) block.add(row, d * l.node(x) + axis, double(step) / double(corners.size()));
      }
  });
  block.loads.setZero(block.width, d == 3 ? 6 : 3);
  l.for_cells([&](Cell c) {
    for (const Cell& x : l.corners(c, {true, true, d == 3}))
      for (int a = 0; a < d; ++a) {
        block.loads(d * l.node(x) + a, a) = 1;
        if (d == 2)
          block.loads(2 * l.node(x) + a, 2) = a == 0 ? -x[1] + l.low + 0.5 * l.cells : x[0] - l.low - 0.5 * l.cells;
        if (d == 3) block.loads(3 * l.node(x) + (a + 2) % 3, 3 + a) = x[(a + 1) % 3] - l.low - 0.5 * l.cells;
      }
  });
  return block;
}

Case make(int dimension, int n, double density, double stiffness, Kind top, const Communicator& ranks) {
  const Lattice l{dimension, n / 3, n / 4};
  cases::Poisson p;
  p.dimension = dimension;
  p.size = {n, n, dimension == 3 ? n : 1};
  p.kind = [=](Cell c) { return l.contains(c) ? Kind::wall : c[1] == n - 1 ? top : Kind::liquid; };
  Case k{cases::build(p, ranks), {}, inertia_and_stiffness(l, density, stiffness), {}, {}};
  k.J.blocks.push_back(columns(l, k.liquid, p));
  k.b = cases::noise_vector(k.liquid.A, 3);
  k.g.setZero(k.H.rows());
  for (Eigen::Index i = 0; i < k.g.size(); ++i) k.g[i] = 0.1 * density * (1 + cases::noise(i));
  return k;
}

constexpr double c1 = 2, c2 = 0.5;

struct Found {
  Vector p;
  Eigen::VectorXd v;
  KktReport report;
};

Found solve(const Case& k, int dimension, double tolerance, const Communicator& ranks) {
  KktSolver solver({k.liquid.A, k.liquid.grid, k.liquid.null_space, k.J, c1, c2, dimension}, {.tolerance = tolerance},
                   ranks);
  Found f{Vector(k.b.size(), 0.0), Eigen::VectorXd::Zero(k.H.rows()), {}};
  f.report = solver.solve(k.H, k.b, k.g, f.p, f.v);
  return f;
}

}  // namespace

TEST_CASE("kkt: equal to the bodies factored") {
  const Communicator ranks;
  const int dimension = GENERATE(2, 3);
  const Kind top = GENERATE(Kind::air, Kind::liquid);
  const double density = GENERATE(0.01, 1.0), stiffness = GENERATE(0.01, 1e4);
  CAPTURE(dimension, top == Kind::air, density, stiffness);
  const Case k = make(dimension, dimension == 2 ? 24 : 12, density, stiffness, top, ranks);
  const Found f = solve(k, dimension, 1e-10, ranks);
  CAPTURE(f.report.solve.failed_attempts, f.report.solve.iterations);
  REQUIRE(f.report.solve.converged);
  BodyMatrix H(ranks);
  REQUIRE(H.set(k.H));
  // (A + c1 c2 J H^-1 J') p = b - c1 J H^-1 g
  Vector b = k.b, p(b.size(), 0.0);
  add_multiplied(k.J, -c1 * H.solve(k.g), b);
  SpdSolver spd(k.liquid.A, k.liquid.grid, k.liquid.null_space, k.J, c1 * c2, {.tolerance = 1e-11}, ranks);
  REQUIRE(spd.solve(H, b, p).converged);
  const Eigen::VectorXd v = H.solve(k.g + c2 * multiply_transposed(k.J, p, ranks));
  Vector difference = f.p;
  add_scaled(difference, -1, p);
  CHECK(norm(difference, ranks) <= 1e-6 * norm(p, ranks));
  // The round-off of H v is 1e-16 of the stiffness, which is 1e6 of the inertia.
  CHECK((f.v - v).norm() <= 1e-6 * v.norm());
}

TEST_CASE("kkt: iterations from soft to stiff, light to heavy") {
  const Communicator ranks;
  const double density = GENERATE(0.01, 1.0, 10.0), stiffness = GENERATE(1e-2, 1.0, 1e2, 1e4, 1e6);
  std::vector<int> counts;
  for (const int n : {24, 72}) {
    const Found f = solve(make(2, n, density, stiffness, Kind::air, ranks), 2, 1e-8, ranks);
    CHECK(f.report.solve.converged);
    CHECK(f.report.solve.failed_attempts.empty());
    counts.push_back(f.report.solve.iterations);
  }
  for (const int n : {12, 20}) {
    const Found f = solve(make(3, n, density, stiffness, Kind::air, ranks), 3, 1e-8, ranks);
    CHECK(f.report.solve.converged);
    CHECK(f.report.solve.failed_attempts.empty());
    counts.push_back(f.report.solve.iterations);
  }
  CAPTURE(density, stiffness, counts);
  CHECK(*std::max_element(counts.begin(), counts.end()) <= 50);
}

TEST_CASE("kkt: matrices that are not positive definite are told of") {
  const Communicator ranks;
  Case k = make(2, 12, 1, 1, Kind::air, ranks);
  k.H.coeffRef(2, 3) += 100;
  k.H.coeffRef(3, 2) += 100;
  const Found f = solve(k, 2, 1e-8, ranks);
  CHECK(f.report.indefinite);
  CHECK_FALSE(f.report.solve.converged);
}

// Newton's method asks one solver for several matrices: an exact one that may be indefinite, then a projected one.
TEST_CASE("kkt: a solver serves definite and indefinite matrices by turns") {
  const Communicator ranks;
  const Case k = make(2, 12, 1, 1, Kind::air, ranks);
  SparseMatrix wrong = k.H;
  wrong.coeffRef(2, 3) += 100;
  wrong.coeffRef(3, 2) += 100;
  KktSolver solver({k.liquid.A, k.liquid.grid, k.liquid.null_space, k.J, c1, c2, 2}, {.tolerance = 1e-10}, ranks);
  const Found alone = solve(k, 2, 1e-10, ranks);
  for (const SparseMatrix& H : {wrong, k.H, wrong, k.H}) {
    Found f{Vector(k.b.size(), 0.0), Eigen::VectorXd::Zero(H.rows()), {}};
    f.report = solver.solve(H, k.b, k.g, f.p, f.v);
    CHECK(f.report.indefinite == (H.coeff(2, 3) != k.H.coeff(2, 3)));
    if (f.report.indefinite) continue;
    CHECK(f.report.solve.converged);
    CHECK((f.v - alone.v).norm() <= 1e-8 * alone.v.norm());
  }
}

// On several ranks each holds its own columns only. G needs those two entries away from the surface, so with 13 nodes a
// side some are left out.
TEST_CASE("kkt: a matrix that the ranks share acts as the whole") {
  const Communicator ranks;
  const int dimension = GENERATE(2, 3);
  const Case k = make(dimension, dimension == 2 ? 48 : 24, 0.1, 10, Kind::air, ranks);
  const LinearSystem A(k.liquid.A, k.liquid.grid, k.liquid.null_space, ranks);
  BodyMatrix whole(ranks), shared(ranks);
  REQUIRE(whole.set(k.H));
  shared.keep(k.H);
  CHECK(shared.is_shared_out() == (ranks.size() > 1));
  const IndexRange own = share_of_rank(int(k.H.cols()), ranks);
  CHECK(shared.matrix().nonZeros() == k.H.middleCols(own.begin, own.size()).nonZeros());
  CHECK(shared.diagonal() == whole.diagonal());
  const Eigen::VectorXd product = k.H * k.g;
  CHECK((shared.multiply(k.g) - product).norm() <= 1e-14 * product.norm());
  const BodyCoupling expected = body_coupling(A, k.J, whole, 1), found = body_coupling(A, k.J, shared, 1);
  CHECK(found.rows == expected.rows);
  CHECK(found.matrix.nonZeros() > 0);
  CHECK(SparseMatrix(found.matrix - expected.matrix).norm() == 0);
}

}  // namespace kkt_tests
