#pragma once
// The parts of the solve of a first step of 1 ms, from zero pressure, so that tests can count its work.
#include "coupling/solve/liquid_problem.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/step/initial_state.h"
#include "coupling/transport/transport.h"
#include "scenes.h"

namespace seiche::test {

struct FirstSolve {
  static constexpr int Dim = 3;
  static constexpr double dt = 1e-3;
  Setup<Dim> s;
  State<Dim> state = initial_state(s);
  StepGeometry<Dim> g = s.solids.geometry.measure(place_bodies(state), 0);
  ProjectionInput<Dim> in{s.domain.layout, s.domain.halo, s.domain.ranks, state.phi, g.faces, s.fluids.density(), dt};
  PressureRows<Dim> rows = number_rows(in);
  NullSpace closed = find_closed_components(in, rows);
  SolidCoupling<Dim> coupling = couple_solids(s, g, rows, closed, state, dt, dt);
  double c1 = s.fluids.density() * s.domain.layout.h() / dt, c2 = dt * s.domain.layout.geometry().face_area();
  DistributedMatrix A = assemble_pressure_matrix(in, rows);
  RowGrid grid = row_grid(in, rows);
  SpdSolver solver{A, grid, closed, coupling.J, c1* c2, {.tolerance = 1e-8}, s.domain.ranks};
  Vector b = pressure_right_side(in, rows, transport_velocity(s, state, state.phi, dt, {}, g, {s, state, 0}).u);
  Vector p = Vector(b.size());
  LiquidProblem<Dim> problem{coupling, solver, closed, b, p, c1, c2, s.domain.ranks};

  explicit FirstSolve(const Scene& scene) : s(scene, Communicator()) {}
  FirstSolve(const FirstSolve&) = delete;
  FirstSolve& operator=(const FirstSolve&) = delete;
};

}  // namespace seiche::test
