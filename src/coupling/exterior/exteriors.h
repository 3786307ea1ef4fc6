#pragma once
// The kinds of exteriors.
#include "coupling/state/exterior.h"

namespace seiche {

// The exterior that the scene's table [gas] asks for.
template <int Dim>
OwnedExterior<Dim> make_exterior(const Fluids& fluids, const Domain<Dim>& domain);

template <int Dim>
std::unique_ptr<Exterior<Dim>> enclosed_air(const Domain<Dim>& domain);
template <int Dim>
std::unique_ptr<Exterior<Dim>> flowing_gas();

}  // namespace seiche
