#pragma once
// Bytes that a run takes for each cell, fitted to runs of scenes/ and benchmarks/cases.py (docs/performance.md,
// "Estimates").

namespace seiche {

struct Scene;

constexpr double bytes_a_cell = 350;  // of the domain, empty or not

// For each cell with fluid, and for those within three cells of one.
double bytes_a_fluid_cell(const Scene& scene);

// True if a liquid or a gas that flows has viscosity, as far as the text of a formula tells.
bool has_viscous_flow(const Scene& scene);

}  // namespace seiche
