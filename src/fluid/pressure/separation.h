#pragma once
// Liquid that parts from walls and solids instead of hanging on to them: p >= 0 there, and a cell may gain volume where
// p = 0 (Batty, Bertails, Bridson 2007; solved by policy iteration, fluid/pressure/separation_search.h).
#include "grid/fields.h"
#include "grid/halo.h"

namespace seiche {

template <int Dim>
struct PressureRows;
template <int Dim>
struct ProjectionInput;

template <int Dim>
struct Separation {
  CellField<Dim, char> separated;  // 1: this cell's pressure is zero and its net flux free; one cell around filled
  CellField<Dim> gap;              // share of a cell's volume that has opened so far and is to be closed before p > 0

  Separation() = default;
  explicit Separation(const Layout<Dim>& layout) : separated(layout), gap(layout) {}
};

// First guess: the cells that were parted already. Collective.
template <int Dim>
void start_separation(const ProjectionInput<Dim>& in, Separation<Dim>& separation);

// Cells whose guess a solution contradicts: those that did not part but whose pressure pulls, and those that parted but
// would be squeezed beyond their gap.
struct WrongGuesses {
  std::vector<Site> cells;  // of this rank
  std::int64_t count = 0;   // over all ranks
  // Largest pull, or squeeze times rho h/dt, over the largest pressure; over all ranks.
  double worst = 0;
};

// `eligible` says which owned cells may part; what is within `tolerance` of the largest pressure is right. Collective.
template <int Dim>
WrongGuesses find_wrong_guesses(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                const CellField<Dim>& pressure, const FaceField<Dim>& u_star,
                                const CellField<Dim, char>& eligible, double tolerance,
                                const Separation<Dim>& separation);

// Cells that touch a wall or a solid, those of closed components left out, and those that are parted already.
template <int Dim>
CellField<Dim, char> cells_that_may_part(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                         const std::vector<int>& closed_component);

// Gaps after the step: parted cells open by their net flux, the others are shut.
template <int Dim>
void advance_gaps(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const CellField<Dim>& pressure,
                  const FaceField<Dim>& u_star, Separation<Dim>& separation);

}  // namespace seiche
