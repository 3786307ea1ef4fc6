#pragma once
// Exchange between the cells of the surface, so that their volumes follow a smooth level set.
#include "fluid/volume/surface_difference.h"

namespace seiche {

// Differences in cells away from the level set's surface: handed to the surface's cells around where these have room,
// else a reason to rebuild the level set.
template <int Dim>
struct Stray {
  CellField<Dim> rhs;            // missing, with what was handed on
  CellField<Dim> change;         // of the shares
  CellField<Dim, char> rebuild;  // cells where the level set is to be rebuilt

  Stray(const Layout<Dim>& layout, const Difference<Dim>& d, const CellField<Dim>& phi, const CellField<Dim>& share);
};

// Short waves of the difference on the cells `surface` of this rank: f = w (delta_m - delta_c) from cell m to c where
// the level set is smooth and not to be rebuilt, limited to what cells have and can take (Zalesak 1979). Returns what
// was handed on, in cells. delta must be valid in the halo.
template <int Dim>
double exchange_short_waves(const Layout<Dim>& layout, const Difference<Dim>& d, const CellField<Dim>& delta,
                            const CellField<Dim>& phi, const CellField<Dim, char>& rebuild,
                            const std::vector<Site>& surface, CellField<Dim>& share);

}  // namespace seiche
