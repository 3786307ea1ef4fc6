#pragma once
// Exterior: all beyond the liquid's surface, one class per kind: a vacuum, enclosed air, gas that flows.
// exterior/exteriors.h chooses.
#include <memory>
#include <string>

#include "coupling/geometry/step_geometry.h"
#include "coupling/state/flow.h"
#include "coupling/state/fluids.h"
#include "coupling/state/state_visitor.h"
#include "fluid/boundary/domain.h"
#include "fluid/pressure/pressure.h"

namespace seiche {

template <int Dim>
struct Setup;
template <int Dim>
struct Solids;
template <int Dim>
struct State;
template <int Dim>
struct ViscosityField;
template <int Dim>
struct Transported;
struct OperatorPerturbation;
struct StepStats;
struct ViscousPlan;

// The exterior of the liquid with the data that it keeps from step to step. A value: State owns a copy. The defaults
// are those of a vacuum: pressure 0, no flow, no data.
template <int Dim>
class Exterior {
 public:
  Flow<Dim> flow;  // its own flow, extrapolated into the liquid; no levels if it does not flow

  virtual ~Exterior() = default;
  virtual std::unique_ptr<Exterior> copy() const = 0;
  bool flows() const { return flow.now != nullptr; }

  // Sets its data at the start; may change the liquid's velocity u beside it. `fault`: set if it is empty and a formula
  // is not finite. Collective.
  virtual void start(const Domain<Dim>&, const Fluids&, const Solids<Dim>&, const StepGeometry<Dim>&,
                     const CellField<Dim>& /*phi*/, FaceField<Dim>& /*u*/, std::string& /*fault*/) {}

  // Velocity that transports the surface from `state`, m/s. Default: the liquid's. Collective.
  virtual FaceField<Dim> surface_velocity(const Domain<Dim>&, const Fluids&, const State<Dim>& state) const;
  // Velocity that carries the volumes of cells from `state` over `span` (s), m/s. Default: that of the surface.
  // Collective.
  virtual FaceField<Dim> volume_velocity(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                                         double /*span*/) const {
    return surface_velocity(domain, fluids, state);
  }
  // Follows the surface to phi, dt (s) after the last call, along the velocity u (m/s); dt = 0: in place. Collective.
  virtual void follow(const Domain<Dim>&, const StepGeometry<Dim>&, const FaceField<Dim>& /*u*/, double /*dt*/,
                      const CellField<Dim>& /*phi*/) {}
  // Shifts phi by at most `limit` (m) so that the liquid has the expected volume (m^Dim), and volumes that the exterior
  // keeps are kept. Returns the liquid volume restored, m^Dim. Fills ghosts. Collective.
  virtual double control_volume(const Domain<Dim>&, const StepGeometry<Dim>&, double expected, double limit,
                                CellField<Dim>& phi);

  // Measures how far volumes that the exterior keeps are from those they should have. `share`: of the liquid in cells.
  // Collective.
  virtual void weigh(const Domain<Dim>&, const StepGeometry<Dim>&, const CellField<Dim>& /*phi*/,
                     const CellField<Dim>& /*share*/, const Room<Dim>&) {}

  // Velocity of all fluids before the projection, and their accelerations: transport_velocity() without sources.
  // Collective.
  virtual Transported<Dim> transported_velocity(const Setup<Dim>&, const State<Dim>&, const CellField<Dim>& phi,
                                                double dt, const ViscousPlan&, const StepGeometry<Dim>&) const;
  // Adds its viscosity to the liquid's. Collective.
  virtual void add_viscosity(const Domain<Dim>&, const Fluids&, const CellField<Dim>& /*phi*/,
                             ViscosityField<Dim>&) const {}
  // Sets the density or the regions of air that have rows of the pressure. The input keeps references to the exterior.
  virtual void set_rows(const Fluids&, const OperatorPerturbation&, ProjectionInput<Dim>&) const {}
  // Takes its flow from a level that was solved for in all fluids. Collective.
  virtual void take(const Domain<Dim>&, const Fluids&, const Solids<Dim>&, const StepGeometry<Dim>&,
                    const CellField<Dim>& /*phi*/, const TimeLevel<Dim>& /*solved*/) {}

  // The flow at present on all faces, each with the value of the fluid there. Default: the liquid's. Collective.
  virtual std::shared_ptr<const TimeLevel<Dim>> joined_level(const Domain<Dim>&, const Fluids&,
                                                             const State<Dim>& state) const;
  // True if a cell beyond the surface has a pressure of its own.
  virtual bool has_pressure(Site /*cell*/) const { return false; }
  // Sets the columns of the statistics that only it has. Collective.
  virtual void measure(const Domain<Dim>&, const NodeField<Dim>& /*psi*/, const CellField<Dim>& /*phi*/,
                       StepStats&) const {}
  // Visits its data; `levels`: number of time levels that exist. Collective.
  virtual void visit(const Domain<Dim>&, const Fluids&, int /*levels*/, FieldVisitor<Dim>&) {}
};

// Pressure 0 beyond the surface.
template <int Dim>
class Vacuum : public Exterior<Dim> {
 public:
  std::unique_ptr<Exterior<Dim>> copy() const override { return std::make_unique<Vacuum>(*this); }
};

// Owns an exterior. Copies are deep.
template <int Dim>
class OwnedExterior {
 public:
  OwnedExterior() : owned_(std::make_unique<Vacuum<Dim>>()) {}
  explicit OwnedExterior(std::unique_ptr<Exterior<Dim>> owned) : owned_(std::move(owned)) {}
  OwnedExterior(const OwnedExterior& other) : owned_(other.owned_->copy()) {}
  OwnedExterior(OwnedExterior&&) noexcept = default;
  OwnedExterior& operator=(OwnedExterior other) noexcept {
    owned_ = std::move(other.owned_);
    return *this;
  }

  Exterior<Dim>* operator->() { return owned_.get(); }
  const Exterior<Dim>* operator->() const { return owned_.get(); }
  const Exterior<Dim>& operator*() const { return *owned_; }

 private:
  std::unique_ptr<Exterior<Dim>> owned_;
};

}  // namespace seiche
