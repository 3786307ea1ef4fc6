#pragma once
// Solids of a scene at its start: their sizes and masses, and their draughts.
#include <string>
#include <vector>

#include "coupling/state/solids.h"
#include "coupling/state/start_account.h"

namespace seiche {

struct DomainSpec;
struct Fluids;

// "(0.5, 0.25)", of the first Dim components, m.
template <int Dim>
std::string rounded_place(const Vec3& x);

// "0.25 m^3"; 2D: "0.25 m^2".
template <int Dim>
std::string volume_text(double volume);

// One entry a solid, without `floating`. Appends warnings of solids outside of the domain, and of parts that the grid
// misses.
template <int Dim>
std::vector<SolidAtStart> account_solids(const Solids<Dim>& solids, const DomainSpec& extent,
                                         std::vector<std::string>& warnings);

// One line on a solid, for the log.
template <int Dim>
std::string line_of(const SolidAtStart& solid);

// Upright equilibria of the solids in liquid at rest, with gravity as at t = 0. Unset for solids that do not move
// freely (joints, pins, fixed axes, springs), that are no bodies, and without gravity.
template <int Dim>
std::vector<std::optional<Floating>> floating_of(const Solids<Dim>& solids, const Fluids& fluids);

}  // namespace seiche
