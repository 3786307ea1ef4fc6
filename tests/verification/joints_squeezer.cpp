// Andrews' squeezing mechanism: seven links in three loops, driven by a torque, against a stiff spring. Masses, places
// and the angles after 0.03 s are those of the test set of Mazzia and Magherini (2008), after Schiehlen's Multibody
// Systems Handbook (1990). Each link lies in a layer of its own, as a cube about its centre of mass.
#include <catch2/catch.hpp>

#include "joint_scenes.h"

namespace joints_squeezer_tests {
using namespace seiche;
using test::hinge, test::joint;

namespace {

// The angles at the start.
constexpr double beta = -0.0617138900142764496, theta = 0, gamma_0 = 0.455279819163070380, phi = 0.222668390165885885,
                 delta = 0.487364979543842550, omega = -0.222668390165885885, epsilon = 1.23054744454982119;
constexpr std::array<double, 7> start{beta, theta, gamma_0, phi, delta, omega, epsilon};

// Lengths of the links and places of their centres of mass, m.
constexpr double d = 28e-3, da = 115e-4, e = 2e-2, ea = 1421e-5, rr = 7e-3, ra = 92e-5, sa = 1874e-5, sb = 1043e-5,
                 sc = 18e-3, sd = 2e-2, ta = 2308e-5, tb = 916e-5, u = 4e-2, ua = 1228e-5, ub = 449e-5, zf = 2e-2,
                 zt = 4e-2, fa = 1421e-5;

// along(a), across(a): unit vectors at the angle a, and a right angle behind.
Vec3 along(double a) {
  return {std::cos(a), std::sin(a), 0};
}

Vec3 across(double a) {
  return {std::sin(a), -std::cos(a), 0};
}

const Vec3 A(-0.06934, -0.00227, 0), B(-0.03635, 0.03273, 0), C(0.014, 0.072, 0);

struct SqueezerLink {
  double mass, inertia;  // kg, kg m^2
  Vec3 center;
};

std::array<SqueezerLink, 7> links() {
  return {{{0.04325, 2.194e-6, ra * along(beta)},
           {0.00365, 4.410e-7, rr * along(beta) - da * along(beta + theta)},
           {0.02373, 5.255e-6, B + sa * across(gamma_0) + sb * along(gamma_0)},
           {0.00706, 5.667e-7, A + zt * along(delta) + (e - ea) * across(phi + delta)},
           {0.07050, 1.169e-5, A + ta * along(delta) - tb * across(delta)},
           {0.00706, 5.667e-7, A + u * across(epsilon) + (zf - fa) * along(omega + epsilon)},
           {0.05498, 1.912e-5, A + ua * across(epsilon) - ub * along(epsilon)}}};
}

void add_links(Scene& s) {
  constexpr double cube = 0.02, layer = 0.023;
  int k = 0;
  for (const SqueezerLink& from : links()) {
    const Vec3 center = from.center + Vec3(0, 0, (k - 3) * layer);
    SolidSpec link = test::rigid_box(fmt::format("k{}", ++k), Vec3::Constant(cube), center, 0);
    link.rigid.mass = from.mass;
    link.rigid.inertia = Vec3(0.6, 0.6, 1) * from.inertia;
    s.solids.push_back(link);
  }
}

// The first seven have the angles.
void add_joints(Scene& s) {
  const Vec3 P = rr * along(beta), F = P - d * along(beta + theta), H = A + zt * along(delta),
             G = A + u * across(epsilon), D = B + sc * across(gamma_0) + sd * along(gamma_0);
  const auto pin = [&](const char* name, const char* first, const char* second, const Vec3& at) {
    s.joints.push_back(hinge(name, first, second, at, Vec3::UnitZ()));
  };
  pin("beta", "k1", "world", {0, 0, 0}), pin("theta", "k2", "k1", P), pin("gamma", "k3", "world", B);
  pin("phi", "k4", "k5", H), pin("delta", "k5", "world", A);
  pin("omega", "k6", "k7", G), pin("epsilon", "k7", "world", A);
  pin("f3", "k3", "k2", F), pin("f4", "k4", "k2", F), pin("f6", "k6", "k2", F);
  JointMotorSpec& motor = s.joints[0].motor.emplace();
  motor.speed = "1e6", motor.torque = 0.033;  // never so fast: a torque
  s.joints.push_back(joint("spring", JointKind::distance, "k3", "world", D));
  s.joints.back().to = C;
  JointSpringSpec& spring = s.joints.back().spring.emplace();
  spring.stiffness = 4530, spring.rest = 0.07785;
}

}  // namespace

TEST_CASE("joints: Andrews' squeezing mechanism ends where its reference does", "[joints][long]") {
  const std::array<double, 7> exact{15.81077119629904,  -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                                    0.5244099658805304, 0.5347301163226948, 1.048080741042263};
  std::array<double, 2> error{};
  for (const int level : {0, 1}) {
    Scene s = test::swing_scene(3, 0.168, 0.014, 0);
    add_links(s);
    add_joints(s);
    s.time.fixed_step = level == 0 ? 2e-5 : 1e-5;
    const auto sim = make_simulation(s, Communicator());
    while (sim->time() < 0.03 * (1 - 1e-12)) (void)sim->step(0.03);
    for (std::size_t k = 0; k < 7; ++k)
      error[level] = std::max(error[level], std::abs(start[k] + sim->joints()[k].q - exact[k]));
  }
  WARN("angles off by " << error[0] << ", " << error[1]);
  CHECK(error[1] <= 1e-4);  // 2.5e-5. The bar is 1e-3
  CHECK(test::order(error[0], error[1]) == Approx(2).margin(0.1));
}

}  // namespace joints_squeezer_tests
