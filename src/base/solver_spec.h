#pragma once
// The table [solver] of a scene.
#include <string>

namespace seiche {

// Order of viscosity and pressure. split: viscosity first, then pressure. coupled: one system for both. automatic: by
// mu dt/(rho h^2), see coupling/solve/viscous_coupling.h.
enum class ViscousSolve { automatic, split, coupled };

struct SolverSpec {
  double tolerance = 1e-8;
  std::string preconditioner = "auto";
  ViscousSolve viscosity = ViscousSolve::automatic;
  double rheology_tolerance = 1e-4;  // relative change of velocity between outer iterations
  int rheology_iterations = 30;      // largest number of outer iterations per step
  std::string elastic = "auto";      // solver for elastic stiffness: "factor", "iterate", or "auto" by size
};

}  // namespace seiche
