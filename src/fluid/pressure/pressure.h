#pragma once
// Variational cut-cell pressure projection with a second-order free surface: rows, components, matrix, update.
#include <string>

#include "fluid/boundary/face_geometry.h"
#include "fluid/pressure/air_regions.h"
#include "fluid/pressure/separation.h"
#include "grid/halo.h"
#include "grid/loops.h"
#include "linalg/spd/solve.h"

namespace seiche {

// Everything the projection reads. phi and geometry must be valid one cell around the owned ones.
template <int Dim>
struct ProjectionInput {
  const Layout<Dim>& layout;
  const Halo<Dim>& halo;
  const Communicator& ranks;
  const CellField<Dim>& phi;
  const FaceGeometry<Dim>& faces;
  double density;                               // kg/m^3
  double dt;                                    // s
  const Separation<Dim>* separation = nullptr;  // where liquid may part from solids
  double gas_density = 0;                       // kg/m^3; 0: beyond the surface there is no more than a pressure of 0
  // p_liquid - p_gas where the surface crosses the link of a face's two cells, Pa; null: 0 everywhere.
  const FaceField<Dim>* surface_jump = nullptr;
  const AirRegions<Dim>* air = nullptr;  // enclosed air that keeps its volume; null: none does

  bool has_gas() const { return gas_density > 0; }
  bool is_liquid(Site cell) const { return phi[cell] < 0; }
  bool is_separated(Site cell) const { return separation && separation->separated[cell]; }
  // Flux that a cell must take in before it is full, per face area, m/s.
  double missing_flux(Site cell) const { return separation ? separation->gap[cell] * layout.h() / dt : 0; }
};

// The unknowns: one row a cell of liquid, or gas that flows, that an open face touches and that has not parted.
template <int Dim>
struct PressureRows {
  static constexpr std::int64_t no_row = -1, separated_row = -2;
  // Global row, no_row or separated_row (p = 0), filled one cell around; of enclosed air that of its region.
  CellField<Dim, std::int64_t> row;
  std::vector<Site> cells;  // owned cells with a row, in row order, and then one cell a region of air
  std::size_t liquid = 0;   // so many of them are no region's
  Row first = 0, global = 0;
  std::int64_t isolated = 0;  // liquid cells without an open face, over all ranks
  const AirRegions<Dim>* air = nullptr;
  std::vector<Row> air_row;  // of each region, the same on all ranks

  // Region of enclosed air a cell belongs to, or -1.
  std::int64_t region(Site cell) const { return air ? std::max<std::int64_t>(air->label[cell], -1) : -1; }
  bool has_own(Site cell) const { return row[cell] >= 0 && region(cell) < 0; }
  bool is_separated(Site cell) const { return row[cell] == separated_row; }
  // Whether a cell has a pressure of its own, be it solved for or, where the cell has parted, zero. It does not depend
  // on the guess of which cells part: masses of faces hang on it, and the policy iteration needs one matrix.
  bool has_pressure(Site cell) const { return has_own(cell) || is_separated(cell); }
  bool touch_pressure(Site low, Site high) const { return has_pressure(low) || has_pressure(high); }
  bool owns(Row r) const { return r >= first && r < first + Row(cells.size()); }
};

// sum_f +- of_face(axis, f) + of_cell(cell) of each row: of a region of air summed over its cells, the faces between
// them left out. Collective.
template <int Dim, class OfCell, class OfFace>
std::vector<double> net_over_rows(const Layout<Dim>& layout, const Communicator& ranks, const PressureRows<Dim>& rows,
                                  const OfCell& of_cell, const OfFace& of_face);

template <int Dim>
PressureRows<Dim> number_rows(const ProjectionInput<Dim>& in);

// Connected liquid without a face at a given pressure: its pressure is free up to a constant, and the volume prescribed
// around it must balance.
template <int Dim>
NullSpace find_closed_components(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows);

// Distance from a liquid cell's centre to the free surface towards an air cell, in cells. Clamped at 1e-8: any clamp
// large enough to matter breaks hydrostatic rest (docs/decisions/0003).
double surface_distance(double phi_liquid, double phi_air);

// The liquid's part of the link between two cells' centres.
double liquid_part(double phi_low, double phi_high);

// rho/rho_f: the liquid's density over that of the link between the centres of two cells, theta rho + (1 - theta)
// rho_gas with the liquid's part theta of it (Kang, Fedkiw, Liu 2000). Without gas 1/theta: the surface ends the link.
template <int Dim>
double inverse_density_ratio_of_link(const ProjectionInput<Dim>& in, Site cell, Site across);
// rho over the density of a cell.
template <int Dim>
double inverse_density_ratio_of_cell(const ProjectionInput<Dim>& in, Site cell);
// p_low - p_high at the surface where it crosses the link of a face's cells, Pa; else 0.
template <int Dim>
double jump_over(const ProjectionInput<Dim>& in, int axis, Site face);

// sum_f w rho/rho_f (p_i - p_j -+ jump) = -(rho h/dt) sum_f +-(w u* + closed flux); without gas p = jump at the surface
// (Gibou et al. 2002; Ng, Min, Gibou 2009). Scaled by h^(2-Dim) rho/dt.
template <int Dim>
DistributedMatrix assemble_pressure_matrix(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows);
template <int Dim>
std::vector<double> pressure_right_side(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                        const FaceField<Dim>& u);

// Net volume a closed component is told to gain, and the largest volume moved around it (m^Dim/s each).
struct VolumeMismatch {
  double net = 0, scale = 0;
};
template <int Dim>
VolumeMismatch worst_mismatch(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const NullSpace& closed);

// (p_high - p_low +- jump)/(rho_f h): the acceleration the pressure gives a face, sign turned. Zero where no row
// touches.
template <int Dim>
double face_pressure_slope(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                           const CellField<Dim>& pressure, int axis, Site face);

template <int Dim>
RowGrid row_grid(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows);

// Gives each region of enclosed air the pressure at which just as much flows in as out, to rounding, and all its cells
// that pressure. Ghosts filled. Collective.
template <int Dim>
void equalise_air_pressure(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& u_star,
                           CellField<Dim>& pressure);

// Largest |net flux|/cell volume over the rows, 1/s, over all ranks.
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
