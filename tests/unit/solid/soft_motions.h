#pragma once
// Violent motions of soft bodies, shared by the unit tests and the exact test of intersections.
#include "unit/solid/soft_cases.h"

namespace seiche::testing {

// A ball of 0.2 m thrown at an inclined wall.
template <int Dim>
SoftWorld<Dim> ball_at_wall(double E, double speed, int cells) {
  SoftWorld<Dim> world;
  world.walls = {{Vec3::Zero(), Vec3(0.1, 1, 0)}};
  world.options.acceleration = 1e4;  // m/s^2, of an impact
  auto& s = world.add(ball_mesh<Dim>(0.1, Vec<Dim>::Unit(1) * 0.105, cells, 2), 1000, E, 0.4);
  for (int i = 0; i < s.body.size(); ++i) s.state.v[i] = i % Dim == 1 ? -speed : 0;
  return world;
}

// A strip of 1 m, pinned below along its left half. fold() moves its right end around onto the left half.
template <int Dim>
struct FoldedStrip {
  static constexpr double length = 1, height = 0.05, dt = 0.05;
  static constexpr int bending = 40, closing = 40;
  SoftWorld<Dim> world;
  std::vector<int> end;
  int steps = 0;

  FoldedStrip() {
    Vec<Dim> upper = Vec<Dim>::Constant(0.1);
    upper[0] = length;
    upper[1] = height;
    IVec<Dim> cells = IVec<Dim>::Constant(1);
    cells[0] = Dim == 2 ? 40 : 20;
    auto& s = world.add(box_mesh<Dim>(Vec<Dim>::Zero(), upper, cells, 2), 1000, 1e5, 0.3);
    s.friction = 0.2;
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-9; };
    for (int n :
         nodes_where(s.body.mesh, [&](const Vec<Dim>& X) { return X[0] < 0.5 * length + 1e-9 && near(X[1], 0); }))
      for (int axis = 0; axis < Dim; ++axis) s.held[Dim * n + axis] = 0;
    end = nodes_where(s.body.mesh, [&](const Vec<Dim>& X) { return near(X[0], length); });
  }

  // Half a turn along a circle, then straight down to 0.3 of the length from the left, a tenth of the height into the
  // strip.
  void fold() {
    auto& s = world.soft[0];
    const double pi = 3.14159265358979323846, t = std::min(1., (steps + 1.) / bending);
    const double angle = pi * t, radius = length / angle, down = std::max(0., (steps + 1. - bending) / closing);
    const double y = (1 - down) * radius * (1 - std::cos(angle)) + down * 0.9 * height;
    const double x = radius * std::sin(angle) + 0.3 * down;
    for (int n : end) {
      const Vec<Dim> X = s.body.mesh.nodes[n];
      const double off = X[1] - 0.5 * height;
      Vec<Dim> place = X;
      place[0] = x - std::sin(angle) * off;
      place[1] = y + 0.5 * height + std::cos(angle) * off;
      for (int axis = 0; axis < Dim; ++axis)
        s.held[Dim * n + axis] = (place[axis] - X[axis] - s.state.u[Dim * n + axis]) / dt;
    }
    world.step(dt);
    ++steps;
  }
};

}  // namespace seiche::testing
