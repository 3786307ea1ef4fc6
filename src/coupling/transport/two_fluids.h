#pragma once
// Liquid and gas that share one velocity field, each with its own flow extrapolated beyond the surface.
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Composite level: on each face the values of the fluid there, valid where either fluid's are; null unless both exist.
// Collective.
template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> level_of_both(const Domain<Dim>& domain, const Fluids& fluids,
                                                    const CellField<Dim>& phi,
                                                    const std::shared_ptr<const TimeLevel<Dim>>& liquid,
                                                    const std::shared_ptr<const TimeLevel<Dim>>& gas);

// True if one velocity, interpolated across the surface, transports both fluids and the surface: densities within a
// factor of 4 and no surface tension. Interpolation then exchanges little momentum between the fluids. Separate flows
// extrapolated beyond the surface would transport shear at the surface wrongly, with a dent at the top of a
// Rayleigh-Taylor bubble.
bool flow_as_one(const Fluids& fluids);

// Time levels of the composite flow. Collective.
template <int Dim>
Flow<Dim> flow_of_both(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state);

// Velocity that transports the surface, m/s: the composite one if flow_as_one(). Otherwise it depends on the Reynolds
// number of a cell. Up to 10 it is the mean of both extrapolated flows, which agree there but for errors of
// extrapolation. From 20 on it is the liquid's velocity, since the fluids may slip along each other on the scale of the
// grid. Between 10 and 20 it is blended linearly. Without surface tension or with variable viscosity it is the
// liquid's. Collective.
template <int Dim>
FaceField<Dim> flow_at_surface(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state);

// Velocity that carries the volumes of cells over `span` (s), m/s. On faces that were solved for in the gas it is the
// liquid's, extrapolated, or that of the gas, as flow_at_surface() tells; faces of cells that have no room for what the
// liquid's would bring have the gas's, which is free of divergence. Collective.
template <int Dim>
FaceField<Dim> flow_of_volumes(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, double span);

// Liquid share of a box of width h around a point at signed distance phi (m) from a plane surface.
inline double liquid_share_at(double phi, double h) {
  return std::clamp(0.5 - phi / h, 0.0, 1.0);
}

// Mixes the gas's viscosity into the liquid's in `cell` and `edge` (Pa s), by liquid share at cell centres and edges.
// Strain that shears along the surface has the harmonic mean, for stress is continuous across layers; the rest, which
// both fluids take alike, the arithmetic one. Reads phi three cells around the owned ones.
template <int Dim>
void mix_gas_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, CellField<Dim>& cell,
                       EdgeField<Dim>& edge);

}  // namespace seiche
