// Momentum exchange of one projection between liquid, elastic and rigid bodies, static solids and walls, on random
// scenes.
#include "base/scene.h"
#include "exchange.h"

namespace elastic_exchange_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

// One solid in each quarter of the domain, so that nothing touches: a static ball, an elastic ball and box, a rigid
// box.
SolidSpec random_solid(Dice& dice, int dim, int number) {
  SolidSpec s;
  s.name = fmt::format("solid{}", number);
  s.kind = number == 0 ? SolidKind::fixed : number == 3 ? SolidKind::rigid : SolidKind::elastic;
  s.shape.where = "test";
  s.shape.kind = number < 2 ? "sphere" : "box";
  s.shape.radius = dice(0.1, 0.18);
  s.shape.upper = dice.vector(dim, 0.07, dim == 2 ? 0.13 : 0.1);
  s.shape.lower = -s.shape.upper;
  s.shape.transform.translate =
      Vec3(0.26 + 0.48 * (number % 2), 0.26 + 0.48 * (number / 2), dim == 2 ? 0 : 0.5) + dice.vector(dim, -0.02, 0.02);
  s.shape.transform.rotate = {dim == 2 ? Vec3(0, 0, 1) : Vec3(dice.vector(3, 0.1, 1)), dice(0, 90)};
  s.rigid.density = std::pow(10, dice(1, 5));
  s.rigid.velocity = dice.vector(dim, -1, 1);
  s.elastic.youngs_modulus = std::pow(10, dice(3, 7));
  s.elastic.poisson_ratio = dice(0, 0.49);
  s.elastic.element_size = dim == 2 ? 0.08 : 0.16;
  return s;
}

Scene random_scene(int dim, Filling filling, int seed) {
  Scene s = box_scene(dim, dim == 2 ? 19 : 11);
  Dice dice{std::mt19937(unsigned(seed))};
  s.gravity = dice.vector(dim, -10, 10);
  for (int k = 0; k < 4; ++k) s.solids.push_back(random_solid(dice, dim, k));
  if (filling == Filling::outflow) s.domain.sides[0][1] = {SideType::outflow, {"0", "0", "0"}, "300"};
  return s;
}

constexpr double of_an_element = 5e-4;  // m: a hundredth of an element

}  // namespace

TEST_CASE("the flux elastic bodies push and the force the pressure exerts on them are transposes", "[elastic]") {
  double worst = 0;
  for_random_projections(random_scene, of_an_element, [&](auto p) { worst = std::max(worst, adjointness_error(p)); });
  WARN("<p, J v> against <J'p, v>: " << worst << ", bar 1e-12");
  CHECK(worst <= 1e-12);
}

TEST_CASE("linear momentum of liquid and elastic bodies changes by gravity and by what walls and solids give",
          "[elastic]") {
  double worst = 0;
  for_random_projections(random_scene, of_an_element, [&](auto p) {
    p.solve();
    worst = std::max(worst, Balance(p).error(&Momentum::linear));
  });
  WARN("imbalance over the largest term: " << worst << ", bar 1e-11");
  CHECK(worst <= 1e-11);
}

}  // namespace elastic_exchange_tests
