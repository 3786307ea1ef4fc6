#pragma once
// The volume that elastic bodies sweep in liquid without a free surface: what their faces show is made to add up to
// what their surfaces do (docs/method.md, "Sealed liquid").
#include "coupling/solids/coupled_step.h"
#include "fluid/boundary/domain.h"
#include "solid/body/enclosed_volume.h"

namespace seiche {

// An entry of J: what the velocity `column` of a body takes out of a cell, per face area.
struct FluxEntry {
  int row, column;  // the row is this rank's
  double value;
};

// The entries of an elastic body, whose unknowns in the coupling begin with `first`. Those before `shown` are what its
// faces show.
struct BodyEntries {
  int body, first;
  std::vector<FluxEntry> entries;
  std::size_t shown = 0;
};

// A cavity with liquid without a free surface in it. The flux of what moves into it adds up to what its walls sweep:
//   sum_c (J w)_c + prescribed = -(V(u + H w) - volume)/H,  V what the walls enclose.
// Columns of J of the patches' nodes add up to -dV/du at u + H w_0/2, w_0 the velocities before. What else is missing
// is a flux of its own, the same out of each cell that the walls touch.
template <int Dim>
struct CavityConstraint {
  CavityWalls<Dim> walls;
  std::vector<int> first;                    // of each wall: first unknown of its body in the coupling
  std::vector<Eigen::VectorXd> u, gradient;  // likewise: at the start of the interval; dV/du as above
  double horizon;                            // H, s
  double volume;                // V at the end of the interval, m^Dim: what it was, or what sealed liquid keeps it at
  double face_area;             // m^(Dim - 1)
  std::vector<int> rows = {};   // this rank's that the walls touch
  double row_count = 0;         // over all ranks
  std::vector<int> cells = {};  // this rank's rows of the liquid in it, where not all of its walls are elastic
  double prescribed = 0;        // flux out of all of these of what is held and moves as prescribed, per face area, m/s

  // Flux out of each of the rows, per face area (m/s), with which V(u + H w) = volume to first order about w.
  double missing_flux(const Eigen::VectorXd& w) const;
};

// Finds the cavities, and adds to the entries of the elastic bodies what makes their walls sweep what they do, with the
// least change in the sum of squares; where walls are closed forces of a uniform pressure gradient stay as they were.
// Collective.
template <int Dim>
std::vector<CavityConstraint<Dim>> constrain_cavity_volumes(const CoupledStep<Dim>& step, const ElasticMotions& motions,
                                                            std::vector<BodyEntries>& bodies);

// Takes note of what the geometry has of prescribed fluxes. Collective.
template <int Dim>
void take_prescribed_fluxes(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                            std::vector<CavityConstraint<Dim>>& cavities);

}  // namespace seiche
