#include <catch2/catch.hpp>

#include "base/domain_spec.h"
#include "fluid/viscosity/wall_layer.h"
#include "grid/interpolation.h"
#include "grid/loops.h"

namespace wall_layer_tests {
using namespace seiche;

namespace {

constexpr int n = 12;

template <int Dim>
DomainSpec walls() {
  DomainSpec d;
  d.cell_size = 1.0 / n;
  for (int a = 0; a < Dim; ++a)
    for (SideSpec& side : d.sides[a]) side.type = SideType::no_slip;
  return d;
}

template <int Dim>
struct Box1 {
  static Geometry<Dim> geometry() {
    Geometry<Dim> g;
    g.h = 1.0 / n;
    g.cells = IVec<Dim>::Constant(n);
    return g;
  }
  Layout<Dim> layout{geometry(), geometry().box(), 4};
  DomainBoundary<Dim> sides{walls<Dim>(), WallFlow::sticks};

  template <class F>
  FaceField<Dim> faces(const F& f) const {
    FaceField<Dim> r(layout);
    for (int a = 0; a < Dim; ++a)
      for_each_index(layout, layout.padded(), [&](Site s, const IVec<Dim>& i) {
        r.at(a, s) = f(a, Vec<Dim>(layout.position(i, face_offset<Dim>(a))));
      });
    return r;
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("six points interpolate polynomials of degree 5 exactly", "", ((int Dim), Dim), 2, 3) {
  const Box1<Dim> box;
  const auto f = [](int, const Vec<Dim>& x) { return std::pow(x[0] - 0.2, 5) + 3 * x[0] * std::pow(x[Dim - 1], 4); };
  const FaceField<Dim> u = box.faces(f);
  for (const double shift : {0.0, 0.017, 0.31, 0.502}) {
    const Vec<Dim> x = Vec<Dim>::Constant(0.21 + shift);
    const Vec<Dim> g = index_coordinates<Dim>(box.layout, x, face_offset<Dim>(0));
    CHECK(interpolate_quintic<Dim>(box.layout, u[0].data(), g) == Approx(f(0, x)).margin(1e-13));
  }
}

TEMPLATE_TEST_CASE_SIG("parabolas go on beyond walls, as points and as means", "", ((int Dim), Dim), 2, 3) {
  const Box1<Dim> box;
  const double h = box.layout.h();
  for (const FaceValues values : {FaceValues::points, FaceValues::means}) {
    // Component 0 along the lower wall of axis 1: y - y^2. Its mean over a layer has h^2/12 more of y^2.
    const double more = values == FaceValues::means ? -h * h / 12 : 0;
    const auto f = [&](int a, const Vec<Dim>& x) {
      return a == 0 ? x[1] - x[1] * x[1] + more : a == 1 ? x[1] * x[1] : 0.0;
    };
    const FaceField<Dim> exact = box.faces(f);
    FaceField<Dim> u = exact;
    continue_beyond_walls(box.layout, box.sides, 0, values, u);
    IVec<Dim> i = IVec<Dim>::Constant(n / 2);
    for (int k = 1; k <= 3; ++k) {
      i[1] = -k;
      const Site s = box.layout.site(i);
      CHECK(u.at(0, s) == Approx(exact.at(0, s)).margin(1e-13));
      CHECK(u.at(1, s) == Approx(exact.at(1, s)).margin(1e-13));  // even continuation
    }
  }
}

// y - 3 y^2 at y = (k - 1/2)/12: beyond the first layer the even part is limited to the odd part.
TEST_CASE("farther out than the first layer a parabola is no steeper than its odd part twice") {
  const Box1<2> box;
  const auto f = [](int a, const Vec<2>& x) { return a == 0 ? x[1] - 3 * x[1] * x[1] : 0.0; };
  FaceField<2> u = box.faces(f);
  continue_beyond_walls(box.layout, box.sides, 0, FaceValues::points, u);
  const auto at = [&](int j) { return u.at(0, box.layout.site({n / 2, j})); };
  CHECK(at(-1) == Approx(-at(0) - 6.0 / (24 * 24)));
  CHECK(at(-2) == Approx(-2 * at(1)));
  CHECK(at(-3) == Approx(-2 * at(2)));
}

TEMPLATE_TEST_CASE_SIG("the Laplacian is whole to fourth order, next to walls for parabolas", "", ((int Dim), Dim), 2,
                       3) {
  const Box1<Dim> box;
  const double h = box.layout.h();
  const auto second_difference = [&](const FaceField<Dim>& u, Site s, int b) {
    const Site d = box.layout.stride(b);
    return u.at(0, s - d) - 2 * u.at(0, s) + u.at(0, s + d);
  };
  // x^4 at points: u'' = 12 x^2.
  const FaceField<Dim> quartic = box.faces([](int, const Vec<Dim>& x) { return std::pow(x[0], 4); });
  const IVec<Dim> middle = IVec<Dim>::Constant(n / 2);
  const Site m = box.layout.site(middle);
  const double lacking = missing_laplacian(box.layout, box.sides, quartic, 0, m, middle);
  CHECK((second_difference(quartic, m, 0) + lacking) / (h * h) == Approx(12 * 0.25));
  // Means of y - 3 y^2. The operator's link to the wall is 2 u0.
  const auto along = [&](int, const Vec<Dim>& x) { return x[1] - 3 * x[1] * x[1] - 3 * h * h / 12; };
  FaceField<Dim> u = box.faces(along);
  continue_beyond_walls(box.layout, box.sides, 0, FaceValues::means, u);
  IVec<Dim> first = middle;
  first[1] = 0;
  const Site s = box.layout.site(first), up = s + box.layout.stride(1);
  const double plain = u.at(0, up) - 3 * u.at(0, s);
  CHECK((plain + missing_laplacian(box.layout, box.sides, u, 0, s, first)) / (h * h) == Approx(-6));
}

TEST_CASE("means and points of a face differ by what its second differences say; openings are kept away from") {
  const Box1<2> box;
  const FaceField<2> u = box.faces([](int, const Vec<2>& x) { return 5 * x[1] * x[1]; });
  const double h = box.layout.h();
  CHECK(excess_of_mean(box.layout, u, 0, box.layout.site({5, 5})) == Approx(5 * h * h / 12));
  CHECK(excess_of_mean(box.layout, u, 1, box.layout.site({5, 5})) == Approx(0).margin(1e-15));  // no tangential change
  DomainSpec channel = walls<2>();
  channel.sides[0][0].type = SideType::inflow;
  const FaceField<2, char> valid(box.layout, 1);
  const FaceField<2, char> whole = whole_faces(box.layout, DomainBoundary<2>(channel, WallFlow::sticks), valid);
  CHECK(whole.at(0, box.layout.site({2, 5})) == 0);
  CHECK(whole.at(0, box.layout.site({3, 5})) == 1);
  CHECK(whole.at(0, box.layout.site({5, 0})) == 1);
}

}  // namespace wall_layer_tests
