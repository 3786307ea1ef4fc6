// The defaults of an exterior.
#include "coupling/state/state.h"
#include "coupling/transport/transport.h"

namespace seiche {

template <int Dim>
FaceField<Dim> Exterior<Dim>::surface_velocity(const Domain<Dim>&, const Fluids&, const State<Dim>& state) const {
  return state.now->u;
}

template <int Dim>
double Exterior<Dim>::control_volume(const Domain<Dim>& domain, const StepGeometry<Dim>& g, double expected,
                                     double limit, CellField<Dim>& phi) {
  return seiche::control_volume(domain, g.psi, expected, limit, phi);
}

template <int Dim>
Transported<Dim> Exterior<Dim>::transported_velocity(const Setup<Dim>& s, const State<Dim>& state,
                                                     const CellField<Dim>& phi, double dt, const ViscousPlan& plan,
                                                     const StepGeometry<Dim>& g) const {
  return transport_flow(s, state, state, faces_near_liquid(s.domain, phi), dt, plan, g);
}

template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> Exterior<Dim>::joined_level(const Domain<Dim>&, const Fluids&,
                                                                  const State<Dim>& state) const {
  return state.now;
}

template class Exterior<2>;
template class Exterior<3>;

}  // namespace seiche
