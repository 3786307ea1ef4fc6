// Paths of semi-Lagrangian transport in a flow with known paths.
#include <catch2/catch.hpp>
#include <cmath>

#include "fluid/transport/advection.h"
#include "grid/loops.h"

namespace trace_tests {
using namespace seiche;

TEST_CASE("in a turning flow paths are off by the third and fourth power of the angle") {
  Geometry<2> g;
  g.h = 0.1;
  g.cells = IVec<2>(40, 40);
  const Layout<2> layout(g, g.box(), 4);
  FaceField<2> u(layout);  // rotates about (2, 2) at 1 rad/s
  for (int a = 0; a < 2; ++a)
    for_each_index(layout, layout.padded(), [&](Site s, const IVec<2>& i) {
      const Vec<2> x = layout.position(i, face_offset<2>(a));
      u.at(a, s) = a == 0 ? 2 - x[1] : x[0] - 2;
    });
  const Vec<2> x(2.7, 2), at_x(0, 0.7);
  const auto miss = [&](double angle, const Vec<2>& from) {
    return (from - Vec<2>(2 + 0.7 * std::cos(angle), 2 - 0.7 * std::sin(angle))).norm() / 0.7;
  };
  for (const double angle : {0.05, 0.1, 0.2}) {
    // Linear fields are sampled exactly; the error is the next terms of the series of sine and cosine.
    CHECK(miss(angle, trace_midpoint<2>(layout, u, at_x, x, angle)) == Approx(std::pow(angle, 3) / 6).epsilon(0.02));
    CHECK(miss(angle, trace_third_order<2>(layout, u, at_x, x, angle)) ==
          Approx(std::pow(angle, 4) / 24).epsilon(0.02));
  }
}

}  // namespace trace_tests
