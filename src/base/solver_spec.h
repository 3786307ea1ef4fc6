#pragma once
// The table [solver] of a scene.
#include <string>

namespace seiche {

// How viscosity is solved for: with the pressure, after it, or by what the viscosity asks for.
enum class ViscousSolve { automatic, split, coupled };

struct SolverSpec {
  double tolerance = 1e-8;
  std::string preconditioner = "auto";
  ViscousSolve viscosity = ViscousSolve::automatic;
  double rheology_tolerance = 1e-4;  // change of velocity between outer iterations, relative
  int rheology_iterations = 30;      // outer ones a step, at most
  std::string elastic = "auto";      // stiffness of elastic solids in the solve: "factor", "iterate", or by size
};

}  // namespace seiche
