#pragma once
// Separating walls (unilateral pressure): in cells at walls and solids p >= 0, and a cell may gain volume if p = 0
// (Batty, Bertails, Bridson 2007). Solved by policy iteration (fluid/pressure/separation_search.h).
#include "grid/fields.h"
#include "grid/halo.h"

namespace seiche {

template <int Dim>
struct PressureRows;
template <int Dim>
struct ProjectionInput;

template <int Dim>
struct Separation {
  CellField<Dim, char> separated;  // 1: the cell has p = 0 and a free net flux; filled one cell around
  CellField<Dim> gap;              // fraction of a cell's volume that has opened so far and must close before p > 0

  Separation() = default;
  explicit Separation(const Layout<Dim>& layout) : separated(layout), gap(layout) {}
};

// First guess of the parted cells: the liquid cells with an open gap. Collective.
template <int Dim>
void start_separation(const ProjectionInput<Dim>& in, Separation<Dim>& separation);

// Cells whose guess contradicts the solution: cells with a row and p < 0 (suction), and parted cells whose inflow
// exceeds their gap (overfill).
struct WrongGuesses {
  std::vector<Site> cells;  // of this rank
  std::int64_t count = 0;   // over all ranks
  // Largest suction, or overfill times rho h/dt, relative to the largest |p|; over all ranks.
  double worst = 0;
};

// `eligible`: owned cells that may part. Errors up to `tolerance` times the largest |p| are accepted. Collective.
template <int Dim>
WrongGuesses find_wrong_guesses(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                const CellField<Dim>& pressure, const FaceField<Dim>& u_star,
                                const CellField<Dim, char>& eligible, double tolerance,
                                const Separation<Dim>& separation);

// The cells that may part: parted ones, and those that touch a wall or a solid and are not in a closed component.
template <int Dim>
CellField<Dim, char> cells_that_may_part(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                         const std::vector<int>& closed_component);

// Gaps after the step: those of parted cells grow by the net flux (at least to 0), the others are zero.
template <int Dim>
void advance_gaps(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const CellField<Dim>& pressure,
                  const FaceField<Dim>& u_star, Separation<Dim>& separation);

}  // namespace seiche
