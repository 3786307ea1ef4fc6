#pragma once
// Checks that a scene's formulas give finite numbers. Faults are found before they reach the flow and name key, place
// and time.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct DomainSpec;

// "(x, y)"
template <int Dim>
std::string place_text(const Vec<Dim>& x);

// "KEY = "FORMULA" is nan at (x, y), t = 0 s".
template <int Dim>
std::string not_finite_text(const std::string& key, const Formula& formula, double value, const Vec<Dim>& x, double t);

// The first nonempty text in the order of the ranks, on all ranks. Collective.
std::string first_text(const Communicator& ranks, const std::string& mine);

// Throws Error(bad_input) with `fault`, if any, or on a formula that is not finite. Checked are gravity, sides and
// viscosity (also for negative values) at t = 0, and each source when it first opens. Collective.
template <int Dim>
void check_formulas_at_start(const Domain<Dim>& domain, const Fluids& fluids, const std::vector<Source<Dim>>& sources,
                             const DomainSpec& extent, const StepGeometry<Dim>& geometry, const std::string& fault);

// Throw Error(cannot_continue) if a formula is not finite in a step from t0 to t1 (s). Before transport: gravity,
// viscosity (also if negative) and sources. After `geometry` is measured: sides and the motions of solids. Collective.
template <int Dim>
void check_forces_of_step(const Domain<Dim>& domain, const Fluids& fluids, const std::vector<Source<Dim>>& sources,
                          double t0, double t1);
template <int Dim>
void check_geometry_of_step(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                            const StepGeometry<Dim>& geometry, double t0, double t1);

}  // namespace seiche
