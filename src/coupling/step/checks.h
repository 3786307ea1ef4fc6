#pragma once
// Checks of a step's fields, and the values that tests spoil to see them caught.
#include <string>

#include "coupling/state/simulation.h"
#include "fluid/boundary/domain.h"
#include "grid/fields.h"
#include "grid/paged_fields.h"

namespace seiche {

// The first cell of `box` whose value is not finite, as a sentence with `name`; empty where all are. Collective.
template <int Dim>
std::string find_non_finite(const Domain<Dim>& domain, const std::string& name, const Box<Dim>& box, const double* f);

// Likewise of velocity components on faces.
template <int Dim>
std::string find_non_finite(const Domain<Dim>& domain, const std::string& name, const FaceField<Dim>& u);

// Writes a NaN into the first owned cell, or its low faces, where a test asks for one.
template <int Dim>
void inject(const Domain<Dim>& domain, PhaseFault fault, double* f);
template <int Dim>
void inject(const Domain<Dim>& domain, PhaseFault fault, PagedValues<double>& f);

}  // namespace seiche
