#pragma once
// Volume constraint of elastic bodies around liquid without a free surface (docs/method.md, "Sealed liquid"). The
// fluxes of their face shares are corrected to add up to the volume that their surfaces sweep.
#include "coupling/solids/coupled_step.h"
#include "fluid/boundary/domain.h"
#include "solid/body/enclosed_volume.h"

namespace seiche {

// An entry of J: flux out of a cell for unit velocity `column` of a body, per face area.
struct FluxEntry {
  int row, column;  // the row counts from this rank's first
  double value;
};

// Entries of J of one elastic body. `first`: its first unknown in the coupling. `shown`: number of entries that are
// those of its face shares; corrections follow. `separated`: corrections in cells separated from the body, which have
// no row.
struct BodyEntries {
  int body, first;
  std::vector<FluxEntry> entries = {};
  std::size_t shown = 0;
  CellFluxes separated = {};
};

// A row that walls touch, and its share of what flows out of all of them beside J w.
struct TouchedRow {
  int row;
  double share;
};

// A cavity of liquid without a free surface, around or within elastic bodies. Its volume constraint, A_f the face area,
// V the volume within the walls:
//   sum_c (J w)_c + flux + prescribed = -(V(u + H w) - volume)/(H A_f).
// The columns of J of the walls' nodes add up to -(dV/du)/A_f at u + H w_0/2, w_0 the velocities before the solve. If
// liquid lies around all walls, they stay as they are. The remainder is `flux`. It flows out of the cells that the
// walls touch in proportion to the open parts of their faces: equal fluxes took thousands of Pa in cells that are
// nearly shut.
template <int Dim>
struct CavityConstraint {
  CavityWalls<Dim> walls;
  std::vector<int> first;                    // first unknown of the body in the coupling, one a wall
  std::vector<Eigen::VectorXd> u, gradient;  // one a wall: at the start of the interval; -A_f times the sums of columns
  double horizon;                            // H, s
  double volume;     // wanted V at the end of the interval, m^Dim: of an earlier step's cavity, else at the start
  double face_area;  // m^(Dim - 1)
  std::vector<TouchedRow> rows = {};  // this rank's
  std::vector<int> cells = {};        // this rank's rows of its liquid; only filled for open patches
  double prescribed = 0;  // net flux out of `cells` by pinned nodes and prescribed solids, per face area, m/s

  // Flux out of all `rows`, per face area (m/s), with which V(u + H w) = volume to first order about w.
  double missing_flux(const Eigen::VectorXd& w) const;
};

// Difference between -(dV/du)/A_f and the sums of the columns of J in `entries`. Collective.
Eigen::VectorXd lacking_flux(const Eigen::VectorXd& gradient, double face_area, const std::vector<FluxEntry>& entries,
                             const Communicator& ranks);

// Finds the cavities. Where walls lie around the liquid, adds corrections of minimum norm to the entries of the elastic
// bodies. Columns of J then add up to -(dV/du)/A_f. On closed walls the force of a uniform pressure gradient is
// unchanged. Collective.
template <int Dim>
std::vector<CavityConstraint<Dim>> constrain_cavity_volumes(const CoupledStep<Dim>& step, const ElasticMotions& motions,
                                                            std::vector<BodyEntries>& bodies);

// Sets CavityConstraint::prescribed to the prescribed fluxes in the geometry. Collective.
template <int Dim>
void take_prescribed_fluxes(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                            std::vector<CavityConstraint<Dim>>& cavities);

}  // namespace seiche
