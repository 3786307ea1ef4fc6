#pragma once
// Liquid and gas that share one velocity, each with its own flow continued beyond the surface.
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// On each face the field of the fluid that is there, of the liquid where there is no other. `field` is one of Level's.
template <int Dim>
FaceField<Dim> of_both(const Domain<Dim>& domain, const State<Dim>& state, FaceField<Dim> TimeLevel<Dim>::*field);

// Whether both fluids, and the surface with them, are carried by one velocity that is read across the surface. Where
// their densities are alike (within 4) and no tension holds the surface: what light fluid and heavy exchange by
// interpolation is small then, while each by itself, continued beyond the surface, moves shear at it wrongly, which
// makes a dent at the top of a Rayleigh-Taylor bubble.
bool flow_as_one(const Fluids& fluids);

// The time levels of that velocity.
template <int Dim>
Flow<Dim> flow_of_both(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state);

// What the surface goes with: the velocity of both where they flow as one. Else, where a cell is thin for viscosity,
// the mean of both flows, each continued beyond the surface: they agree there but for what either continues wrongly.
// Where the fluids slip along each other, as far as the grid can tell, or no tension shapes the surface, the liquid's
// alone: the gas's may have another velocity across the surface a cell away. In between, from a cell's Reynolds number
// of 10 to 20, from one to the other. Collective.
template <int Dim>
FaceField<Dim> flow_at_surface(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state);

// Forgets all but the marked faces of a level.
template <int Dim>
void keep_faces(const Layout<Dim>& layout, const FaceField<Dim, char>& marked, TimeLevel<Dim>& level);

// Liquid's share of the box of a cell's size around a point of distance phi, by a plane across it.
inline double liquid_share_at(double phi, double h) {
  return std::clamp(0.5 - phi / h, 0.0, 1.0);
}

// Takes the gas's viscosity into that of the liquid: the mean by shares in cells and at edges, so that stress across
// the surface is single-valued.
template <int Dim>
void mix_gas_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, CellField<Dim>& cell,
                       EdgeField<Dim>& edge);

}  // namespace seiche
