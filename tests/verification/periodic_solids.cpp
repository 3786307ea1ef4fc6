// Solids beside periodic sides close the same fraction of a face at both of its positions.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/scene.h"
#include "coupling/solids/contact_setup.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/step/initial_state.h"
#include "elastic_scenes.h"
#include "grid/loops.h"
#include "rigid_scenes.h"
#include "scenes.h"

namespace periodic_solids_tests {
using namespace seiche;

namespace {

// A full periodic box with a plate half a cell thick, less than half a cell above the lower side, and a box across the
// upper side.
Scene beside_sides(int dim, SolidKind kind) {
  Scene s = test::box_scene(dim, 12);
  test::make_periodic(s);
  test::add_liquid(s, "-1");
  const double h = s.domain.cell_size, depth = dim == 2 ? 0 : 1;
  SolidSpec plate = test::rigid_box("plate", {0.4, 0.5 * h, 0.4 * depth}, {0.5, 0.7 * h, 0.5 * depth}, 2000);
  SolidSpec box = test::rigid_box("box", {0.3, 0.3, 0.3 * depth}, {0.35, 1.02, 0.5 * depth}, 2000);
  plate.kind = kind, box.kind = kind;
  s.solids = {plate, box};
  return s;
}

template <int Dim>
double largest_difference(const Setup<Dim>& s, const FaceGeometry<Dim>& faces) {
  double most = 0;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(s.domain.layout, s.domain.layout.cells(), [&](Site f, const IVec<Dim>& i) {
      if (i[a] != 0) return;
      const Site other = f + s.domain.layout.geometry().cells[a] * s.domain.layout.stride(a);
      most = std::max(most, std::abs(faces.open.at(a, f) - faces.open.at(a, other)));
      most = std::max(most, double(faces.kind_at(a, f) != faces.kind_at(a, other)));
    });
  return most;
}

template <int Dim>
void check_sides(SolidKind kind) {
  const Setup<Dim> s(beside_sides(Dim, kind), Communicator(), {});
  const State<Dim> state = initial_state(s);
  const StepGeometry<Dim> g = s.solids.geometry.measure(place_bodies(state), 0);
  double least = 1;
  for_each_site(s.domain.layout, s.domain.layout.cells(),
                [&](Site f) { least = std::min(least, g.faces.open.at(1, f)); });
  CHECK(least == 0);
  CHECK(largest_difference(s, g.faces) <= 1e-12);
}

}  // namespace

TEST_CASE("faces on periodic sides are as open at either place") {
  for (const SolidKind kind : {SolidKind::fixed, SolidKind::kinematic, SolidKind::rigid}) {
    check_sides<2>(kind);
    check_sides<3>(kind);
  }
}

TEST_CASE("solids that reach a periodic side are named") {
  const Setup<2> s(beside_sides(2, SolidKind::rigid), Communicator(), {});
  const std::string names = solids_at_periodic_sides(s.domain, s.solids, initial_state(s));
  CHECK(names == "'box' and the periodic side y_upper (solids cannot cross periodic sides)");
}

TEST_CASE("a solid that formulas move across a periodic side is told once; one that turns back before it is not") {
  const auto told = [](const std::string& way) {
    Scene s = test::box_scene(2, 16);
    test::make_periodic(s);
    test::add_liquid(s, "-1");
    SolidSpec box = test::rigid_box("block", {0.2, 0.2, 0}, {0.7, 0.5, 0}, 2000);
    box.kind = SolidKind::kinematic;
    box.motion.translate[0] = way;
    s.solids = {box};
    const auto sim = make_simulation(s, Communicator());
    int count = 0;
    while (sim->time() < 0.5) {
      (void)sim->step(0.5);
      for (const std::string& line : sim->take_warnings())
        count += line.find("'block' moves across the periodic side x_upper") != std::string::npos;
    }
    return count;
  };
  CHECK(told("t") == 1);
  CHECK(told("0.15*sin(6*t)") == 0);
}

TEST_CASE("elastic solids may end at a periodic side but not reach beyond it", "[elastic]") {
  for (int dim : {2, 3}) {
    const auto ending_at = [&](double x) {
      Scene s = test::box_scene(dim, 8);
      test::make_periodic(s);
      const double z = dim == 3 ? 0.2 : 0;
      s.solids.push_back(test::elastic_box("bed", {0.3, 0.3, z}, {x, 0.5, 3 * z}, 1000, {1e6, 0.3}, 0.2));
      test::pin(s.solids.back(), {0, 0, -1}, {2, 0.301, 2});
      return s;
    };
    (void)make_simulation(ending_at(1), Communicator());
    try {
      (void)make_simulation(ending_at(1.1), Communicator());
      FAIL("was taken");
    } catch (const Error& e) {
      CHECK(e.code() == ExitCode::bad_input);
      CHECK(std::string(e.what()).find("'bed' reaches beyond the periodic side x_upper") != std::string::npos);
    }
  }
}

}  // namespace periodic_solids_tests
