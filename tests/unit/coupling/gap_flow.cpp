#include "coupling/thin/gap_flow.h"

#include <catch2/catch.hpp>

#include "coupling/state/setup.h"
#include "verification/scenes.h"

using namespace seiche;

namespace gap_flow_tests {
namespace {

constexpr double dt = 0.01, fall = -9.81;

// A box of 8 cells with one face across y of which a tenth is open. The last solve had `solved` (m/s) there.
template <int Dim>
struct OneNarrowFace {
  explicit OneNarrowFace(double solved) : gap_flow(layout) {
    IVec<Dim> i = IVec<Dim>::Constant(4);
    face = layout.site(i);
    faces.open.set(1, face, 0.1);
    gap_flow.open.set(1, face, 0.1);
    gap_flow.u.set(1, face, solved);
  }

  Setup<Dim> setup{test::box_scene(Dim, 8), Communicator()};
  const Layout<Dim>& layout = setup.domain.layout;
  FaceGeometry<Dim> faces{layout};
  GapFlow<Dim> gap_flow;
  Site face = 0;
};

// Velocity on the face before the pressure acts, m/s, where transport found `transported` there.
template <int Dim>
double velocity_before_pressure(double solved, double transported, bool wanted = true) {
  const OneNarrowFace<Dim> box(solved);
  FaceField<Dim> u(box.layout);
  u.at(1, box.face) = transported + dt * fall;
  keep_inertia_in_gaps<Dim>(
      box.setup.domain, box.faces, box.gap_flow, [&](int, Site) { return wanted; }, Vec3(0, fall, 0), dt, u);
  return u.at(1, box.face) - dt * fall;
}

// Velocity of the surface on the face, m/s, where it was `extrapolated`.
template <int Dim>
double velocity_of_surface(double solved, double extrapolated, bool at_surface) {
  const OneNarrowFace<Dim> box(solved);
  FaceField<Dim> u(box.layout);
  u.at(1, box.face) = extrapolated;
  CellField<Dim> phi(box.layout);
  for (Site s = 0; s < box.layout.size(); ++s) phi[s] = at_surface && s >= box.face ? 0.1 : -0.1;
  let_surface_through_gaps(box.setup.domain, box.gap_flow, phi, FaceField<Dim, char>(box.layout), dt, u);
  return u.at(1, box.face);
}

template <int Dim>
void check_narrow_face() {
  const double slow = 1e-3, fast = 2;  // 8e-5 and 0.16 cells a step
  CHECK(velocity_before_pressure<Dim>(slow, 3 * slow) == Approx(slow).epsilon(1e-12));
  CHECK(velocity_before_pressure<Dim>(slow, fast) == Approx(fast).epsilon(1e-12));
  CHECK(velocity_before_pressure<Dim>(0, slow) == Approx(slow).epsilon(1e-12));  // was not solved for
  CHECK(velocity_before_pressure<Dim>(slow, 3 * slow, false) == Approx(3 * slow).epsilon(1e-12));
  CHECK(velocity_of_surface<Dim>(slow, 3 * slow, true) == Approx(slow / 2).epsilon(1e-12));
  CHECK(velocity_of_surface<Dim>(slow, fast, true) == fast);
  CHECK(velocity_of_surface<Dim>(slow, 3 * slow, false) == 3 * slow);
}

TEST_CASE("slow flow through a narrow face keeps its own velocity, and the surface follows it") {
  check_narrow_face<2>();
  check_narrow_face<3>();
}

}  // namespace
}  // namespace gap_flow_tests
