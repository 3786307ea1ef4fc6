// Wave makers: their theory, and their motions as formulas.
#include <catch2/catch.hpp>

#include "base/expression.h"
#include "base/scene.h"
#include "scene/waves.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace waves_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

std::string paddle(const std::string& waves) {
  return small_scene +
         "[[solid]]\nname = \"paddle\"\nkind = \"kinematic\"\nshape = \"box\"\nlower = [-1, -1, -1]\n"
         "upper = [0.1, 2, 2]\nmotion = { waves = { " +
         waves + " } }\n";
}

double at(const Formula& formula, double t) {
  return Expression(formula)({0, 0, 0}, t);
}

}  // namespace

TEST_CASE("wave numbers fulfil the dispersion relation, in shallow and deep liquid") {
  for (const double kh : {1e-3, 0.1, 1.0, 3.0, 50.0}) {
    const double w = std::sqrt(9.81 * kh / 0.7 * std::tanh(kh));
    CHECK(wave_number(w, 9.81, 0.7) * 0.7 == Approx(kh).epsilon(1e-12));
  }
}

// Limits: a piston in shallow liquid H/S = kh, a flap half of that; in deep liquid 2 for both.
TEST_CASE("height over stroke has the limits of shallow and deep liquid, and the values of its formulas between") {
  CHECK(height_over_stroke("piston", 1e-4) == Approx(1e-4).epsilon(1e-6));
  CHECK(height_over_stroke("flap", 1e-3) == Approx(0.5e-3).epsilon(1e-4));
  CHECK(height_over_stroke("piston", 400) == Approx(2));
  CHECK(height_over_stroke("flap", 4000) == Approx(2).epsilon(1e-3));
  const double kh = 1.3, sum = std::sinh(2 * kh) + 2 * kh;
  CHECK(height_over_stroke("piston", kh) == Approx(2 * (std::cosh(2 * kh) - 1) / sum).epsilon(1e-13));
  CHECK(height_over_stroke("flap", kh) ==
        Approx(4 * std::sinh(kh) / kh * (kh * std::sinh(kh) - std::cosh(kh) + 1) / sum).epsilon(1e-12));
}

TEST_CASE("a piston's motion begins at rest and reaches its stroke after the ramp") {
  const Scene scene = parse(paddle("depth = 1, height = 0.1, period = 2, ramp = 3"));
  const VectorFormula& x = scene.solids[0].motion.translate;
  const double kh = wave_number(M_PI, 9.81, 1), stroke = 0.1 / height_over_stroke("piston", kh);
  CHECK(at(x[0], 0) == 0);
  CHECK(at(x[0], 1.5) == Approx(0.5 * stroke / 2 * std::sin(M_PI * 1.5)));
  CHECK(at(x[0], 4.5) == Approx(stroke / 2));
  CHECK(x[1] == "0");
}

TEST_CASE("a flap turns its top ahead, in 2D about z") {
  const std::string waves = "paddle = \"flap\", depth = 0.5, height = 0.05, period = 1, ramp = 0, hinge = ";
  const Scene solid = parse(paddle(waves + "[0.1, 0.2, 0]"));
  const MotionSpec& motion = solid.solids[0].motion;
  CHECK(motion.center == Vec3(0.1, 0.2, 0));
  const Vec3 top = Eigen::AngleAxisd(at(motion.degrees, 0.25) * M_PI / 180, motion.axis) * Vec3(0, 0.5, 0);
  CHECK(top[0] > 0);
  const double kh = 0.5 * wave_number(2 * M_PI, 9.81, 0.5);
  CHECK(std::tan(at(motion.degrees, 0.25) * M_PI / 180) == Approx(0.05 / height_over_stroke("flap", kh)));
}

TEST_CASE("irregular waves have the given height, and the same phases for the same seed") {
  WavesSpec waves;
  waves.depth = 2;
  waves.height = 0.3;
  waves.period = 3;
  waves.spectrum = "jonswap";
  waves.components = 40;
  const std::vector<PaddleTerm> terms = paddle_terms(waves, 9.81), again = paddle_terms(waves, 9.81);
  double variance = 0;
  for (std::size_t n = 0; n < terms.size(); ++n) {
    const double kh = 2 * wave_number(terms[n].frequency, 9.81, 2);
    variance += std::pow(terms[n].amplitude * height_over_stroke("piston", kh), 2) / 2;
    CHECK(terms[n].phase == again[n].phase);
  }
  CHECK(4 * std::sqrt(variance) == Approx(0.3));
  waves.seed = 2;
  CHECK(paddle_terms(waves, 9.81)[0].phase != terms[0].phase);
  const auto largest = std::ranges::max_element(terms, {}, &PaddleTerm::amplitude);
  CHECK(largest->frequency == Approx(2 * M_PI / 3).epsilon(0.15));  // the peak of the spectrum
}

// Madsen (1971): in shallow liquid the second harmonic is 3 H^2 / (32 h (kh)^3) to leading order.
TEST_CASE("Stokes waves add a second harmonic to a piston") {
  WavesSpec waves;
  waves.depth = 1;
  waves.height = 0.01;
  waves.period = 60;
  waves.theory = "stokes";
  const std::vector<PaddleTerm> terms = paddle_terms(waves, 9.81);
  REQUIRE(terms.size() == 2);
  CHECK(terms[1].frequency == Approx(2 * terms[0].frequency));
  const double kh = wave_number(terms[0].frequency, 9.81, 1);
  CHECK(terms[1].amplitude == Approx(3 * 1e-4 / (32 * kh * kh * kh)).epsilon(0.01));
}

TEST_CASE("wave makers say what does not fit") {
  const std::string regular = "depth = 1, period = 2, height = ";
  CHECK_THROWS_WITH(parse(paddle(regular + "0.9")), Contains("break in 1 m of depth"));
  CHECK_THROWS_WITH(parse(paddle("depth = 5, period = 0.5, height = 0.2")), Contains("their height is at most 0.05"));
  CHECK_THROWS_WITH(parse(paddle(regular + "0.1, paddle = \"flap\"")), Contains("a flap needs its hinge"));
  CHECK_THROWS_WITH(parse(paddle(regular + "0.1, hinge = [0, 0, 0]")), Contains("a piston has no hinge"));
  CHECK_THROWS_WITH(parse(paddle(regular + "0.1, direction = [1, 1, 0]")), Contains("direction must be horizontal"));
  CHECK_THROWS_WITH(parse(paddle(regular + "0.1, theory = \"stokes\", spectrum = \"jonswap\"")),
                    Contains("for regular waves of a piston"));
  CHECK_THROWS_WITH(parse("gravity = [0, 0, 0]\n" + paddle(regular + "0.1")), Contains("waves need gravity"));
  CHECK_THROWS_WITH(parse("gravity = [0, \"-9-t\", 0]\n" + paddle(regular + "0.1")),
                    Contains("gravity that does not change in time"));
  CHECK_THROWS_WITH(parse(paddle("depth = 1, period = 20, height = 0.05, theory = \"stokes\"")),
                    Contains("its second harmonic has 1.9 of the first"));
  const std::string both =
      "[[solid]]\nkind = \"kinematic\"\nshape = \"box\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n"
      "motion = { waves = { depth = 1, period = 2, height = 0.1 }, translate = [\"t\", 0, 0] }\n";
  CHECK_THROWS_WITH(parse(small_scene + both), Contains("leave translate and rotate out"));
}

TEST_CASE("waves at sides are read, and say what does not fit") {
  const auto side = [](const std::string& name, const std::string& more) {
    return small_scene + "[domain.boundary]\n" + name + " = { type = \"waves\", waves = { depth = 0.5, period = 1" +
           more + " } }\n";
  };
  const Scene good = parse(side("x_upper", ", height = 0.05, theory = \"nonlinear\", direction = [-1, 0, 0.5]"));
  const SideSpec& spec = good.domain.sides[0][1];
  CHECK(spec.type == SideType::waves);
  CHECK(spec.waves.absorbs);
  CHECK(spec.waves.towards == Vec3(-1, 0, 0.5));
  const std::string written = write_scene(good);
  CHECK(write_scene(parse(written)) == written);
  CHECK_THROWS_WITH(parse(side("y_lower", ", height = 0.05")), Contains("waves pass upright sides alone"));
  CHECK_THROWS_WITH(parse(side("x_lower", ", height = 0.0, absorbs = false")), Contains("is a wall"));
  CHECK_THROWS_WITH(parse(side("x_lower", ", height = 0.45")), Contains("break in 0.5 m of depth"));
  CHECK_THROWS_WITH(parse(side("x_lower", ", height = 0.05, level = 1.5")),
                    Contains("outside of the domain, 0 to 1 m"));
  const auto long_side = [](const std::string& more) {
    return small_scene + "[domain.boundary]\nx_lower = { type = \"waves\", waves = { depth = 1, level = 0.5, " + more +
           " } }\n";
  };
  CHECK_THROWS_WITH(parse(long_side("height = 0.05, period = 20, theory = \"stokes\"")),
                    Contains("its second harmonic has 1.9 of the first"));
  CHECK_THROWS_WITH(parse(long_side("height = 0.5, period = 10, theory = \"nonlinear\"")),
                    Contains("beyond theory = \"nonlinear\""));
  CHECK_NOTHROW(parse(long_side("height = 0.05, period = 2, theory = \"stokes\"")));
  CHECK_NOTHROW(parse(long_side("height = 0.2, period = 3, theory = \"nonlinear\"")));
  CHECK_THROWS_WITH(parse("gravity = [0, \"-9.81*(1+0.1*sin(t))\", 0]\n" + side("x_lower", ", height = 0.05")),
                    Contains("gravity that does not change in time"));
  CHECK_THROWS_WITH(parse(side("x_lower", ", height = 0.05, direction = [1, 1, 0]")), Contains("must be horizontal"));
  CHECK_THROWS_WITH(parse(side("x_lower", ", height = 0.05, theory = \"stokes\", spectrum = \"jonswap\"")),
                    Contains("is for regular waves"));
  CHECK_THROWS_WITH(parse("gravity = [0, 0, 0]\n" + side("x_lower", ", height = 0.05")),
                    Contains("waves need gravity"));
  CHECK_THROWS_WITH(parse("gravity = [0, -9, 1]\n" + side("x_lower", ", height = 0.05")),
                    Contains("need gravity along an axis"));
  CHECK_THROWS_WITH(parse(side("x_lower", ", height = 0.05") + "[gas]\nbubbles = \"volume_conserving\"\n"),
                    Contains("leave [gas] out"));
  CHECK_NOTHROW(parse(side("x_lower", ", height = 0.05") + "[gas]\ndensity = 1\n"));
  CHECK_THROWS_WITH(parse(side("x_lower", ", height = 0.1, level = 0.75") + "[gas]\ndensity = 1\n"),
                    Contains("crests leave 0.2 m below the closed lid"));
  CHECK_NOTHROW(parse(side("x_lower", ", height = 0.1, level = 0.75")));
}

}  // namespace waves_tests
