// Requirements that every kind of exterior must meet.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "coupling/state/checkpoint_state.h"
#include "coupling/state/setup.h"
#include "coupling/step/initial_state.h"
#include "grid/loops.h"
#include "verification/scenes.h"

namespace exteriors_tests {
using namespace seiche;

namespace {

enum class Kind { vacuum, enclosed_air, flowing_gas };

// Water below a pocket of air, with a bubble in it.
Scene pool(int dim, Kind kind, double viscosity = 0) {
  Scene s = test::box_scene(dim, 16);
  s.gravity = {0, -9.81, 0};
  test::add_liquid(s, fmt::format("max(y-0.7, 0.15-sqrt((x-0.5)^2+(y-0.35)^2{}))", dim == 3 ? "+(z-0.5)^2" : ""));
  s.liquid.viscosity = fmt::format("{}", viscosity);
  s.gas.present = kind != Kind::vacuum;
  s.gas.bubbles = kind == Kind::enclosed_air ? Bubbles::volume_conserving : Bubbles::resolved;
  s.gas.viscosity = 0.01 * viscosity;
  return s;
}

void check_equal(const CheckpointData& a, const CheckpointData& b) {
  CHECK(a.scalars == b.scalars);
  CHECK(a.texts == b.texts);
  REQUIRE(a.fields.size() == b.fields.size());
  for (std::size_t n = 0; n < a.fields.size(); ++n) {
    INFO(a.fields[n].name);
    CHECK(a.fields[n].name == b.fields[n].name);
    CHECK(a.fields[n].values == b.fields[n].values);
  }
}

void check_boxes(const std::vector<FieldRecord>& boxes, const std::vector<FieldRecord>& fields) {
  REQUIRE(boxes.size() == fields.size());
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    CHECK(boxes[n].name == fields[n].name);
    CHECK(boxes[n].lower == fields[n].lower);
    CHECK(boxes[n].upper == fields[n].upper);
  }
}

template <int Dim>
void check_kind(Kind kind) {
  const Setup<Dim> setup(pool(Dim, kind), Communicator());
  const State<Dim> state = initial_state(setup);
  CHECK(state.exterior->flows() == (kind == Kind::flowing_gas));
  const Layout<Dim>& layout = setup.domain.layout;
  for_each_index_in_order(layout, layout.cells(), [&](Site c, const IVec<Dim>&) {
    if (state.phi[c] >= 0) CHECK(state.exterior->has_pressure(c) == (kind != Kind::vacuum));
  });
  const StepGeometry<Dim> g = setup.solids.geometry.measure({}, 0);
  ProjectionInput<Dim> in{layout, setup.domain.halo, setup.domain.ranks, state.phi, g.faces, setup.fluids.density(),
                          0.01};
  state.exterior->set_rows(setup.fluids, setup.perturbation, in);
  CHECK(in.has_gas() == (kind == Kind::flowing_gas));
  CHECK((in.air != nullptr) == (kind == Kind::enclosed_air));
  if (in.air) CHECK(in.air->count() == 2);
}

// The copy drops its present level and the original keeps it.
template <int Dim>
void check_copy() {
  const Setup<Dim> setup(pool(Dim, Kind::flowing_gas), Communicator());
  const State<Dim> state = initial_state(setup);
  State<Dim> copy = state;
  CHECK(copy.exterior->flow.now == state.exterior->flow.now);
  age(copy.exterior->flow);
  copy.exterior->flow.now = nullptr;
  CHECK(state.exterior->flows());
  CHECK(copy.exterior->flow.before == state.exterior->flow.now);
  CHECK(state.exterior->flow.before == nullptr);
}

void check_checkpoint(const Scene& scene) {
  const auto sim = make_simulation(scene, Communicator()), other = make_simulation(scene, Communicator());
  for (int n = 0; n < 3; ++n) {
    const CheckpointData data = sim->save();
    other->load(data);
    check_equal(other->save(), data);
    check_boxes(other->checkpoint_boxes(data), data.fields);
    (void)sim->step(1);
  }
}

}  // namespace

TEST_CASE("the table [gas] chooses the exterior, and with it the rows of the pressure") {
  for (const Kind kind : {Kind::vacuum, Kind::enclosed_air, Kind::flowing_gas}) {
    check_kind<2>(kind);
    check_kind<3>(kind);
  }
}

TEST_CASE("copies of an exterior are deep") {
  check_copy<2>();
  check_copy<3>();
}

TEST_CASE("a state with an exterior of any kind is saved and loaded bit for bit") {
  for (const Kind kind : {Kind::vacuum, Kind::enclosed_air, Kind::flowing_gas})
    for (const double viscosity : {0.0, 1.0}) {
      check_checkpoint(pool(2, kind, viscosity));
    }
  check_checkpoint(pool(3, Kind::enclosed_air));
}

TEST_CASE("the joined flow is the liquid's own level where nothing else flows") {
  for (const Kind kind : {Kind::vacuum, Kind::enclosed_air}) {
    const Setup<2> setup(pool(2, kind), Communicator());
    const State<2> state = initial_state(setup);
    CHECK(state.exterior->joined_level(setup.domain, setup.fluids, state) == state.now);
  }
}

TEST_CASE("each face of the joined flow has the velocity of the fluid there") {
  Scene scene = pool(2, Kind::flowing_gas);
  scene.liquid.velocity[0] = "1";
  scene.gas.velocity[0] = "2";
  test::make_periodic(scene);
  const Setup<2> setup(scene, Communicator());
  const State<2> state = initial_state(setup);
  const auto joined = state.exterior->joined_level(setup.domain, setup.fluids, state);
  const Layout<2>& layout = setup.domain.layout;
  for_each_index_in_order(layout, layout.faces(0), [&](Site f, const IVec<2>&) {
    const bool touches_liquid = state.phi[f] < 0 || state.phi[f - layout.stride(0)] < 0;
    CHECK(joined->u.at(0, f) == (touches_liquid ? 1 : 2));
  });
}

}  // namespace exteriors_tests
