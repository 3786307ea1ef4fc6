#include "unit/linalg/saddle_problems.h"

namespace saddle_counts_tests {
using namespace seiche;
using namespace seiche::cases;

namespace {

int iterations(const Stokes& s) {
  const Communicator ranks;
  const StokesMatrices m = cases::StokesBuilder(s, ranks).make();
  const Problem p = pose(m);
  const Answer a = solve(m, p, ranks);
  CAPTURE(s.box.size, a.report.used, a.report.failed_attempts);
  CHECK(a.report.converged);
  CHECK(a.report.failed_attempts.empty());
  CHECK(a.report.residual <= 1e-8);
  return a.report.iterations;
}

// A viscous thread in air, six cells across and `length` cells long, hanging from the box's side; ranks cut it across.
Stokes thread(int length, double viscosity) {
  Stokes s = liquid(3, length, viscosity);
  s.box.size = {10, 10, length};
  s.box.kind = [](Cell c) { return std::hypot(c[0] - 4.5, c[1] - 4.5) < 3.2 && c[2] > 2 ? Kind::liquid : Kind::air; };
  return s;
}

// The same thread horizontally: ranks cut it lengthwise, and its pressure-free faces in chains.
Stokes thread_across(int length, double viscosity) {
  Stokes s = liquid(3, length, viscosity);
  s.box.size = {length, 10, 10};
  s.box.kind = [](Cell c) { return std::hypot(c[1] - 4.5, c[2] - 4.5) < 3.2 && c[0] > 2 ? Kind::liquid : Kind::air; };
  return s;
}

// Iterations at each size are bounded and do not grow, on any number of ranks.
void check_flat(const std::function<Stokes(int)>& make, const std::vector<int>& sizes, int most) {
  constexpr int scatter = 5;
  std::vector<int> counts;
  for (const int n : sizes) counts.push_back(iterations(make(n)));
  CAPTURE(counts);
  CHECK(*std::max_element(counts.begin(), counts.end()) <= most);
  CHECK(counts.back() <= counts.front() + scatter);
}

}  // namespace

TEST_CASE("saddle: iterations stay where they are on finer grids", "[long]") {
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

TEST_CASE("saddle: iterations in 3D", "[long]") {
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

}  // namespace saddle_counts_tests
