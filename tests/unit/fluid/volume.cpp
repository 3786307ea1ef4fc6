// Volumes of liquid carried through faces: planes in cells, regions that pass faces, conservation.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "fluid/volume/cell_plane.h"
#include "fluid/volume/level_set_coupling.h"
#include "fluid/volume/spill.h"
#include "fluid/volume/surface_pieces.h"
#include "fluid/volume/swept_region.h"
#include "fluid/volume/volume_transport.h"
#include "grid/ghosts.h"
#include "grid/loops.h"
#include "levelset/fractions.h"

namespace volume_tests {
using namespace seiche;

namespace {

template <int Dim>
Vec<Dim> random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vec<Dim> n;
  for (int a = 0; a < Dim; ++a) n[a] = normal(random);
  return n.normalized();
}

// Share of the unit cube below a plane, by slabs along its first axis: midpoints in 2D, trapezia of 2D shares in 3D.
double share_by_slabs(const Vec<2>& n, double offset) {
  constexpr int slabs = 20000;
  double sum = 0;
  for (int k = 0; k < slabs; ++k) {
    const double y = (offset - n[0] * (k + 0.5) / slabs) / n[1];
    sum += n[1] > 0 ? std::clamp(y, 0.0, 1.0) : 1 - std::clamp(y, 0.0, 1.0);
  }
  return sum / slabs;
}
double share_by_slabs(const Vec<3>& n, double offset) {
  constexpr int slabs = 1000;
  double sum = 0;
  for (int k = 0; k < slabs; ++k) sum += share_below<2>(n.tail<2>(), offset - n[0] * (k + 0.5) / slabs);
  return sum / slabs;
}

template <int Dim>
void check_planes() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> inside(0, 1);
  for (int k = 0; k < 200; ++k) {
    Vec<Dim> n = random_direction<Dim>(random);
    if (k % 5 == 0) n[k / 5 % Dim] *= 1e-9;
    const double reach = n.cwiseMax(0).sum(), least = n.cwiseMin(0).sum();
    const double offset = least + (reach - least) * inside(random), share = inside(random);
    CAPTURE(n.transpose(), offset, share);
    CHECK(share_below<Dim>(n, offset) == Approx(share_by_slabs(n, offset)).margin(1e-4));  // error of the slabs
    CHECK(share_below<Dim>(n, offset_of_share<Dim>(n, share)) == Approx(share).margin(1e-9));
  }
}

}  // namespace

TEST_CASE("shares below planes in a cell and their inverse") {
  check_planes<2>();
  check_planes<3>();
}

namespace {

// A grid without sides that matter, and a flow on it.
template <int Dim>
struct Flow {
  Geometry<Dim> g;
  Layout<Dim> layout;
  Communicator ranks;
  Halo<Dim> halo;
  FaceField<Dim> u;
  CellField<Dim> phi, share;

  explicit Flow(int cells, int pad = 5, bool periodic = false)
      : g(geometry(cells, periodic)),
        layout(g, g.box(), pad),
        halo(layout, {g.box()}, ranks),
        u(layout),
        phi(layout),
        share(layout) {}
  static Geometry<Dim> geometry(int cells, bool periodic) {
    Geometry<Dim> g;
    g.periodic[1] = periodic;
    g.h = 1.0 / cells;
    g.cells = IVec<Dim>::Constant(cells);
    return g;
  }
  template <class F>
  void set_level_set(const F& f) {
    for_each_index(layout, layout.padded(),
                   [&](Site c, const IVec<Dim>& i) { phi[c] = f(layout.position(i, cell_offset<Dim>())); });
  }
  // Shares of the liquid where f(x) < 0, f a distance: that of the plane tangential at each cell's centre.
  template <class F>
  void set_liquid(const F& f) {
    for_each_index(layout, layout.padded(), [&](Site c, const IVec<Dim>& i) {
      const Vec<Dim> x = layout.position(i, cell_offset<Dim>());
      phi[c] = f(x);
      Vec<Dim> n;
      for (int a = 0; a < Dim; ++a)
        n[a] = f(x + 1e-4 * g.h * Vec<Dim>::Unit(a)) - f(x - 1e-4 * g.h * Vec<Dim>::Unit(a));
      n /= 2e-4 * g.h;
      share[c] = share_below<Dim>(n, 0.5 * n.sum() - f(x) / g.h);
    });
  }
  double total() const {
    return local_sum(layout, layout.cells(), [&](Site c, const IVec<Dim>&) { return share[c]; });
  }
};

// A slab of liquid between two planes in a uniform flow, which moves it by less than two cells.
template <int Dim>
void check_uniform_flow() {
  Flow<Dim> s(24);
  const Vec<Dim> n = Vec3(0.48, 0.6, 0.64).head<Dim>().normalized(), v = Vec3(1.3, -0.7, 0.4).head<Dim>();
  const auto slab = [&](const Vec<Dim>& x) { return std::abs(n.dot(x) - 0.5 * n.sum()) - 0.21; };
  s.set_liquid(slab);
  for (int a = 0; a < Dim; ++a) s.u[a].fill(v[a]);
  const double dt = s.g.h;
  (void)carry_volume(s.layout, s.halo, s.ranks, s.u, dt, s.phi, Divergence::swells, s.share);
  const CellField<Dim> carried = s.share;
  s.set_liquid([&](const Vec<Dim>& x) { return slab(x - dt * v); });
  double worst = 0;
  for_each_index_in_order(s.layout, s.layout.grown(-4), [&](Site c, const IVec<Dim>&) {
    worst = std::max(worst, std::abs(carried[c] - s.share[c]));
  });
  CHECK(worst < 1e-9);
}

// Deformation of a ball in one turn of a divergence-free flow: volume to rounding, no spill.
template <int Dim>
void check_conservation() {
  constexpr double pi = 3.14159265358979323846;
  Flow<Dim> s(Dim == 3 ? 20 : 32);
  s.set_liquid([](const Vec<Dim>& x) { return (x - Vec<Dim>::Constant(0.4)).norm() - 0.23; });
  // u = curl of a nodal or edge potential: free of divergence on the grid.
  const auto potential = [&](const Vec<Dim>& x) { return std::pow(std::sin(pi * x[0]) * std::sin(pi * x[1]), 2) / pi; };
  for_each_index(s.layout, s.layout.grown(4), [&](Site f, const IVec<Dim>& i) {
    const auto at = [&](int di, int dj) {
      Vec<Dim> x = s.layout.position(i, cell_offset<Dim>());
      x[0] += (di - 0.5) * s.g.h, x[1] += (dj - 0.5) * s.g.h;
      return potential(x);
    };
    s.u.at(0, f) = (at(0, 1) - at(0, 0)) / s.g.h;
    s.u.at(1, f) = -(at(1, 0) - at(0, 0)) / s.g.h;
  });
  const double before = s.total();
  s.phi.fill(1e3);  // normals from columns
  double moved = 0;
  for (int n = 0; n < 10; ++n)
    moved += carry_volume(s.layout, s.halo, s.ranks, s.u, 1.4 * s.g.h, s.phi, Divergence::swells, s.share).spill.moved;
  CHECK(s.total() == Approx(before).epsilon(1e-12));
  CHECK(moved <= 1e-6 * before);
  double least = 0, most = 1;
  for_each_site(s.layout, s.layout.cells(),
                [&](Site c) { least = std::min(least, s.share[c]), most = std::max(most, s.share[c]); });
  CHECK(least >= -1e-12);
  CHECK(most <= 1 + 1e-12);
}

// Shares above 1 and below 0 everywhere, beside walls and in corners, too.
template <int Dim>
void check_spill() {
  Flow<Dim> s(8);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-0.2, 1.3);
  for_each_index_in_order(s.layout, s.layout.cells(), [&](Site c, const IVec<Dim>&) { s.share[c] = any(random); });
  fill_share_ghosts(s.layout, s.halo, s.share);
  const double before = s.total();
  CHECK(hand_on_excess(s.layout, s.halo, s.ranks, s.phi, Divergence::swells, {}, s.share).worst > 0.2);
  CHECK(s.total() == Approx(before).epsilon(1e-13));
}

}  // namespace

TEST_CASE("cells beside walls hand on what they cannot hold, and no more") {
  check_spill<2>();
  check_spill<3>();
}

TEST_CASE("volumes between planes go along with a uniform flow") {
  check_uniform_flow<2>();
  check_uniform_flow<3>();
}

TEST_CASE("volumes carried in a flow that stretches them add up to rounding") {
  check_conservation<2>();
  check_conservation<3>();
}

namespace {

// A ball in the level set and, larger or smaller, in the volumes.
template <int Dim>
struct TwoBalls : Flow<Dim> {
  NodeField<Dim> psi;

  TwoBalls(double of_level_set, double of_volumes) : Flow<Dim>(24), psi(this->layout, 1e30) {
    const auto ball = [](double radius) {
      return [radius](const Vec<Dim>& x) { return (x - Vec<Dim>::Constant(0.52)).norm() - radius; };
    };
    this->set_liquid(ball(of_volumes));
    for_each_site(this->layout, this->layout.cells(),
                  [&](Site c) { this->share[c] = liquid_share(this->layout, this->phi, psi, c); });
    fill_share_ghosts(this->layout, this->halo, this->share);
    this->set_level_set(ball(of_level_set));
  }
  double volume_of_level_set() const {
    return local_liquid_volume(this->layout, this->phi, psi) / this->g.cell_volume();
  }
  Coupled couple() {
    return couple_level_set(this->layout, this->halo, this->ranks, psi, Divergence::swells, this->phi, this->share);
  }
};

template <int Dim>
void check_coupling() {
  const double h = 1.0 / 24;
  TwoBalls<Dim> alike(0.3, 0.3);
  const double before = alike.total();
  CHECK(alike.couple().rebuilt == 0);
  CHECK(alike.total() == Approx(before).epsilon(1e-13));
  CHECK(alike.volume_of_level_set() == Approx(before).epsilon(1e-12));

  TwoBalls<Dim> smaller(0.3 - 0.2 * h, 0.3);
  const double volume = smaller.total();
  // Chebyshev's steps leave up to a tenth of the shift. It goes on slowly: n rounds leave (200 n)^(-1/2) cells.
  for (int n = 0; n < 300; ++n) CHECK(smaller.couple().rebuilt == 0);
  CHECK(smaller.total() == Approx(volume).epsilon(1e-13));
  CHECK(smaller.volume_of_level_set() == Approx(volume).epsilon(2e-3));

  TwoBalls<Dim> lost(-1, 0.12);  // the level set knows nothing of it
  CHECK(lost.couple().rebuilt > 0);
  for (int n = 0; n < 300; ++n) (void)lost.couple();
  CHECK(lost.volume_of_level_set() == Approx(lost.total()).epsilon(0.01));
}

}  // namespace

TEST_CASE("the level set takes the amount of liquid from the volumes, which keep their sum") {
  check_coupling<2>();
  check_coupling<3>();
}

namespace {

// A pool below a flat level set, while the volumes have waves of up to a cell, which cross the seam of a periodic axis.
// Coupling has to rebuild, to hand on and to exchange there.
template <int Dim>
void check_coupling_of_waves(unsigned seed) {
  constexpr int n = 16;
  constexpr double h = 1.0 / n, turn = 6.28318530717958648;
  Flow<Dim> s(n, 5, true);
  const NodeField<Dim> psi(s.layout, 1e30);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  const double level = 0.45 + h * any(random), height = 0.3 + 0.9 * any(random), waves = 2 + int(4 * any(random)),
               phase = turn * any(random);
  s.set_level_set([&](const Vec<Dim>& x) { return x[0] - level - height * h * std::sin(turn * waves * x[1] + phase); });
  for_each_site(s.layout, s.layout.cells(), [&](Site c) { s.share[c] = liquid_share(s.layout, s.phi, psi, c); });
  fill_share_ghosts(s.layout, s.halo, s.share);
  s.set_level_set([&](const Vec<Dim>& x) { return x[0] - level; });
  const double before = s.total();
  for (int k = 0; k < 3; ++k) {
    (void)couple_level_set(s.layout, s.halo, s.ranks, psi, Divergence::swells, s.phi, s.share);
    double least = 0, most = 1;
    for_each_site(s.layout, s.layout.cells(),
                  [&](Site c) { least = std::min(least, s.share[c]), most = std::max(most, s.share[c]); });
    CAPTURE(seed, k);
    CHECK(s.total() == Approx(before).epsilon(1e-13));
    CHECK(least >= -1e-12);
    CHECK(most <= 1 + 1e-12);
  }
}

}  // namespace

TEST_CASE("coupling keeps the sum of the volumes and their bounds, across a periodic seam, too") {
  for (unsigned seed = 0; seed < 150; ++seed) check_coupling_of_waves<2>(seed);
  for (unsigned seed = 0; seed < 6; ++seed) check_coupling_of_waves<3>(seed);
}

namespace {

// Liquid at x = 0 in a flow that is 100 times as fast beyond the side there.
template <int Dim>
void check_long_paths() {
  const auto too_far = [&](double cells) {
    Flow<Dim> s(12);
    s.set_liquid([](const Vec<Dim>& x) { return x[0] - 0.12; });
    for_each_index(s.layout, s.layout.padded(), [&](Site f, const IVec<Dim>& i) { s.u.at(0, f) = i[0] < 0 ? 100 : 1; });
    const VolumeStep step =
        carry_volume(s.layout, s.halo, s.ranks, s.u, cells * s.g.h, s.phi, Divergence::swells, s.share);
    for_each_site(s.layout, s.layout.cells(), [&](Site c) { CHECK(std::isfinite(s.share[c])); });
    return step.too_far;
  };
  CHECK(too_far(0.01) == 0);
  CHECK(too_far(0.08) == 0);  // in four parts of two cells each
  CHECK(too_far(1.5) > 0);
}

}  // namespace

namespace {

// A pool in a flow that gathers in its depth, as a solve leaves it: full cells keep the excess, whose sum is right, and
// neither spill it nor pass it to the level set.
template <int Dim>
void check_excess() {
  constexpr double error = 1e-4;
  Flow<Dim> s(16);
  const auto pool = [](const Vec<Dim>& x) { return x[1] - 0.7; };
  s.set_liquid(pool);
  const Site deep = s.layout.site(IVec<Dim>::Constant(4));
  s.u.at(0, deep) = error, s.u.at(0, deep + s.layout.stride(0)) = -error;
  const double before = s.total();
  const VolumeStep step = carry_volume(s.layout, s.halo, s.ranks, s.u, 0.5 * s.g.h, s.phi, Divergence::stays, s.share);
  CHECK(s.share[deep] - 1 == Approx(error).epsilon(1e-9));
  CHECK(s.total() == Approx(before).epsilon(1e-14));
  CHECK(step.swollen == 0);
  CHECK(step.spill.moved <= 1e-12 * before);
  CHECK(is_deep(s.layout, Divergence::stays, s.phi, s.share, deep));
  CHECK(!is_deep(s.layout, Divergence::swells, s.phi, s.share, deep));
  const CellField<Dim> phi = s.phi;
  const Coupled coupled =
      couple_level_set(s.layout, s.halo, s.ranks, NodeField<Dim>(s.layout, 1e30), Divergence::stays, s.phi, s.share);
  CHECK(coupled.rebuilt == 0);
  CHECK(s.phi[deep] == phi[deep]);
  CHECK(s.share[deep] - 1 == Approx(error).epsilon(1e-9));
}

// A cell that lacks liquid among full ones: rounding of these does not choose its plane, the level set does.
template <int Dim>
void check_lone_cell() {
  Flow<Dim> s(8);
  const Site lone = s.layout.site(IVec<Dim>::Constant(4));
  const auto plane = [&](double rounding) {
    for_each_index_in_order(s.layout, s.layout.padded(), [&](Site c, const IVec<Dim>& i) {
      s.share[c] = 1;
      s.phi[c] = -0.1 * s.g.h - 0.05 * s.g.h * (4 - i[1]);
    });
    s.share[lone] = 0.8;
    s.share[lone + s.layout.stride(0)] = 1 - rounding, s.share[lone - s.layout.stride(0)] = 1 + rounding;
    const CountedShares<Dim> counted(s.layout, Divergence::swells, s.phi, s.share);
    return surface_pieces<Dim>(s.layout, s.layout.cells(), s.phi, counted)[lone];
  };
  for (const double rounding : {1e-15, -1e-15, 0.0}) {
    const CellPlane<Dim> found = plane(rounding);
    CHECK((found.normal - Vec<Dim>::Unit(1)).norm() < 1e-12);
    CHECK(found.offset == Approx(0.8).epsilon(1e-9));
  }
}

}  // namespace

TEST_CASE("cells deep in the liquid keep what the error of a solve moves into them") {
  check_excess<2>();
  check_excess<3>();
}

TEST_CASE("rounding does not choose the plane of a cell among full ones") {
  check_lone_cell<2>();
  check_lone_cell<3>();
}

TEST_CASE("paths of the volumes that leave the halo are counted and cut short") {
  check_long_paths<2>();
  check_long_paths<3>();
}

}  // namespace volume_tests
