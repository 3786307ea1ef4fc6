#pragma once
// Viscosity in the coupled solve of a step: its values, the choice of solver and the operator.
#include "base/solver_spec.h"
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/fluids.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "fluid/viscosity/viscosity.h"

namespace seiche {

// Viscosity of a step at cell centres; also at edges if it depends on the shear rate or differs between liquid and gas.
template <int Dim>
struct ViscosityField {
  CellField<Dim> value;  // Pa s, two cells around the owned ones
  double largest = 0;    // Pa s in liquid, over all ranks; gas counts by its kinematic viscosity
  bool uniform = true;
  std::optional<EdgeField<Dim>> edge{};  // Pa s, one cell around
};

// Viscosity of the scene at the state's time, surface and exterior; shear-dependent liquid has the shear rates of
// `flow`. Throws Error(cannot_continue) if a formula is not a number or negative. Collective.
template <int Dim>
ViscosityField<Dim> measure_viscosity(const Domain<Dim>& domain, const Fluids& fluids,
                                      const OperatorPerturbation& perturbation, const State<Dim>& state,
                                      const TimeLevel<Dim>& flow);

// The mean of the cells around an edge, one cell around the owned ones.
template <int Dim>
EdgeField<Dim> mean_at_edges(const Layout<Dim>& layout, const CellField<Dim>& mu);

// split: viscosity first, then pressure; coupled: both in one solve.
enum class ViscousRoute { none, split, coupled };

// The scene's choice. "auto" is coupled for mu dt/(rho h^2) >= 0.5, beside free no-slip solids and beside elastic ones.
// Below 0.5, shear diffuses across less than a cell in a step, and pressure undoes little of it. Before the pressure
// acts, elastic solids fly freely with the forces that they had at the start of the step.
template <int Dim>
ViscousRoute choose_route(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                          const BlockColumns& J, ViscousSolve asked, const ViscosityField<Dim>& viscosity, double dt);

// The viscous operator of a step and the solids in it. Keeps references.
template <int Dim>
class ViscousStep {
 public:
  ViscousStep(const Domain<Dim>& domain, const Solids<Dim>& all, const ProjectionInput<Dim>& in,
              const PressureRows<Dim>& rows, const StepGeometry<Dim>& geometry, const State<Dim>& state,
              const SolidCoupling<Dim>& coupling, const ViscosityField<Dim>& viscosity, const FaceField<Dim>& u_star);

  const ViscousSystem<Dim>& system() const { return system_; }
  const BlockColumns& J() const { return J_; }  // coupling.J times the face area: m^Dim/s
  // Columns of fixed unknowns alone. They are not part of system().G and J().
  const BlockColumns& G_held() const { return G_held_; }
  const BlockColumns& J_held() const { return J_held_; }
  // Adds the volume flux through cut faces at no-slip walls, to second order, to q and `closed_flux`. `flow`:
  // velocities at an earlier time.
  void add_wall_flux(const FaceField<Dim>& flow, const std::vector<RigidField>& motion,
                     PagedFaceField<Dim>& closed_flux);
  // Copy between a face field and the rows of the system.
  Vector gather(const FaceField<Dim>& u) const;
  void scatter(const Vector& rows, FaceField<Dim>& u) const;
  // Loads of the viscous stress on each solid, about its reference point, N and N m. Collective.
  std::vector<SolidLoad> loads(const FaceField<Dim>& u, const Eigen::VectorXd& v) const;
  // Power of the stress of `strained` on the motion z and on that before the step, see viscous_power(). Collective.
  ViscousPower power(const ViscousMotion<Dim>& strained, const ViscousMotion<Dim>& z,
                     const ViscousMotion<Dim>& before) const;
  // Frees all but what loads() and power() read.
  void keep_samples_only();

 private:
  void separate_held();

  const Domain<Dim>& domain_;
  const Solids<Dim>& all_;
  const StepGeometry<Dim>& geometry_;
  const SolidCoupling<Dim>& coupling_;
  const PressureRows<Dim>& rows_;
  std::vector<ViscousSolid<Dim>> solids_;
  CellField<Dim> full_;  // phi of a domain full of fluid, for two fluids
  ViscousInput<Dim> input_;
  ViscousSystem<Dim> system_;
  BlockColumns J_, G_held_, J_held_;
};

}  // namespace seiche
