// Spinning bodies on ball joints, against elliptic functions.
#include <catch2/catch.hpp>

#include <cmath>

#include "coupling/state/attempt.h"
#include "coupling/step/initial_state.h"
#include "coupling/step/step.h"
#include "joint_scenes.h"

namespace joints_spinning_tests {
using namespace seiche;
using test::joint, test::pi;

namespace {

// Calls look(time, rigid state) after each step of the scene's first solid.
template <class Look>
void spin(const Scene& s, int steps, const Look& look) {
  const Setup<3> setup(s, Communicator());
  State<3> state = initial_state(setup);
  Phases phases;
  for (int n = 0; n < steps; ++n) {
    Attempt<3> attempt = attempt_step(setup, state, *s.time.fixed_step, phases);
    REQUIRE(attempt.failure.empty());
    state = std::move(attempt.state);
    look(state.time, *state.solids[0].rigid(), state.solids[0].body());
  }
}

// A box that spins about its middle axis, on a ball joint at its centre.
Scene tumbling_box(double dt) {
  Scene s = test::swing_scene(3, 0.5, 0.1, 0);
  s.solids = {test::rigid_box("box", {0.4, 0.3, 0.2}, Vec3::Zero(), 500)};
  s.solids[0].rigid.angular_velocity = Vec3(1, 10, 0.6);
  s.joints = {joint("ball", JointKind::ball, "box", "world", Vec3::Zero())};
  s.time.fixed_step = dt;
  return s;
}

// Time between two flips: 2 K(k)/lambda for moments I1 < I2 < I3, energy E and angular momentum L, with
//   lambda^2 = (I3 - I2)(L^2 - 2 E I1)/(I1 I2 I3),  k^2 = (I2 - I1)(2 E I3 - L^2)/((I3 - I2)(L^2 - 2 E I1))
// if L^2 > 2 E I2, else with I1 and I3 exchanged.
double time_between_flips(Vec3 I, const Vec3& omega) {
  const double energy = omega.dot(I.cwiseProduct(omega)), square = I.cwiseProduct(omega).squaredNorm();  // 2 E, L^2
  if (square < energy * I[1]) std::swap(I[0], I[2]);
  const double speed = (I[2] - I[1]) * (square - energy * I[0]);
  const double k = std::sqrt((I[1] - I[0]) * (energy * I[2] - square) / speed);
  return 2 * std::comp_ellint_1(k) / std::sqrt(std::abs(speed / I.prod()));
}

}  // namespace

// The intermediate axis theorem, as of Dzhanibekov's nut.
TEST_CASE("joints: a box on a ball joint flips as elliptic functions say, its angular momentum stays", "[joints]") {
  std::array<double, 2> error{};
  for (const int level : {0, 1}) {
    const Scene s = tumbling_box(level == 0 ? 0.01 : 0.005);
    test::Crossings flips;
    Vec3 start = Vec3::Zero(), moments = Vec3::Zero();
    double worst = 0;
    spin(s, level == 0 ? 900 : 1800, [&](double t, const RigidState& r, const Body<3>& body) {
      if (start.isZero(0))
        moments = body.mass().inertia.diagonal(), start = moments.cwiseProduct(s.solids[0].rigid.angular_velocity);
      worst = std::max(worst, (r.angular_momentum - start).norm() / start.norm());
      flips.add(t, (r.rotation.transpose() * r.angular_momentum)[1]);
      CHECK(r.center.norm() <= 1e-10);
    });
    REQUIRE(flips.times.size() >= 3);
    const double exact = time_between_flips(moments, s.solids[0].rigid.angular_velocity);
    error[level] = (flips.times[2] - flips.times[0]) / 2 / exact - 1;
    WARN("flips every " << exact << " s, off by " << error[level] << "; angular momentum by " << worst);
    CHECK(worst <= 1e-12);  // 9e-15
  }
  CHECK(std::abs(error[0]) <= 1e-3);  // -3.8e-4; the body's free rotation
  CHECK(std::abs(error[1]) <= 3e-4);  // -9.6e-5
}

// Heavy symmetric top with its lowest point held. u is the cosine of its tilt, from rest at u0, spin w:
//   u'^2 = beta (u0 - u)(1 - u^2 - 2 lambda (u0 - u)),  phi' = b (u0 - u)/(1 - u^2),
// with b = I3 w/I1, beta = 2 m g l/I1, lambda = b^2/(2 beta). It nods in the time 2 K(k) 2/sqrt(beta (u3 - u1)).
struct Top {
  double side = 0.3, g = 9.81, tilt = 60 * pi / 180, w = 30;
  double I1 = 0, I3 = 0, b = 0, beta = 0, u0 = 0, u1 = 0, u3 = 0;  // moments a mass; about the held point

  Top() {
    const double l = side / 2;
    I3 = side * side / 6, I1 = I3 + l * l;
    b = I3 * w / I1, beta = 2 * g * l / I1, u0 = std::cos(tilt);
    const double lambda = b * b / (2 * beta), root = std::sqrt(lambda * lambda - 2 * lambda * u0 + 1);
    u1 = lambda - root, u3 = lambda + root;
  }
  double period() const {
    return 4 * std::comp_ellint_1(std::sqrt((u0 - u1) / (u3 - u1))) / std::sqrt(beta * (u3 - u1));
  }
  // Precession in half of that: u = u1 + (u0 - u1) sin^2(x), by the trapezoid rule of a periodic function.
  double half_precession() const {
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double x = pi / 2 * (i + 0.5) / n, u = u1 + (u0 - u1) * std::pow(std::sin(x), 2);
      sum += b * (u0 - u) / (1 - u * u) * 2 / std::sqrt(beta * (u3 - u));
    }
    return sum * pi / 2 / n;
  }
  // Direction of its axis after half a nod, in axes with z upwards and the start in the plane of x and z.
  Vec3 axis_after(int halves) const {
    const double u = halves % 2 == 0 ? u0 : u1, phi = halves * half_precession(), s = std::sqrt(1 - u * u);
    return {s * std::cos(phi), s * std::sin(phi), u};
  }
};

// Gravity is tilted in place of the top, which stands along z. Steps: in half a nod.
double error_of_top(const Top& top, int steps, int halves) {
  Scene s = test::swing_scene(3, 0.6, 0.1, 0);
  s.solids = {test::rigid_box("top", Vec3::Constant(top.side), {0, 0, top.side / 2}, 500)};
  s.solids[0].rigid.angular_velocity = Vec3(0, 0, top.w);
  s.joints = {joint("ball", JointKind::ball, "top", "world", Vec3::Zero())};
  const Vec3 up(-std::sin(top.tilt), 0, std::cos(top.tilt)), forward(std::cos(top.tilt), 0, std::sin(top.tilt));
  s.gravity = Vec3(-top.g * up);
  s.time.fixed_step = top.period() / 2 / steps;
  double worst = 0;
  int count = 0;
  spin(s, steps * halves, [&](double, const RigidState& r, const Body<3>&) {
    if (++count % steps != 0) return;
    const Vec3 z = not_shown(r).center.normalized(), seen(z.dot(forward), z[1], z.dot(up));
    worst = std::max(worst, (seen - top.axis_after(count / steps)).norm());
  });
  return worst;
}

TEST_CASE("joints: a heavy top nods and precesses as elliptic integrals say", "[joints]") {
  const Top top;
  const double coarse = error_of_top(top, 40, 4), fine = error_of_top(top, 80, 4);
  WARN("nods in " << top.period() << " s, precesses by " << 2 * top.half_precession() << "; axis off by " << coarse
                  << ", " << fine);
  CHECK(coarse <= 1e-3);  // 3.4e-4
  CHECK(test::order(coarse, fine) >= 1.8);
}

}  // namespace joints_spinning_tests
