#pragma once
// Operators made wrong on purpose, to test that validation notices: `--break operator:factor`.
#include <memory>
#include <string>

namespace seiche {

class Communicator;
class Simulation;
struct Scene;

// What each operator is multiplied with; 1 leaves every bit as it is.
struct Tampering {
  double pressure_gradient = 1;   // in u = u* - dt grad p/rho
  double divergence = 1;          // of u*, the right-hand side of the pressure
  double solid_flux = 1;          // J of rigid and elastic bodies
  double viscosity = 1;           // of the viscous operator
  double velocity_advection = 1;  // way along which velocities are carried
  double surface_advection = 1;   // way along which the level set is carried
  double friction = 1;            // coefficients of the solids
  double elastic_forces = 1;      // and their Hessian
};

// "viscosity:0.9" or, for a sign flipped, "viscosity:-1"; "" tampers with nothing. Throws Error(bad_input) with the
// operators' names.
Tampering parse_tampering(const std::string& text);

// As make_simulation(scene, ranks), with wrong operators.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Communicator& ranks, const Tampering& tampering);

}  // namespace seiche
