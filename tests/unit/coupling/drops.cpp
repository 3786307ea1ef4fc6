// Drops: flight, walls, merging, making and landing.
#include <catch2/catch.hpp>

#include "coupling/drops/making.h"
#include "coupling/state/setup.h"
#include "coupling/transport/tracked_volume.h"
#include "grid/loops.h"
#include "verification/scenes.h"

namespace drops_tests {
using namespace seiche;

namespace {

// An empty box of walls, 1 m wide, with 12 cells an axis.
template <int Dim>
struct Room12 {
  Scene scene = test::box_scene(Dim, 12);
  Setup<Dim> setup{scene, Communicator()};
  StepGeometry<Dim> geometry = setup.solids.geometry.measure({}, 0);
  const Layout<Dim>& layout = setup.domain.layout;
  Obstacles<Dim> obstacles{setup.domain, setup.solids.bodies, geometry, {}};
  State<Dim> state;
  double cell_volume = layout.geometry().cell_volume();

  Room12() {
    state.phi = CellField<Dim>(layout, 1.0);
    state.liquid = CellField<Dim>(layout);
  }
  void fly(const Vec3& gravity, double from, double until, std::vector<Drop<Dim>>& drops) {
    const DropForces<Dim> forces{gravity, setup.forces};
    seiche::fly(setup.domain, obstacles, forces, state.phi, from, until, drops);
  }
  Site site(const IVec<Dim>& i) const { return layout.site(i); }
};

template <int Dim>
Vec<Dim> momentum(const std::vector<Drop<Dim>>& drops) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Drop<Dim>& d : drops) sum += d.volume * d.velocity;
  return sum;
}

// x = x0 + v t + g t^2/2, whatever the steps.
template <int Dim>
void check_parabola() {
  Room12<Dim> room;
  const Vec<Dim> x0 = Vec<Dim>::Constant(0.3);
  Vec<Dim> v0 = Vec<Dim>::Constant(0.4), g = Vec<Dim>::Zero();
  v0[1] = 2;
  g[1] = -9.81;
  std::vector<Drop<Dim>> drops{{x0, v0, 1e-5, 7}};
  const double end = 0.35;
  const int steps = 9;
  for (int n = 0; n < steps; ++n) room.fly({0, -9.81, 0}, end * n / steps, end * (n + 1) / steps, drops);
  const Vec<Dim> expected = x0 + end * v0 + 0.5 * end * end * g;
  CHECK((drops[0].place - expected).norm() < 1e-14);
  CHECK((drops[0].velocity - (v0 + end * g)).norm() < 1e-13);
  CHECK(drops[0].id == 7);
}

// Gravity 10 sin 5t, its value at the middle of each step: second order.
double error_under_changing_gravity(int steps) {
  Room12<2> room;
  std::vector<Drop<2>> drops{{Vec<2>(0.3, 0.2), Vec<2>(0, 0), 1e-5, 0}};
  const double dt = 0.5 / steps;
  for (int n = 0; n < steps; ++n) room.fly({0, 10 * std::sin(5 * (n + 0.5) * dt), 0}, n * dt, (n + 1) * dt, drops);
  const double exact = 0.2 + 10.0 / 5 * 0.5 - 10.0 / 25 * std::sin(2.5);
  return std::abs(drops[0].place[1] - exact);
}

template <int Dim>
void check_floor() {
  Room12<Dim> room;
  Vec<Dim> x = Vec<Dim>::Constant(0.5), v = Vec<Dim>::Zero();
  x[1] = 0.05;
  v[0] = 0.3;
  std::vector<Drop<Dim>> drops{{x, v, 0.1 * room.cell_volume, 0}};
  for (int n = 0; n < 20; ++n) room.fly({0, -9.81, 0}, 0.02 * n, 0.02 * (n + 1), drops);
  const double radius = radius_of_drop<Dim>(drops[0].volume);
  CHECK(drops[0].place[1] == Approx(radius));  // it lies there
  CHECK(drops[0].velocity[0] == Approx(0.3));  // and slides
  CHECK(drops[0].velocity[1] <= 0);
  CHECK(drops[0].place[0] == Approx(0.5 + 0.3 * 0.4));
  CHECK(room.obstacles.touches(drops[0]));
}

template <int Dim>
void check_merging() {
  Room12<Dim> room;
  const Vec<Dim> x = room.layout.position(IVec<Dim>::Constant(4), cell_offset<Dim>());
  std::vector<Drop<Dim>> drops{{x, Vec<Dim>::Constant(1), 1e-5, 5},
                               {x + Vec<Dim>::Constant(0.01), Vec<Dim>::Constant(-2), 3e-5, 9},
                               {x + Vec<Dim>::Constant(0.2), Vec<Dim>::Constant(3), 1e-5, 11}};
  const Vec<Dim> before = momentum(drops);
  merge_drops(room.layout, drops);
  REQUIRE(drops.size() == 2);
  CHECK(drops[0].id == 9);
  CHECK(drops[0].volume == Approx(4e-5).epsilon(1e-15));
  CHECK((drops[0].place - x - Vec<Dim>::Constant(0.0075)).norm() < 1e-15);
  CHECK((momentum(drops) - before).norm() < 1e-18);
}

// Faces of random velocity.
template <int Dim>
FaceField<Dim> random_flow(const Layout<Dim>& layout) {
  FaceField<Dim> u(layout);
  for (int a = 0; a < Dim; ++a)
    for (Site f = 0; f < layout.size(); ++f) u.at(a, f) = std::sin(1.7 * double(f) + a);
  return u;
}

// Volume, momentum of the faces' velocities, and no more energy than these have.
template <int Dim>
void check_making(bool keeps) {
  Room12<Dim> room;
  const FaceField<Dim> u = random_flow(room.layout);
  IVec<Dim> other = IVec<Dim>::Constant(5);
  other[0] = 8;
  const std::vector<IVec<Dim>> cells{IVec<Dim>::Constant(5), other};
  Vec<Dim> momentum_of_faces = Vec<Dim>::Zero();
  double energy = 0;
  for (const IVec<Dim>& i : cells) {
    const Site c = room.site(i);
    const double volume = room.cell_volume * (room.state.liquid[c] = 0.2 + 0.01 * i[0]);
    for (int a = 0; a < Dim; ++a) {
      const double low = u.at(a, c), high = u.at(a, c + room.layout.stride(a));
      momentum_of_faces[a] += 0.5 * volume * (low + high);
      energy += 0.25 * volume * (low * low + high * high);
    }
  }
  room.state.expected_volume = tracked_volume(room.setup.domain, room.state);
  const double volume = room.state.expected_volume;
  const DropForces<Dim> forces{Vec3::Zero(), room.setup.forces};
  std::vector<LandedDrop<Dim>> landed;
  make_drops(room.setup.domain, room.obstacles, {u, room.geometry.faces, forces, 0, 0.1}, keeps, landed, room.state);
  CHECK(tracked_volume(room.setup.domain, room.state) == Approx(room.state.expected_volume).margin(1e-14 * volume));
  if (!keeps) {
    CHECK(room.state.drops.list.empty());
    CHECK(room.state.drops.left_out == Approx(volume));
    CHECK(std::abs(room.state.expected_volume) < 1e-15);
    return;
  }
  REQUIRE(room.state.drops.list.size() == 2);
  CHECK((momentum(room.state.drops.list) - momentum_of_faces).norm() < 1e-16);
  CHECK(room.state.drops.made < energy);
  CHECK(room.state.drops.made > 0);
}

// Momentum sum of M u with M = half of the liquid on both sides of a face, over the density.
template <int Dim>
Vec<Dim> momentum_on_faces(const Layout<Dim>& layout, const CellField<Dim>& share, const FaceField<Dim>& u) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (int a = 0; a < Dim; ++a)
    sum[a] = local_sum(layout, layout.faces(a), [&](Site f, const IVec<Dim>&) {
      return 0.5 * (share[f] + share[f - layout.stride(a)]) * u.at(a, f);
    });
  return layout.geometry().cell_volume() * sum;
}

template <int Dim>
double energy_on_faces(const Layout<Dim>& layout, const CellField<Dim>& share, const FaceField<Dim>& u) {
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    sum += local_sum(layout, layout.faces(a), [&](Site f, const IVec<Dim>&) {
      return 0.25 * (share[f] + share[f - layout.stride(a)]) * std::pow(u.at(a, f), 2);
    });
  return layout.geometry().cell_volume() * sum;
}

// `depth` in cells.
template <int Dim>
void fill_pool(Room12<Dim>& room, double depth) {
  const Layout<Dim>& l = room.layout;
  for_each_index_in_order(l, l.padded(), [&](Site c, const IVec<Dim>& i) {
    room.state.phi[c] = (i[1] + 0.5 - depth) * l.h();
    room.state.liquid[c] = l.cells().contains(i) ? std::clamp(depth - i[1], 0.0, 1.0) : 0;
  });
}

// Drops in the cells of a pool's surface.
template <int Dim>
void check_landing() {
  Room12<Dim> room;
  const Layout<Dim>& l = room.layout;
  fill_pool(room, 5.7);
  FaceField<Dim> u = random_flow(l);
  for (int a = 0; a < Dim; ++a)
    for_each_site(l, l.faces(a), [&](Site f) {
      if (!room.geometry.faces.is_unknown(a, f)) u.at(a, f) = 0;
    });
  IVec<Dim> i = IVec<Dim>::Constant(5), j = i;
  j[0] = 6;
  Vec<Dim> high = l.position(i, cell_offset<Dim>());
  high[1] = 0.8;
  const auto at = [&](const IVec<Dim>& cell) { return l.position(cell, cell_offset<Dim>()); };
  room.state.drops.list = {{at(i), Vec<Dim>::Constant(-3), 0.1 * room.cell_volume, 1},
                           {at(j), Vec<Dim>::Constant(2), 0.2 * room.cell_volume, 2},
                           {high, Vec<Dim>::Constant(1), 0.2 * room.cell_volume, 3}};
  const double volume = tracked_volume(room.setup.domain, room.state);
  const CellField<Dim> before = room.state.liquid;
  const std::vector<LandedDrop<Dim>> landed =
      land_drops(room.setup.domain, room.obstacles, {Divergence::stays}, room.state);
  REQUIRE(landed.size() == 2);
  REQUIRE(room.state.drops.list.size() == 1);
  CHECK(room.state.spilled_volume == 0);
  CHECK(tracked_volume(room.setup.domain, room.state) == Approx(volume).epsilon(1e-14));
  Vec<Dim> wanted = momentum_on_faces(l, before, u);
  double energy = energy_on_faces(l, before, u);
  for (const LandedDrop<Dim>& d : landed) {
    wanted += room.cell_volume * d.share * d.velocity;
    energy += 0.5 * room.cell_volume * d.share * d.velocity.squaredNorm();
  }
  give_momentum(room.setup.domain, room.geometry.faces, room.state.phi, room.state.liquid, landed, u);
  CHECK((momentum_on_faces(l, room.state.liquid, u) - wanted).norm() < 1e-15);
  CHECK(energy_on_faces(l, room.state.liquid, u) < energy);
}

// A full cell has no room: its neighbours above the surface take a drop.
template <int Dim>
void check_spill() {
  Room12<Dim> room;
  const Layout<Dim>& l = room.layout;
  fill_pool(room, 6);
  room.state.drops.list = {
      {l.position(IVec<Dim>::Constant(5), cell_offset<Dim>()), Vec<Dim>::Zero(), 0.4 * room.cell_volume, 1}};
  const double volume = tracked_volume(room.setup.domain, room.state);
  land_drops(room.setup.domain, room.obstacles, {Divergence::stays}, room.state);
  CHECK(tracked_volume(room.setup.domain, room.state) == Approx(volume).epsilon(1e-14));
  CHECK(room.state.spilled_volume == 0);
  CHECK(room.state.liquid[room.site(IVec<Dim>::Constant(5))] == Approx(1));
}

// Drops on a wall become liquid together.
template <int Dim>
void check_puddle() {
  Room12<Dim> room;
  Vec<Dim> x = room.layout.position(IVec<Dim>::Constant(4), cell_offset<Dim>());
  x[1] = 0.01;
  room.state.drops.list = {{x, Vec<Dim>::Zero(), 0.3 * room.cell_volume, 1},
                           {x + 0.01 * Vec<Dim>::Unit(0), Vec<Dim>::Zero(), 0.2 * room.cell_volume, 2}};
  const auto land = [&] {
    for (Drop<Dim>& d : room.state.drops.list) room.obstacles.keep_out(d);
    merge_drops(room.layout, room.state.drops.list);
    return land_drops(room.setup.domain, room.obstacles, {Divergence::stays}, room.state).size();
  };
  CHECK(land() == 0);
  room.state.drops.list.push_back({x, Vec<Dim>::Zero(), 0.1 * room.cell_volume, 3});
  CHECK(land() == 1);
  IVec<Dim> cell = IVec<Dim>::Constant(4);
  cell[1] = 0;
  CHECK(room.state.liquid[room.site(cell)] == Approx(0.6));
}

}  // namespace

TEST_CASE("a drop flies along a parabola, exactly") {
  check_parabola<2>();
  check_parabola<3>();
}

TEST_CASE("drops fly to second order where gravity changes") {
  const double coarse = error_under_changing_gravity(10), fine = error_under_changing_gravity(20);
  CHECK(coarse < 4e-3);  // 3.2e-3
  CHECK(coarse / fine == Approx(4).epsilon(0.05));
}

TEST_CASE("a drop on the floor lies there and slides") {
  check_floor<2>();
  check_floor<3>();
}

TEST_CASE("drops in one cell become one, with their volume and momentum") {
  check_merging<2>();
  check_merging<3>();
}

TEST_CASE("drops are made with the volume of cells and the momentum of their faces") {
  check_making<2>(true);
  check_making<3>(true);
}

TEST_CASE("drops that are left out are taken from what is expected") {
  check_making<2>(false);
  check_making<3>(false);
}

TEST_CASE("drops that land give cells their volume, and faces their momentum") {
  check_landing<2>();
  check_landing<3>();
}

TEST_CASE("a drop in a full cell goes to its neighbours") {
  check_spill<2>();
  check_spill<3>();
}

TEST_CASE("drops that lie on a wall together become liquid of the grid") {
  check_puddle<2>();
  check_puddle<3>();
}

}  // namespace drops_tests
