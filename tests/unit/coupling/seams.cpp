// Pinned ends of elastic solids on other solids, and cavities that they close.
#include <catch2/catch.hpp>

#include "base/domain_spec.h"
#include "base/solid_spec.h"
#include "coupling/geometry/step_geometry.h"
#include "unit/solid/wall_specs.h"

namespace seams_tests {
using namespace seiche;
using test::box;

namespace {

// A wall with its upper end pinned `gap` below a plate that moves by `motion`.
std::vector<Body<2>> wall_and_plate(double gap, const Formula& motion) {
  SolidSpec wall = box(SolidKind::elastic, {0.4, 0, 0}, {0.6, 0.53, 0});
  PinSpec pin;
  pin.shape = wall.shape;
  pin.shape.lower = {0, 0.53, 0}, pin.shape.upper = {1, 1, 0};
  pin.motion.translate[1] = "-t";
  wall.elastic.pinned.push_back(pin);
  SolidSpec plate = box(SolidKind::kinematic, {0.2, 0.53 + gap, 0}, {0.8, 0.8, 0});
  plate.motion.translate[1] = motion;
  std::vector<Body<2>> bodies;
  for (const SolidSpec& s : {wall, plate})
    bodies.emplace_back(s, ShapeOptions{0.1, nullptr}, Vec<2>(0, 0), Vec<2>(1, 1));
  return bodies;
}

}  // namespace

TEST_CASE("facets pinned at a solid that moves alike are joined to it", "[elastic][sealed]") {
  const double clearance = 1e-3;
  const auto seams = find_seams(wall_and_plate(5e-4, "-t"), clearance);
  CHECK(seams.size() == 4);  // sides of two quadratic elements
  for (const SeamFacet<2>& facet : seams) CHECK(facet.body == 0);
  CHECK(find_seams(wall_and_plate(2e-3, "-t"), clearance).empty());
  CHECK(find_seams(wall_and_plate(5e-4, "-2*t"), clearance).empty());
}

TEST_CASE("seams leave no slit between an elastic solid and what it stands on", "[elastic][sealed]") {
  Geometry<2> g;
  g.h = 0.1;
  g.cells = {10, 10};
  const Layout<2> layout(g, {IVec<2>::Zero(), g.cells}, 4);
  DomainSpec domain;
  domain.cell_size = 0.1;
  const DomainBoundary<2> sides(domain, WallFlow::slips);
  // The face x = 0.5, 0.5 < y < 0.6 reaches from inside the wall, 0.03 m below its end, into the plate.
  for (const bool joined : {true, false}) {
    const auto bodies = wall_and_plate(5e-4, joined ? "-t" : "-2*t");
    const SolidGeometry<2> solids(layout, sides, bodies);
    std::vector<Placement> placed(2);
    for (std::size_t k : {0, 1}) placed[k].pose = bodies[k].pose(0);
    placed[0].displacement = placed[0].velocity = Eigen::VectorXd::Zero(bodies[0].elastic().body.size());
    const StepGeometry<2> step = solids.measure(placed, 0);
    const Site face = layout.site({5, 5});
    double closed = 0;
    for (const auto& shares : step.shares)
      for (const FaceShare& s : *shares)
        if (s.axis == 0 && s.face == face) closed += s.closed;
    CHECK(closed + step.faces.open.at(0, face) == Approx(1).epsilon(1e-14));
    CHECK((step.faces.open.at(0, face) == 0) == joined);
  }
}

}  // namespace seams_tests
