// Gas that flows: a second fluid with its own velocity, whose cells have rows of the pressure.
#include <fmt/format.h>

#include "coupling/exterior/exteriors.h"
#include "coupling/solve/viscous_coupling.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/restore.h"
#include "coupling/transport/shear_jump.h"
#include "coupling/transport/transport.h"
#include "coupling/transport/two_fluids.h"
#include "grid/loops.h"

namespace seiche {
namespace {

template <int Dim>
FaceField<Dim> initial_gas_velocity(const Domain<Dim>& domain, const Fluids& fluids, const FaceField<Dim, char>& near,
                                    std::string& fault) {
  FaceField<Dim> u(domain.layout);
  const VectorFormula& formula = fluids.gas.velocity;
  const VectorExpression velocity(formula);
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (!near.at(a, f)) return;
      const Vec<Dim> x = domain.layout.position(i, face_offset<Dim>(a));
      u.at(a, f) = velocity.component(a, extend<Dim>(x), 0);
      if (fault.empty() && !std::isfinite(u.at(a, f)))
        fault = not_finite_text<Dim>(fmt::format("gas.velocity[{}]", a), formula[a], u.at(a, f), x, 0);
    });
  return u;
}

// Merges the gas's velocity into u: liquid faces keep u, gas faces take the gas's. On links that the surface crosses,
// momenta add up, rho_f u = theta rho u_liquid + (1 - theta) rho_gas u_gas.
template <int Dim>
void join(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, const FaceField<Dim>& gas,
          FaceField<Dim>& u) {
  const double ratio = fluids.gas_density() / fluids.density();
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      const double theta = liquid_part(phi[f - domain.layout.stride(a)], phi[f]);
      u.at(a, f) = (theta * u.at(a, f) + (1 - theta) * ratio * gas.at(a, f)) / (theta + (1 - theta) * ratio);
    });
}

// Gives both fluids the velocity of their joint momentum on links that the surface crosses. Fluids that flow as one
// have one velocity there; the liquid's alone would give its speed to gas that is at rest.
template <int Dim>
void join_both(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, FaceField<Dim>& gas,
               FaceField<Dim>& liquid) {
  FaceField<Dim> joint = liquid;
  join(domain, fluids, phi, gas, joint);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if ((phi[f] < 0) != (phi[f - domain.layout.stride(a)] < 0)) gas.at(a, f) = liquid.at(a, f) = joint.at(a, f);
    });
}

// Each fluid is transported with its own flow, extrapolated beyond the surface. Neither then takes up the other's
// velocity by interpolation. On links that the surface crosses their momenta add up. See flow_as_one() for the
// exception.
template <int Dim>
class FlowingGas : public Exterior<Dim> {
 public:
  using Exterior<Dim>::flow;
  std::unique_ptr<Exterior<Dim>> copy() const override { return std::make_unique<FlowingGas>(*this); }

  void start(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
             const CellField<Dim>& phi, FaceField<Dim>& u, std::string& fault) override {
    const FaceField<Dim, char> near = faces_near_gas(domain, phi);
    FaceField<Dim> gas = initial_gas_velocity(domain, fluids, near, fault);
    if (flow_as_one(fluids)) join_both(domain, fluids, phi, gas, u);
    flow.now = initial_level(domain, fluids, solids, g, near, std::move(gas));
  }

  FaceField<Dim> surface_velocity(const Domain<Dim>& domain, const Fluids& fluids,
                                  const State<Dim>& state) const override {
    return flow_at_surface(domain, fluids, state);
  }

  FaceField<Dim> volume_velocity(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                                 double span) const override {
    return flow_of_volumes(domain, fluids, state, span);
  }

  Transported<Dim> transported_velocity(const Setup<Dim>& s, const State<Dim>& state, const CellField<Dim>& phi,
                                        double dt, const ViscousPlan& plan, const StepGeometry<Dim>& g) const override {
    const FaceField<Dim, char> all(s.domain.layout, 1);
    Transported<Dim> r;
    if (flow_as_one(s.fluids)) {
      r = transport_flow(s, state, flow_of_both(s.domain, s.fluids, state), all, dt, plan, g);
    } else {
      r = transport_flow(s, state, state, faces_near_liquid(s.domain, phi), dt, plan, g);
      Transported<Dim> gas = transport_flow(s, state, flow, faces_near_gas(s.domain, phi), dt, plan, g);
      join(s.domain, s.fluids, phi, gas.u, r.u);
      r.gas_acceleration = std::move(gas.acceleration);
    }
    add_shear_jump(s.domain, s.fluids, s.features, state, phi, dt, r.u);
    return r;
  }

  // mu.largest refers to the liquid's density, so gas counts by its kinematic viscosity.
  void add_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi,
                     ViscosityField<Dim>& mu) const override {
    const double gas = fluids.gas.viscosity;
    mu.largest = std::max(mu.largest, gas * fluids.density() / fluids.gas_density());
    mu.uniform = mu.uniform && mu.value[domain.layout.site(domain.layout.cells().lower)] == gas;
    if (mu.uniform) return;
    if (!mu.edge) mu.edge = mean_at_edges(domain.layout, mu.value);
    mix_gas_viscosity(domain, fluids, phi, mu.value, *mu.edge);
  }

  void set_rows(const Fluids& fluids, const OperatorPerturbation& perturbation,
                ProjectionInput<Dim>& in) const override {
    in.gas_density = perturbation.gas_density * fluids.gas_density();
  }

  void take(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
            const CellField<Dim>& phi, const TimeLevel<Dim>& solved) override {
    auto level = std::make_shared<TimeLevel<Dim>>(solved);
    continue_level(domain, fluids, solids, g, faces_near_gas(domain, phi), *level);
    flow.now = std::move(level);
  }

  std::shared_ptr<const TimeLevel<Dim>> joined_level(const Domain<Dim>& domain, const Fluids& fluids,
                                                     const State<Dim>& state) const override {
    return level_of_both(domain, fluids, state.phi, state.now, flow.now);
  }

  bool has_pressure(Site) const override { return true; }

  void visit(const Domain<Dim>& domain, const Fluids& fluids, int levels, FieldVisitor<Dim>& visitor) override {
    visit_flow(domain, fluids, "gas.", levels, flow, visitor);
  }
};

}  // namespace

template <int Dim>
std::unique_ptr<Exterior<Dim>> flowing_gas() {
  return std::make_unique<FlowingGas<Dim>>();
}

template std::unique_ptr<Exterior<2>> flowing_gas<2>();
template std::unique_ptr<Exterior<3>> flowing_gas<3>();

}  // namespace seiche
