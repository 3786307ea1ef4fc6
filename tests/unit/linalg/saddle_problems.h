#pragma once
// Viscous liquid in boxes: contents and forces.
#include <catch2/catch.hpp>

#include "unit/linalg/saddle_cases.h"

namespace seiche::cases {

inline double distance_squared(const Stokes& s, const Cell& c, std::array<double, 3> centre) {
  double sum = 0;
  for (int a = 0; a < s.box.dimension; ++a) sum += std::pow(c[a] + 0.5 - centre[a] * s.box.size[a], 2);
  return sum;
}

inline Stokes liquid(int dimension, int n, double viscosity) {
  Stokes s;
  s.box.dimension = dimension;
  s.box.size = {n, n, dimension == 3 ? n : 1};
  s.viscosity = [viscosity](Cell) { return viscosity; };
  s.body_density = -1;
  return s;
}

// A ball `jump` times as viscous as the rest.
inline void add_inclusion(Stokes& s, double viscosity, double jump) {
  const Stokes box = s;
  s.viscosity = [=](Cell c) {
    return viscosity * (distance_squared(box, c, {0.7, 0.3, 0.5}) < std::pow(0.2 * box.box.size[0], 2) ? jump : 1);
  };
}

inline void add_ball(Stokes& s, double density, double radius = 0.15) {
  const Stokes box = s;
  s.body_density = density;
  s.body = [=](Cell c) { return distance_squared(box, c, {0.45, 0.4, 0.5}) < std::pow(radius * box.box.size[0], 2); };
  for (int a = 0; a < 3; ++a) s.centre[a] = std::array{0.45, 0.4, 0.5}[a] * s.box.size[a];
  s.box.kind = [body = s.body, kind = s.box.kind](Cell c) { return body(c) ? Kind::wall : kind(c); };
}

// A wavy free surface, across the second axis.
inline void add_surface(Stokes& s) {
  s.box.kind = [n = s.box.size[0], kind = s.box.kind](Cell c) {
    return c[1] + 0.5 > 0.7 * n + 0.1 * n * std::sin(6.0 * c[0] / n) ? Kind::air : kind(c);
  };
}

struct Problem {
  Vector f, q;
  Eigen::VectorXd g;
};

// Rough and smooth forces on the faces, which alone give velocities of order one; and forces on the body.
inline Problem pose(const StokesMatrices& m) {
  Problem p{Vector(m.mass), Vector(m.schur_mass.size(), 0.0), Eigen::VectorXd::Zero(m.H.rows())};
  for (std::size_t i = 0; i < p.f.size(); ++i)
    p.f[i] *= cases::noise(m.F.first_row + Row(i)) + std::sin(0.001 * double(m.F.first_row + Row(i)));
  for (Eigen::Index k = 0; k < p.g.size(); ++k) p.g[k] = 1 + 0.5 * double(k);
  return p;
}

struct Answer {
  Vector u, p;
  Eigen::VectorXd v;
  SaddleReport report;
};

inline Answer start(const StokesMatrices& m) {
  return {Vector(m.mass.size(), 0.0), Vector(m.schur_mass.size(), 0.0), Eigen::VectorXd::Zero(m.H.rows()), {}};
}

inline Answer solve(const StokesMatrices& m, const Problem& p, const Communicator& ranks,
                    const SaddleOptions& options = {}) {
  BodyMatrix H(ranks);
  REQUIRE(H.set(m.H));
  SaddleSolver solver(m.system(), options, ranks);
  Answer a = start(m);
  a.report = solver.solve(H, p.f, p.g, p.q, a.u, a.v, a.p);
  return a;
}

}  // namespace seiche::cases
