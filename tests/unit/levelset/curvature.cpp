// Curvature at crossings of circles, spheres and ellipses, for exact distances and others.
#include <catch2/catch.hpp>

#include "grid/loops.h"
#include "levelset/curvature.h"

namespace curvature_tests {
using namespace seiche;

namespace {

template <int Dim>
Layout<Dim> unit_cube(int n) {
  Geometry<Dim> g;
  g.h = 1.0 / n;
  g.cells = IVec<Dim>::Constant(n);
  return Layout<Dim>(g, g.box(), 4);
}

struct Errors {
  double largest = 0;  // relative
  int crossings = 0, by_differences = 0;
};

// phi(x) on the grid; kappa(x), exact near phi = 0.
template <int Dim, class Phi, class Kappa>
Errors measure(int n, const Phi& level, const Kappa& kappa) {
  const Layout<Dim> layout = unit_cube<Dim>(n);
  CellField<Dim> phi(layout);
  for_each_index(layout, layout.padded(),
                 [&](Site s, const IVec<Dim>& i) { phi[s] = level(Vec<Dim>(layout.position(i, cell_offset<Dim>()))); });
  Errors e;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      const Site low = f - layout.stride(a);
      if ((phi[low] < 0) == (phi[f] < 0)) return;
      Vec<Dim> x = layout.position(i, cell_offset<Dim>());
      x[a] -= layout.h() * phi[f] / (phi[f] - phi[low]);
      const SurfaceCurvature found = curvature_at_crossing<Dim>(layout, phi, a, f);
      e.largest = std::max(e.largest, std::abs(found.value / kappa(x) - 1));
      ++e.crossings;
      e.by_differences += found.source == CurvatureSource::differences;
    });
  return e;
}

template <int Dim>
Errors ball(int n, double diameter) {
  const Vec<Dim> c = Vec<Dim>::LinSpaced(0.503, 0.517);
  return measure<Dim>(
      n, [&](const Vec<Dim>& x) { return (x - c).norm() - diameter / 2; },
      [&](const Vec<Dim>&) { return (Dim - 1) * 2 / diameter; });
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "curvature of circles and spheres: order 2, 3.1e-3 and 2.1e-4 at 25.6 and 102.4 cells a diameter", "",
    ((int Dim), Dim), 2, 3) {
  const int finest = Dim == 2 ? 128 : 64;
  Errors last;
  for (int n = 16; n <= finest; n *= 2) {
    const Errors e = ball<Dim>(n, 0.8);
    INFO(n << " cells, error " << e.largest << ", before " << last.largest << "; " << e.by_differences << " of "
           << e.crossings << " by differences");
    CHECK(e.by_differences == 0);
    // Errors of volume-fraction heights (Basilisk, spurious.c, 25.6 and 102.4 cells per diameter).
    if (n == 32) CHECK(e.largest < 3.1e-3);
    if (n == 128) CHECK(e.largest < 2.1e-4);
    if (n > 16) CHECK(std::log2(last.largest / e.largest) > 1.9);
    last = e;
  }
  CHECK(last.largest < 1);
}

TEST_CASE("curvature of an ellipse whose phi is no distance: order 2") {
  const double a = 0.4, b = 0.25;
  Errors first, last;
  for (int n : {32, 64, 128, 256}) {
    const Errors e = measure<2>(
        n,
        [&](const Vec<2>& x) {
          const double p = (x[0] - 0.51) / a, q = (x[1] - 0.5) / b;
          return 0.5 * (p * p + q * q - 1) * std::min(a, b);
        },
        [&](const Vec<2>& x) {
          const double p = (x[0] - 0.51) / (a * a), q = (x[1] - 0.5) / (b * b);
          return 1 / (a * a * b * b * std::pow(p * p + q * q, 1.5));
        });
    INFO(n << " cells, error " << e.largest << ", before " << last.largest << "; " << e.by_differences << " of "
           << e.crossings << " by differences");
    CHECK(e.by_differences == 0);
    if (n == 32) first = e;
    last = e;
  }
  // Order over all three halvings: the position of the largest error on the ellipse changes from grid to grid.
  CHECK(std::log2(first.largest / last.largest) / 3 > 1.9);
}

TEMPLATE_TEST_CASE_SIG(
    "curvature: planes have none, bubbles that of drops with the sign turned, tiny drops at most 1/h", "",
    ((int Dim), Dim), 2, 3) {
  const Vec<Dim> n = Vec<Dim>::LinSpaced(1, 1.7).normalized(), c = Vec<Dim>::Constant(0.5);
  const auto plane = measure<Dim>(
      16, [&](const Vec<Dim>& x) { return (x - c).dot(n); }, [](const Vec<Dim>&) { return 1.0; });
  CHECK(plane.largest == Approx(1).margin(1e-10));  // |kappa| is rounding: 1e-16 |phi|/h^2
  const auto bubble = measure<Dim>(
      32, [&](const Vec<Dim>& x) { return 0.3 - (x - c).norm(); }, [](const Vec<Dim>&) { return -(Dim - 1) / 0.3; });
  CHECK(bubble.largest < 1e-2);
  const auto tiny = measure<Dim>(
      16, [&](const Vec<Dim>& x) { return (x - c).norm() - 0.06; }, [](const Vec<Dim>&) { return (Dim - 1) * 16.0; });
  CHECK(tiny.crossings > 0);
  CHECK(tiny.largest <= 2);  // |kappa| <= (Dim - 1)/h
}

}  // namespace curvature_tests
