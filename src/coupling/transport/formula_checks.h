#pragma once
// Formulas of a scene that give no finite number: found before they reach the flow, and said by key, place and time.
#include "base/domain_spec.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// "(x, y)"
template <int Dim>
std::string place_text(const Vec<Dim>& x);

// "KEY = "FORMULA" is nan at (x, y), t = 0 s".
template <int Dim>
std::string not_finite_text(const std::string& key, const Formula& formula, double value, const Vec<Dim>& x, double t);

// The first text that is not empty, by rank, on all ranks. Collective.
std::string first_text(const Communicator& ranks, const std::string& mine);

// Throws Error(bad_input) with `fault` or where gravity, the viscosity or a side's or a source's formula is not finite
// as the run begins (a source: as it begins), or the viscosity is negative. Collective.
template <int Dim>
void check_formulas_at_start(const Domain<Dim>& domain, const Fluids& fluids, const std::vector<Source<Dim>>& sources,
                             const DomainSpec& extent, const StepGeometry<Dim>& geometry, const std::string& fault);

// Throw Error(cannot_continue) where a formula is not finite in a step from t0 to t1: gravity, the viscosity
// (or negative) or of a source, before the transport, and of a side or a solid's motion, as measured in `geometry`.
// Collective.
template <int Dim>
void check_forces_of_step(const Domain<Dim>& domain, const Fluids& fluids, const std::vector<Source<Dim>>& sources,
                          double t0, double t1);
template <int Dim>
void check_geometry_of_step(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                            const StepGeometry<Dim>& geometry, double t0, double t1);

}  // namespace seiche
