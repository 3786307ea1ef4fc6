#pragma once
// The sites that transport of a fluid may touch in a step. All fields of a flow are 0 elsewhere.
#include "fluid/boundary/domain.h"

namespace seiche {

// 1 on the stored sites within two halo widths of a face that is `near` the fluid, along each axis. Paths and their
// stencils stay within one width; what is extrapolated there comes from within the other. Collective.
template <int Dim>
CellField<Dim, char> reached_sites(const Domain<Dim>& domain, const FaceField<Dim, char>& near);

}  // namespace seiche
