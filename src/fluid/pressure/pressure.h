#pragma once
// Variational cut-cell pressure projection with a second-order free surface: rows, components, matrix, update.
#include <algorithm>
#include <string>

#include "fluid/boundary/face_geometry.h"
#include "fluid/pressure/air_regions.h"
#include "fluid/pressure/separation.h"
#include "fluid/volume/ledger.h"
#include "grid/halo.h"
#include "grid/loops.h"
#include "linalg/spd/solve.h"

namespace seiche {

// Input of the projection. phi and geometry must be valid one cell around the owned ones.
template <int Dim>
struct ProjectionInput {
  const Layout<Dim>& layout;
  const Halo<Dim>& halo;
  const Communicator& ranks;
  const CellField<Dim>& phi;
  const FaceGeometry<Dim>& faces;
  double density;                               // kg/m^3
  double dt;                                    // s
  const Separation<Dim>* separation = nullptr;  // separating walls; null: walls exert suction
  double gas_density = 0;  // kg/m^3; 0: no gas flow, p = 0 beyond the surface except in enclosed air
  // p_liquid - p_gas at faces whose link the surface crosses, Pa; null: 0 everywhere.
  const FaceField<Dim>* surface_jump = nullptr;
  const AirRegions<Dim>* air = nullptr;  // enclosed air that keeps its volume; null: none

  // share: liquid volume fractions V; null: not carried. room: capacities K. excess_time: time (s) in which the excess
  // V - K flows out of a cell. It is far longer than a short step, whose outflow would be an impact. Deep cells with
  // V < K are filled at the same rate (fluid/volume/ledger.h).
  const CellField<Dim>* share = nullptr;
  Room<Dim> room = {};
  double excess_time = 0;
  const CellField<Dim>* filling = nullptr;  // inflow that fills cells, per face area, m/s; null: none
  std::vector<double> air_inflow = {};      // into each region of air, per face area, m/s; empty: none

  // FaceGeometry::entry_factor of the step. u* has it already.
  double entry_factor(int axis, Site face) const { return faces.entry_factor(axis, face, dt / layout.h()); }
  bool has_gas() const { return gas_density > 0; }
  bool is_liquid(Site cell) const { return phi[cell] < 0; }
  bool is_separated(Site cell) const { return separation && separation->separated[cell]; }
  // Through open faces that add up to W it has at most the speed h/excess_time: |V - K| counts up to W.
  double outflow_of_excess(Site cell) const {
    const double excess = (*share)[cell] - room.of(cell);
    const bool flows = excess > 0 || is_deep<Dim>(layout, {Divergence::stays, room}, phi, *share, cell);
    if (!flows || excess == 0) return 0;
    const double most = room.is_whole() ? 1 : passable(cell);
    return std::clamp(excess, -most, most) * layout.h() / excess_time;
  }
  // Sum of the open shares of a cell's faces of unknown velocity.
  double passable(Site cell) const {
    double sum = 0;
    for_each_face_of(layout, cell, [&](int a, Site f, int, Site) {
      if (faces.is_unknown(a, f)) sum += faces.open.at(a, f);
    });
    return sum;
  }
  // Inflow that fills a cell or its gap within the step, less the outflow of its excess, per face area, m/s.
  double missing_flux(Site cell) const {
    double flux = separation ? separation->gap[cell] * layout.h() / dt : 0;
    if (filling) flux += (*filling)[cell];
    return share ? flux - outflow_of_excess(cell) : flux;
  }
};

// The unknowns: one row per cell of liquid or flowing gas, then one per region of enclosed air. A cell must have a face
// of unknown velocity and must not be separated.
template <int Dim>
struct PressureRows {
  static constexpr std::int64_t no_row = -1, separated_row = -2;
  // Global row (of the region for enclosed air), no_row, or separated_row (p = 0). Ghosts filled.
  CellField<Dim, std::int64_t> row;
  std::vector<Site> cells;    // owned cells with a row of their own, in row order, then one cell per region of air
  std::size_t liquid = 0;     // number of `cells` before those of the regions
  Row first = 0, global = 0;  // first row of this rank; number of rows of all ranks
  std::int64_t isolated = 0;  // liquid cells without a face of unknown velocity, over all ranks
  const AirRegions<Dim>* air = nullptr;
  std::vector<Row> air_row;  // row of each region, equal on all ranks

  // Region of enclosed air that contains the cell, or -1.
  std::int64_t region(Site cell) const { return air ? std::max<std::int64_t>(air->label[cell], -1) : -1; }
  bool has_own(Site cell) const { return row[cell] >= 0 && region(cell) < 0; }
  bool is_separated(Site cell) const { return row[cell] == separated_row; }
  // True if a cell has its own pressure, either an unknown or the zero of a separated cell. Face masses depend on this,
  // and the policy iteration needs one matrix, so it must not depend on the guess of separated cells.
  bool has_pressure(Site cell) const { return has_own(cell) || is_separated(cell); }
  bool touch_pressure(Site low, Site high) const { return has_pressure(low) || has_pressure(high); }
  bool owns(Row r) const { return r >= first && r < first + Row(cells.size()); }
};

// Inflow that row n lacks, of a cell or a region of air, per face area, m/s.
template <int Dim>
double missing_flux(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, std::size_t n) {
  if (n < rows.liquid) return in.missing_flux(rows.cells[n]);
  return in.air_inflow.empty() ? 0 : in.air_inflow[std::size_t(rows.region(rows.cells[n]))];
}

// sum_f +- of_face(axis, f) + of_cell(cell) for each row. A region of air sums over its cells, without the faces
// between them. Collective.
template <int Dim, class OfCell, class OfFace>
std::vector<double> net_over_rows(const Layout<Dim>& layout, const Communicator& ranks, const PressureRows<Dim>& rows,
                                  const OfCell& of_cell, const OfFace& of_face);

template <int Dim>
PressureRows<Dim> number_rows(const ProjectionInput<Dim>& in);

// Connected components without a face at a given pressure. Their pressure is determined up to a constant, and the
// prescribed fluxes around them must balance. Collective.
template <int Dim>
NullSpace find_closed_components(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows);

// Distance from a liquid cell's centre to the free surface towards an air cell, in cells, at least 1e-8. A larger lower
// bound would break hydrostatic rest (docs/decisions/0003-no-clamp-at-the-surface.md).
double surface_distance(double phi_liquid, double phi_air);

// The liquid's fraction theta of the link between two cell centres.
double liquid_part(double phi_low, double phi_high);

// Inverse density ratio rho/rho_f of the link between two cell centres: rho_f = theta rho + (1 - theta) rho_gas, theta
// the liquid's fraction of the link (Kang, Fedkiw, Liu 2000). Without gas it is 1/theta: the link ends at the surface.
template <int Dim>
double inverse_density_ratio_of_link(const ProjectionInput<Dim>& in, Site cell, Site across);
// Inverse density ratio of a cell: rho/rho_gas in gas, else 1.
template <int Dim>
double inverse_density_ratio_of_cell(const ProjectionInput<Dim>& in, Site cell);
// Jump p_low - p_high at the surface if it crosses the link of a face's cells, Pa; else 0.
template <int Dim>
double jump_over(const ProjectionInput<Dim>& in, int axis, Site face);

// The pressure system, with p = jump at the surface if there is no gas (Gibou et al. 2002; Ng, Min, Gibou 2009):
//   sum_f w rho/rho_f (p_i - p_j -+ jump) = -(rho h/dt) (sum_f +-(w u* + closed flux) + cell flux + missing flux).
// It is the volume balance of a cell (m^Dim/s) times h^(2-Dim) rho/dt. Collective.
template <int Dim>
DistributedMatrix assemble_pressure_matrix(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows);
template <int Dim>
std::vector<double> pressure_right_side(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                        const FaceField<Dim>& u);

// Net prescribed outflow of a closed component, and the sum of magnitudes of its prescribed fluxes (m^Dim/s each).
struct VolumeMismatch {
  double net = 0, scale = 0;
};
// Mismatch of the closed component with the largest |net|/scale. Collective.
template <int Dim>
VolumeMismatch worst_mismatch(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const NullSpace& closed);

// (p_high - p_low +- jump)/(rho_f h), m/s^2: minus the acceleration of a face by the pressure. Zero if neither cell has
// its own pressure.
template <int Dim>
double face_pressure_slope(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                           const CellField<Dim>& pressure, int axis, Site face);

template <int Dim>
RowGrid row_grid(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows);

// Sets the pressure of each region of enclosed air, in all its cells. For the liquid's given pressures, its volume
// balance then holds to round-off. Fills ghosts. Collective.
template <int Dim>
void equalise_air_pressure(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& u_star,
                           CellField<Dim>& pressure);

// Largest residual |net flux + missing flux|/h of the volume balance over the rows of all ranks, 1/s; fluxes per face
// area. Collective.
template <int Dim>
double max_divergence(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& u);

template <int Dim, class OfCell, class OfFace>
std::vector<double> net_over_rows(const Layout<Dim>& layout, const Communicator& ranks, const PressureRows<Dim>& rows,
                                  const OfCell& of_cell, const OfFace& of_face) {
  const auto net = [&](Site cell) {
    double sum = of_cell(cell);
    for_each_face_of(layout, cell, [&](int a, Site f, int sign, Site across) {
      const bool inside = rows.region(cell) >= 0 && rows.row[across] == rows.row[cell];
      if (!inside) sum += sign * of_face(a, f);
    });
    return sum;
  };
  std::vector<double> sums, of_air(rows.air_row.size());
  for (std::size_t n = 0; n < rows.liquid; ++n) sums.push_back(net(rows.cells[n]));
  if (of_air.empty()) return sums;
  for_each_index_in_order(layout, layout.cells(), [&](Site c, const IVec<Dim>&) {
    if (const std::int64_t k = rows.region(c); k >= 0) of_air[std::size_t(k)] += net(c);
  });
  ranks.global_sum(of_air);
  for (const auto& [k, cell] : rows.air->home) sums.push_back(of_air[std::size_t(k)]);
  return sums;
}

}  // namespace seiche
