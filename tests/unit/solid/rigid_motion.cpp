// Rotations and torque-free motion.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

#include "solid/rigid/motion.h"

namespace rigid_motion_tests {
using namespace seiche;
using Matrix = Eigen::Matrix3d;

namespace {

constexpr double round_off = 4e-15;  // a few roundings of entries about 1
constexpr double pi = 3.14159265358979323846;

double orthogonality(const Matrix& r) {
  return (r * r.transpose() - Matrix::Identity()).cwiseAbs().maxCoeff();
}

double energy(const PrincipalInertia& inertia, const Matrix& r, const Vec3& l) {
  return 0.5 * l.dot(angular_velocity(inertia, r, l));
}

Vec3 random_vector(std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return {normal(generator), normal(generator), normal(generator)};
}

// A body whose principal axes are rotated against the world's axes.
PrincipalInertia body(const Vec3& moments) {
  const Matrix axes = exp_rotation(Vec3(0.3, -0.5, 0.7));
  return principal_inertia(axes * moments.asDiagonal() * axes.transpose());
}

}  // namespace

TEST_CASE("exp and log of rotations are inverse to each other from zero to pi") {
  std::mt19937 generator(3);
  for (const double angle : {0.0, 1e-300, 1e-20, 1e-9, 1e-5, 1e-3, 0.5, 2.0, 3.1, pi - 1e-6, pi - 1e-9}) {
    for (int i = 0; i < 20; ++i) {
      const Vec3 w = angle * random_vector(generator).normalized();
      const Matrix r = exp_rotation(w);
      INFO(angle);
      CHECK(orthogonality(r) < round_off);
      CHECK(r.determinant() > 0);
      CHECK((log_rotation(r) - w).norm() < 1e-15 + 1e-14 * angle);
    }
  }
  for (int a = 0; a < 3; ++a) {  // exactly pi: both signs are right
    const Vec3 w = pi * Vec3::Unit(a);
    CHECK((log_rotation(exp_rotation(w)).cwiseAbs() - w).norm() < 1e-14);
  }
  CHECK(exp_rotation(Vec3(0, 0, pi / 2)).col(0).isApprox(Vec3::UnitY()));
}

TEST_CASE("principal axes diagonalise the inertia and are right-handed") {
  const PrincipalInertia p = body(Vec3(3, 1, 2));
  CHECK((p.moments - Vec3(1, 2, 3)).norm() < 1e-14);
  CHECK(p.axes.determinant() == Approx(1));
  CHECK(principal_inertia(Matrix::Zero()).inverse_moments() == Vec3::Zero());
  CHECK(body(Vec3(1, 1, 1e-15)).inverse_moments()[0] == 0);
}

TEST_CASE("the mean angular velocity leads from the start to the end") {
  std::mt19937 generator(5);
  for (const Vec3& moments : {Vec3(1, 2, 3), Vec3(1, 1, 1), Vec3(2, 2, 3), Vec3(0, 0, 2), Vec3(0, 1, 1)}) {
    for (const double dt : {1e-9, 0.01, 0.3, 1.0, 20.0}) {
      const PrincipalInertia inertia = body(moments);
      const Matrix r = exp_rotation(random_vector(generator));
      const FreeRotation end = rotate_freely(inertia, r, random_vector(generator), dt);
      INFO(moments.transpose() << ", dt " << dt);
      CHECK(orthogonality(end.rotation) < round_off);
      CHECK((exp_rotation(dt * end.mean_angular_velocity) * r - end.rotation).norm() < 1e-13);
    }
  }
}

TEST_CASE("a ball turns at l / I whatever the step, whole turns included") {
  const PrincipalInertia inertia = principal_inertia(0.4 * Matrix::Identity());
  const Vec3 l(0.1, -0.2, 0.3);
  for (const double dt : {0.001, 1.0, 10.0, 100.0}) {
    const FreeRotation end = rotate_freely(inertia, Matrix::Identity(), l, dt);
    CHECK((end.mean_angular_velocity - l / 0.4).norm() < 1e-12);
  }
}

// The axis of a symmetric top precesses about l at |l| / b.
TEST_CASE("a symmetric top precesses exactly in one step") {
  const PrincipalInertia inertia = principal_inertia(Vec3(2, 2, 3).asDiagonal());
  const Vec3 l(0.5, 0, 1.5);
  for (const double dt : {0.1, 1.0, 7.0}) {
    const Matrix r = rotate_freely(inertia, Matrix::Identity(), l, dt).rotation;
    CHECK((r.col(2) - exp_rotation(dt / 2 * l) * Vec3::UnitZ()).norm() < 1e-14);
  }
}

TEST_CASE("a 2D body turns about z") {
  Matrix inertia = Matrix::Zero();
  inertia(2, 2) = 0.5;
  const FreeRotation end = rotate_freely(principal_inertia(inertia), exp_rotation(Vec3(0, 0, 1)), Vec3(0, 0, 2), 0.25);
  CHECK((end.mean_angular_velocity - Vec3(0, 0, 4)).norm() < 1e-14);
  CHECK((log_rotation(end.rotation) - Vec3(0, 0, 2)).norm() < 1e-14);
}

TEST_CASE("bodies without inertia stay, thin rods have no spin, and nothing is NaN") {
  const Vec3 l(1, 2, 3);
  const Matrix r = exp_rotation(Vec3(1, 2, 0));
  const FreeRotation still = rotate_freely(principal_inertia(Matrix::Zero()), r, l, 1);
  CHECK((still.rotation - r).norm() < round_off);
  CHECK(still.mean_angular_velocity == Vec3::Zero());
  for (const double thin : {0.0, 1e-17, 1e-11, 1e-6, 1e-3}) {
    const PrincipalInertia rod = body(Vec3(thin, 1, 1));
    const Vec3 across = rod.axes.col(2).cross(rod.axes.col(0)).normalized();
    const FreeRotation end = rotate_freely(rod, Matrix::Identity(), across, 0.5);
    CHECK((end.rotation - exp_rotation(0.5 * across)).norm() < 1e-4);  // 1e-16 of spin / 1e-11
  }
  CHECK(rotate_freely(body(Vec3(1, 2, 3)), r, Vec3::Zero(), 1).mean_angular_velocity == Vec3::Zero());
  CHECK((rotate_freely(body(Vec3(1, 2, 3)), r, l, 0).rotation - r).norm() < round_off);
  CHECK(rotate_freely(body(Vec3(1e-9, 2, 3)), r, 1e6 * l, 1e3).rotation.allFinite());
}

TEST_CASE("the free motion is of second order at least in the step, and reversible") {
  const PrincipalInertia inertia = body(Vec3(1, 2, 3));
  const Vec3 l(1, 1.5, 1);
  const auto run = [&](double step) {
    Matrix r = Matrix::Identity();
    for (int i = 0; i < int(std::round(2 / step)); ++i) r = rotate_freely(inertia, r, l, step).rotation;
    return r;
  };
  const Matrix fine = run(1.0 / 1024);
  const double coarse_error = (run(1.0 / 16) - fine).norm(), error = (run(1.0 / 32) - fine).norm();
  CHECK(coarse_error / error > 3.5);
  CHECK(error < 1e-3);
  const FreeRotation there = rotate_freely(inertia, Matrix::Identity(), l, 0.3);
  CHECK((rotate_freely(inertia, there.rotation, l, -0.3).rotation - Matrix::Identity()).norm() < 1e-13);
}

// Dzhanibekov effect: rotation about the middle axis is unstable, and the body flips repeatedly; energy and |l| stay.
TEST_CASE("a body spinning about its middle axis turns over and keeps its energy for 100 turns") {
  const PrincipalInertia inertia = principal_inertia(Vec3(1, 2, 3).asDiagonal());
  const Vec3 l(1e-3, 2, 1e-3);  // 1 rad/s about the middle axis, perturbed
  for (const double angle : {0.01, 0.1, 0.5, 1.0}) {
    Matrix r = Matrix::Identity();
    const double before = energy(inertia, r, l);
    double drift = 0, defect = 0, last = 1;
    int flips = 0;
    for (int i = 0; i < int(200 * pi / angle); ++i) {
      r = rotate_freely(inertia, r, l, angle).rotation;
      drift = std::max(drift, std::abs(energy(inertia, r, l) / before - 1));
      defect = std::max(defect, orthogonality(r));
      const double upright = r.col(1)[1];
      flips += std::abs(upright) > 0.9 && upright * last < 0;
      if (std::abs(upright) > 0.9) last = upright;
    }
    INFO("step " << angle << " rad: energy drift " << drift << ", flips " << flips << ", orthogonality " << defect);
    CHECK(drift < 1e-4);  // bounded; second order in the splitting's 0.05 rad
    CHECK(defect < 1e-14);
    CHECK(flips > 10);
  }
}

}  // namespace rigid_motion_tests
