#pragma once
// Operators made wrong on purpose, to test that validation notices: `--break operator:factor`.
#include <memory>
#include <string>

namespace seiche {

class Communicator;
class Simulation;
struct Scene;

// What each operator is multiplied with; 1 leaves every bit as it is.
struct OperatorPerturbation {
  double pressure_gradient = 1;   // in u = u* - dt grad p/rho
  double divergence = 1;          // of u*, the right-hand side of the pressure
  double gravity = 1;             // on the fluids
  double gas_density = 1;         // in the pressure's links
  double surface_tension = 1;     // the pressure's jump
  double solid_flux = 1;          // J of rigid and elastic bodies
  double rigid_mass = 1;          // and inertia, against the forces of the solve
  double viscosity = 1;           // of the viscous operator
  double yield_stress = 1;        // of the rheology
  double velocity_advection = 1;  // way along which velocities are carried
  double surface_advection = 1;   // way along which the level set is carried
  double contact = 1;             // stiffness of the barrier between solids
  double friction = 1;            // coefficients of the solids
  double elastic_forces = 1;      // and their Hessian
};

// "viscosity:0.9" or, for a sign flipped, "viscosity:-1"; "" tampers with nothing. Throws Error(bad_input) with the
// operators' names.
OperatorPerturbation parse_perturbation(const std::string& text);

// As make_simulation(scene, ranks), with wrong operators.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Communicator& ranks,
                                            const OperatorPerturbation& perturbation);

}  // namespace seiche
