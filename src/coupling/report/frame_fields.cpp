// Fields for frames, from the owned cells.
#include "base/error.h"
#include "coupling/geometry/cell_distance.h"
#include "coupling/report/measures.h"
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "coupling/transport/liquid_viscosity.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// du_b/dx_a at cell centres by central differences of face means.
template <int Dim>
double cell_gradient(const Layout<Dim>& layout, const FieldValues<double>& u, int b, int a, Site c) {
  const Site da = layout.stride(a), db = layout.stride(b);
  if (a == b) return (u[c + da] - u[c]) / layout.h();
  return (u[c + da] + u[c + da + db] - u[c - da] - u[c - da + db]) / (4 * layout.h());
}

// |curl u| in 3D, curl u in 2D, where there is fluid; 0 elsewhere. 1/s.
template <int Dim>
double vorticity(const Domain<Dim>& domain, const State<Dim>& state, const FaceField<Dim>& u, Site c) {
  if (state.phi[c] >= 0 && !state.exterior->flows()) return 0;
  const auto part = [&](int a, int b) {
    return cell_gradient(domain.layout, u[b], b, a, c) - cell_gradient(domain.layout, u[a], a, b, c);
  };
  if constexpr (Dim == 2) return part(0, 1);
  if constexpr (Dim == 3) return Vec3(part(1, 2), part(2, 0), part(0, 1)).norm();
}

}  // namespace

// Viscosity, Pa s; outside the liquid that of the gas, or 0.
template <int Dim>
CellField<Dim> viscosity(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  CellField<Dim> mu(domain.layout);
  const std::string fault = set_liquid_viscosity(domain, fluids, state.now->u, state.now->valid, state.time, mu);
  if (!fault.empty()) throw Error(ExitCode::cannot_continue, fault);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    if (state.phi[c] >= 0) mu[c] = fluids.gas_viscosity();
  });
  return mu;
}

template <int Dim>
FrameField make_frame_field(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                            const NodeField<Dim>& psi, const std::string& name) {
  FrameField out;
  out.name = name;
  for (int a = 0; a < Dim; ++a)
    out.lower[a] = domain.layout.cells().lower[a], out.upper[a] = domain.layout.cells().upper[a];
  if (Dim == 2) out.upper[2] = 1;
  const auto fill = [&](FrameField::Kind kind, auto value) {
    out.kind = kind;
    for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) { value(c); });
  };
  if (name == "surface")
    fill(FrameField::Kind::level_set, [&](Site c) { out.values.push_back(float(state.phi[c])); });
  else if (name == "closed_surface")
    fill(FrameField::Kind::level_set, [&](Site c) {
      out.values.push_back(float(std::max(state.phi[c], -distance_at_cell(domain.layout, psi, c).first)));
    });
  else if (name == "vel")
    fill(FrameField::Kind::staggered_vector, [&, flow = state.exterior->joined_level(domain, fluids, state)](Site c) {
      for (int a = 0; a < 3; ++a) out.values.push_back(a < Dim ? float(flow->u.at(std::min(a, Dim - 1), c)) : 0.0f);
    });
  else if (name == "pressure")
    fill(FrameField::Kind::scalar, [&](Site c) { out.values.push_back(float(state.pressure[c])); });
  else if (name == "viscosity")
    fill(FrameField::Kind::scalar,
         [&, mu = viscosity(domain, fluids, state)](Site c) { out.values.push_back(float(mu[c])); });
  else if (name == "vorticity")
    fill(FrameField::Kind::scalar, [&, flow = state.exterior->joined_level(domain, fluids, state)](Site c) {
      out.values.push_back(float(vorticity(domain, state, flow->u, c)));
    });
  else
    throw Error(ExitCode::bug, "no field named '" + name + "'");
  return out;
}

template <int Dim>
FieldView make_field_view(const Domain<Dim>& domain, const State<Dim>& state, const std::string& name) {
  const auto& cells = domain.layout.cells();
  FieldView view;
  view.name = name;
  const double* values = nullptr;
  for (int a = 0; a < Dim; ++a) {
    const auto at = std::size_t(a);
    view.lower[at] = cells.lower[a];
    view.shape[at] = cells.upper[a] - cells.lower[a];
    view.strides[at] = domain.layout.stride(a);
    if (name != std::string("velocity_") + "xyz"[a]) continue;
    ++view.shape[at];
    values = state.now->u[a].begin();
    view.owner = state.now;
  }
  if (name == "surface") values = state.phi.data();
  if (name == "pressure") values = state.pressure.data();
  if (!values)
    throw Error(
        ExitCode::bad_input,
        "no field named '" + name + "'; there are surface, pressure, velocity_x, velocity_y and, in 3D, velocity_z");
  view.first = values + domain.layout.site(cells.lower);
  return view;
}

#define SEICHE_INSTANTIATE(D)                                                                                    \
  template FrameField make_frame_field<D>(const Domain<D>&, const Fluids&, const State<D>&, const NodeField<D>&, \
                                          const std::string&);                                                   \
  template FieldView make_field_view<D>(const Domain<D>&, const State<D>&, const std::string&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
