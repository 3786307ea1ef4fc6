#include <catch2/catch.hpp>

#include "fluid/transport/medial_axis.h"
#include "grid/fields.h"
#include "grid/interpolation.h"
#include "grid/loops.h"

namespace medial_axis_tests {
using namespace seiche;

namespace {

// A field on 16 cubes of size 0.5 along each axis, in units of cells.
template <int Dim>
struct Sampled {
  static constexpr double h = 0.5;
  template <class F>
  explicit Sampled(const F& f) : layout(geometry(), geometry().box(), 3), phi(layout) {
    for_each_index(layout, layout.padded(),
                   [&](Site s, const IVec<Dim>& i) { phi[s] = h * f(Vec<Dim>(i.template cast<double>())); });
  }
  static Geometry<Dim> geometry() {
    Geometry<Dim> g;
    g.h = h;
    g.cells = IVec<Dim>::Constant(16);
    return g;
  }
  double one_sided(const Vec<Dim>& g) const { return interpolate_beside_medial_axis<Dim>(layout, phi.data(), g) / h; }
  double cubic(const Vec<Dim>& g) const { return interpolate_cubic<Dim>(layout, phi.data(), g) / h; }
  Layout<Dim> layout;
  CellField<Dim> phi;
};

template <int Dim, class F>
void for_points(const F& f) {
  for (int n = 0; n < 200; ++n) {
    Vec<Dim> g;
    for (int a = 0; a < Dim; ++a) g[a] = 6 + 4 * std::fmod(0.37 * n * (a + 1) + 0.21 * a, 1.0);
    f(g);
  }
}

}  // namespace

// Near its surface, a thread or gap along an axis, linear on both sides, is interpolated exactly for any position of
// its middle. The middle is more than 0.3 cells from the zero, so that it is no corner.
TEMPLATE_TEST_CASE_SIG("a thread or gap along an axis is interpolated without error", "", ((int Dim), Dim), 2, 3) {
  for (const double sign : {1.0, -1.0})
    for (const double middle : {8.0, 8.1, 8.25, 8.5, 8.9}) {
      const auto thread = [&](const Vec<Dim>& g) { return sign * (std::abs(g[1] - middle) - 1.3); };
      const Sampled<Dim> f(thread);
      double most = 0, of_cubic = 0;
      for_points<Dim>([&](const Vec<Dim>& g) {
        if (std::abs(thread(g)) > 0.75) return;
        most = std::max(most, std::abs(f.one_sided(g) - thread(g)));
        of_cubic = std::max(of_cubic, std::abs(f.cubic(g) - thread(g)));
      });
      INFO("middle " << middle << ", cubic " << of_cubic);
      CHECK(of_cubic > 0.05);
      // A kink within 1/8 of a point changes second differences by less than 1/4: it is detected only in part.
      CHECK(most < (std::abs(middle - std::round(middle)) < 0.125 ? 0.02 : 1e-12));
    }
}

TEMPLATE_TEST_CASE_SIG("smooth surfaces are interpolated by the cubic, bit by bit", "", ((int Dim), Dim), 2, 3) {
  const Sampled<Dim> ball([](const Vec<Dim>& g) { return (g - Vec<Dim>::Constant(2)).norm() - 6; });
  for_points<Dim>([&](const Vec<Dim>& g) { CHECK(ball.one_sided(g) == ball.cubic(g)); });
}

// Corners, where medial axes of several directions meet.
TEMPLATE_TEST_CASE_SIG("no axis is preferred at a kink, nor a sign", "", ((int Dim), Dim), 2, 3) {
  const Vec<Dim> n = Vec<Dim>::LinSpaced(0.4, 1).normalized(), middle = Vec<Dim>::LinSpaced(7.7, 8.1);
  const auto corner = [&](const Vec<Dim>& g) {
    const Vec<Dim> x = g - middle;
    return std::max(std::abs(n.dot(x)) - 1.2, x[0] - 0.6 * x[1]);
  };
  const auto turned = [](const Vec<Dim>& g) {  // permutes the axes and mirrors the first
    Vec<Dim> r;
    for (int a = 0; a < Dim; ++a) r[a] = g[(a + 1) % Dim];
    r[0] = 15 - r[0];
    return r;
  };
  const Sampled<Dim> f(corner), other([&](const Vec<Dim>&g) { return corner(turned(g)); }),
      minus([&](const Vec<Dim>&g) { return -corner(g); });
  for_points<Dim>([&](const Vec<Dim>& g) {
    CHECK(other.one_sided(g) == Approx(f.one_sided(turned(g))).margin(1e-13));
    CHECK(minus.one_sided(g) == Approx(-f.one_sided(g)).margin(1e-13));
  });
}

}  // namespace medial_axis_tests
