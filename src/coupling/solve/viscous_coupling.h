#pragma once
// What viscosity adds to the one solve of a step.
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/fluids.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "fluid/viscosity/viscosity.h"

namespace seiche {

// The viscosity of a step at the cells' centres, and at edges where it depends on the shear rate.
template <int Dim>
struct ViscosityField {
  CellField<Dim> value;  // Pa s, two cells around the owned ones
  double largest = 0;    // where there is liquid, over all ranks
  bool uniform = true;
  std::optional<EdgeField<Dim>> edge{};  // Pa s, one cell around
};

// As the scene gives it at time t, of shear-dependent liquid for the velocities of `flow`. Collective. Throws
// Error(cannot_continue) where a formula is not a number or negative.
template <int Dim>
ViscosityField<Dim> measure_viscosity(const Domain<Dim>& domain, const Fluids& fluids,
                                      const OperatorPerturbation& perturbation, const CellField<Dim>& phi,
                                      const TimeLevel<Dim>& flow, double t);

// split: viscosity acts first, pressure then; coupled: both in one solve.
enum class ViscousRoute { none, split, coupled };

// As the scene asks; "auto": coupled from mu dt/(rho h^2) = 0.5 on, and beside no-slip solids that it moves. Below, a
// step of viscosity reaches less than a cell and pressure undoes little of it.
template <int Dim>
ViscousRoute choose_route(const Setup<Dim>& setup, const ViscosityField<Dim>& viscosity, double dt);

// The viscous operator of a step and the solids in it. Keeps references.
template <int Dim>
class ViscousStep {
 public:
  ViscousStep(const Domain<Dim>& domain, const Solids<Dim>& all, const ProjectionInput<Dim>& in,
              const PressureRows<Dim>& rows, const StepGeometry<Dim>& geometry, const State<Dim>& state,
              const SolidCoupling<Dim>& coupling, const ViscosityField<Dim>& viscosity, const FaceField<Dim>& u_star);

  const ViscousSystem<Dim>& system() const { return system_; }
  const BlockColumns& J() const { return J_; }  // volume a unit of time, not a unit of face area
  // The columns of what is held alone, which are not part of system().G and J().
  const BlockColumns& G_held() const { return G_held_; }
  const BlockColumns& J_held() const { return J_held_; }
  // Volume fluxes through cut faces to second order, from velocities of an earlier time, into q and `closed_flux`.
  void add_wall_flux(const FaceField<Dim>& flow, FaceField<Dim>& closed_flux);
  // Between a field on faces and the rows of the system.
  Vector gather(const FaceField<Dim>& u) const;
  void scatter(const Vector& rows, FaceField<Dim>& u) const;
  // Of the viscous stress on each solid about its reference point, N and N m. Collective.
  std::vector<ViscousLoad> loads(const FaceField<Dim>& u, const Eigen::VectorXd& v) const;
  double dissipation(const FaceField<Dim>& u, const Eigen::VectorXd& v) const;  // W

 private:
  void separate_held();

  const Domain<Dim>& domain_;
  const Solids<Dim>& all_;
  const StepGeometry<Dim>& geometry_;
  const SolidCoupling<Dim>& coupling_;
  const PressureRows<Dim>& rows_;
  std::vector<ViscousSolid<Dim>> solids_;
  CellField<Dim> full_;             // the phi of a domain full of fluid
  std::vector<RigidField> motion_;  // of each solid about when the step began
  ViscousInput<Dim> input_;
  ViscousSystem<Dim> system_;
  BlockColumns J_, G_held_, J_held_;
};

}  // namespace seiche
