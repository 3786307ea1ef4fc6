// Viscosities by shear rate, and shear rates on the grid, against known values.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/fluid_spec.h"
#include "fluid/rheology/rheology.h"
#include "grid/loops.h"

namespace rheology_tests {
using namespace seiche;

namespace {

RheologySpec bingham(double viscosity, double yield_stress, double m) {
  RheologySpec s;
  s.model = "bingham";
  s.viscosity = viscosity;
  s.yield_stress = yield_stress;
  s.regularisation = m;
  return s;
}

RheologySpec power_law(const std::string& model, double consistency, double exponent, double yield_stress, double m) {
  RheologySpec s;
  s.model = model;
  s.consistency = consistency;
  s.exponent = exponent;
  s.yield_stress = yield_stress;
  s.regularisation = m;
  return s;
}

RheologySpec carreau(double zero, double infinity, double time, double exponent) {
  RheologySpec s;
  s.model = "carreau";
  s.viscosity_zero = zero;
  s.viscosity_infinity = infinity;
  s.time = time;
  s.exponent = exponent;
  return s;
}

const std::vector<RheologySpec> liquids{bingham(2, 3, 1e-3), power_law("herschel_bulkley", 2, 0.5, 3, 1e-3),
                                        power_law("power_law", 2, 0.3, 0, 1e-3),
                                        power_law("power_law", 2, 1.7, 0, 1e-3), carreau(5, 0.1, 0.7, 0.4)};

// A grid with h = 1/8 on one rank and a linear velocity: u_a = sum_b gradient(a, b) x_b.
template <int Dim>
struct Sheared {
  Communicator ranks;
  Layout<Dim> layout;
  Halo<Dim> halo;
  FaceField<Dim> u;

  Sheared(const Eigen::Matrix<double, Dim, Dim>& gradient, bool periodic)
      : layout(geometry(periodic), geometry(periodic).box(), 4), halo(layout, {layout.cells()}, ranks), u(layout) {
    for (int a = 0; a < Dim; ++a)
      for_each_index(layout, layout.padded(), [&](Site f, const IVec<Dim>& i) {
        u.at(a, f) = (gradient * layout.position(i, face_offset<Dim>(a)))[a];
      });
  }
  static Geometry<Dim> geometry(bool periodic) {
    Geometry<Dim> g;
    g.h = 0.125;
    g.cells = IVec<Dim>::Constant(8);
    g.periodic.fill(periodic);
    return g;
  }
  // Largest and smallest viscosity.
  std::pair<double, double> range(const RheologySpec& spec) const {
    CellField<Dim> mu(layout);
    set_viscosity(layout, halo, spec, u, mu);
    const double most = local_max(layout, layout.padded(), 0.0, [&](Site c) { return mu[c]; });
    return {most, -local_max(layout, layout.padded(), -1e300, [&](Site c) { return -mu[c]; })};
  }
};

template <int Dim>
void check_linear_flow() {
  const auto G = Eigen::Matrix<double, Dim, Dim>(
      Eigen::Matrix3d{{0.3, 1.7, -0.4}, {0.2, -0.1, 0.9}, {2, 0.5, -0.2}}.topLeftCorner(Dim, Dim));
  const auto D = ((G + G.transpose()) / 2).eval();
  const double rate = std::sqrt(2 * D.squaredNorm());
  for (const RheologySpec& spec : liquids) {
    const auto [most, least] = Sheared<Dim>(G, false).range(spec);
    CHECK(most == Approx(viscosity(spec, rate)).epsilon(1e-12));  // round-off: the flow is linear
    CHECK(least == Approx(viscosity(spec, rate)).epsilon(1e-12));
  }
}

}  // namespace

TEST_CASE("viscosities are those of the formulas") {
  CHECK(viscosity(bingham(2, 3, 1e-3), 0.5) == Approx(2 + 3 / 0.5).epsilon(1e-12));
  CHECK(viscosity(bingham(2, 3, 0.1), 0.1) == Approx(2 + 3 * (1 - std::exp(-1.0)) / 0.1).epsilon(1e-14));
  CHECK(viscosity(power_law("herschel_bulkley", 2, 0.5, 3, 1e-9), 4) == Approx(2 / 2.0 + 3 / 4.0).epsilon(1e-12));
  CHECK(viscosity(power_law("power_law", 2, 3, 0, 1e-9), 4) == Approx(2 * 16).epsilon(1e-12));
  CHECK(viscosity(power_law("power_law", 2, 0.5, 0, 3), 4) == Approx(2 / std::sqrt(5.0)).epsilon(1e-14));
  CHECK(viscosity(carreau(5, 1, 2, 0.5), 3) == Approx(1 + 4 * std::pow(37, -0.25)).epsilon(1e-14));
}

TEST_CASE("viscosities are finite at rest and at any shear rate, and stress grows with the shear rate") {
  for (const RheologySpec& spec : liquids) {
    INFO(spec.model);
    double before = 0;
    CHECK(std::isfinite(viscosity(spec, 0)));
    CHECK(viscosity(spec, 1e-300) == Approx(viscosity(spec, 0)));
    for (double rate = 1e-9; rate < 1e12; rate *= 1.5) {
      const double stress = viscosity(spec, rate) * rate;
      CHECK(std::isfinite(stress));
      CHECK(stress > before);
      before = stress;
    }
  }
  CHECK(viscosity(bingham(2, 3, 1e-3), 0) == Approx(2 + 3e3));
}

TEST_CASE("viscosity falls with the shear rate where liquid yields or thins") {
  for (const RheologySpec& spec : liquids) {
    if (spec.exponent > 1) continue;
    double before = viscosity(spec, 0) * (1 + 1e-14);  // round-off
    for (double rate = 1e-9; rate < 1e12; rate *= 1.5) {
      CHECK(viscosity(spec, rate) <= before);
      before = viscosity(spec, rate) * (1 + 1e-14);
    }
  }
}

TEST_CASE("without what makes them special all rheologies are Newtonian") {
  for (const double rate : {0.0, 1e-6, 1e-3, 1.0, 1e6}) {
    for (const RheologySpec& spec :
         {bingham(2, 0, 1e-3), power_law("power_law", 2, 1, 0, 1e-3), power_law("herschel_bulkley", 2, 1, 0, 1e-3),
          carreau(2, 2, 1, 0.3), carreau(2, 0, 1, 1)})
      CHECK(viscosity(spec, rate) == Approx(2).epsilon(1e-14));
    CHECK(viscosity(power_law("herschel_bulkley", 2, 1, 3, 0.1), rate) == Approx(viscosity(bingham(2, 3, 0.1), rate)));
  }
}

TEST_CASE("the yield stress is reached as the regularisation goes to zero") {
  double before = 1;
  for (const double m : {0.3, 0.1, 0.03, 0.01}) {
    const double missing = 1 - (viscosity(bingham(2, 3, m), 0.1) - 2) * 0.1 / 3;
    CHECK(missing == Approx(std::exp(-0.1 / m)).margin(1e-14));
    CHECK(missing < before);
    before = missing;
  }
}

TEST_CASE("a rheology that is none is refused with those there are") {
  CHECK_THROWS_WITH(rheology_model("bingam"),
                    "no rheology \"bingam\"; there are bingham, herschel_bulkley, carreau, power_law");
}

TEST_CASE("the shear rate of a linear flow is exact in every cell, next to sides too") {
  check_linear_flow<2>();
  check_linear_flow<3>();
}

// rate = |cos(2 pi y)| 2 pi at cell centres; second order where it is nonzero.
TEST_CASE("the shear rate of a wave is second order in space") {
  double before = 0;
  for (const int n : {16, 32, 64}) {
    Geometry<2> g;
    g.h = 1.0 / n;
    g.cells = {n, n};
    g.periodic = {true, true};
    const Layout<2> layout(g, g.box(), 3);
    const Halo<2> halo(layout, {layout.cells()}, Communicator());
    FaceField<2> u(layout);
    for_each_index(layout, layout.padded(), [&](Site f, const IVec<2>& i) {
      u.at(0, f) = std::sin(2 * M_PI * layout.position(i, face_offset<2>(0))[1]);
    });
    CellField<2> mu(layout);
    set_viscosity(layout, halo, power_law("power_law", 1, 2, 0, 1e-9), u, mu);  // mu = rate
    const double error =
        std::sqrt(local_sum(layout, layout.cells(),
                            [&](Site c, const IVec<2>& i) {
                              const double phase = 2 * M_PI * layout.position(i, cell_offset<2>())[1];
                              const double exact = 2 * M_PI * std::abs(std::cos(phase));
                              return std::abs(std::cos(phase)) > 0.5 ? (mu[c] - exact) * (mu[c] - exact) : 0;
                            })) /
        n;
    if (before > 0) CHECK(std::log2(before / error) == Approx(2).margin(0.1));
    before = error;
  }
}

// Shear d_y u = 1 - 6 y + 3 y^2: extrapolation from inside is exact for it.
TEST_CASE("the viscosity at edges is that of their own shear, in walls that of the profile continued") {
  Sheared<2> flow(Eigen::Matrix2d::Zero(), false);
  for_each_index(flow.layout, flow.layout.padded(), [&](Site f, const IVec<2>& i) {
    const double y = flow.layout.position(i, face_offset<2>(0))[1], h = flow.layout.h();
    flow.u.at(0, f) = y - 3 * y * y + y * y * y - 0.25 * h * h * y;  // differences over h are the shear at edges
  });
  const FaceField<2, char> valid(flow.layout, 1);
  EdgeField<2> mu(flow.layout);
  set_edge_viscosity(flow.layout, power_law("power_law", 1, 2, 0, 1e-9), flow.u, valid, mu);  // mu = rate
  for (int j = 0; j <= 8; ++j) {
    const double y = j * flow.layout.h();
    CHECK(mu[0][std::size_t(flow.layout.site({3, j}))] == Approx(std::abs(1 - 6 * y + 3 * y * y)).epsilon(1e-9));
  }
}

TEST_CASE("an edge at faces that are not valid has the rate of the cells around") {
  Sheared<3> flow(Eigen::Matrix3d{{0, 2, 0}, {0, 0, 0}, {0, 0, 0}}, true);
  FaceField<3, char> valid(flow.layout, 1);
  const Site wrong = flow.layout.site({4, 4, 4});
  flow.u.at(0, wrong) = 1e6;
  valid.at(0, wrong) = 0;
  EdgeField<3> mu(flow.layout);
  set_edge_viscosity(flow.layout, power_law("power_law", 1, 2, 0, 1e-9), flow.u, valid, mu);
  const Site far = flow.layout.site({1, 1, 1});
  for (int plane = 0; plane < 3; ++plane) CHECK(mu[plane][std::size_t(far)] == Approx(2).epsilon(1e-12));
  CHECK(mu[2][std::size_t(flow.layout.site({6, 4, 4}))] == Approx(2).epsilon(1e-12));
  CHECK(mu[2][std::size_t(wrong)] > 2);  // the strain rate of the adjacent cells counts
  CHECK(std::isfinite(mu[2][std::size_t(wrong)]));
}

TEST_CASE("faces that are not valid do not count in the shear rate") {
  Sheared<2> flow((Eigen::Matrix2d() << 0, 1, 0, 0).finished(), false);
  FaceField<2, char> valid(flow.layout, 1);
  const Site wrong = flow.layout.site({4, 4});
  flow.u.at(0, wrong) = 1e6;
  valid.at(0, wrong) = 0;
  const RheologySpec spec = power_law("power_law", 1, 2, 0, 1e-9);
  CellField<2> mu(flow.layout);
  set_viscosity(flow.layout, flow.halo, spec, flow.u, valid, mu);
  for (const IVec<2>& i : {IVec<2>(4, 5), IVec<2>(4, 3), IVec<2>(5, 5), IVec<2>(3, 3)})
    CHECK(mu[flow.layout.site(i)] == Approx(1).epsilon(1e-12));
  set_viscosity(flow.layout, flow.halo, spec, flow.u, mu);
  CHECK(mu[flow.layout.site({4, 5})] > 1e3);
}

}  // namespace rheology_tests
