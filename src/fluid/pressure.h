#pragma once
// Variational cut-cell pressure projection with a second-order free surface: rows, components, matrix, update.
#include <string>

#include "fluid/face_geometry.h"
#include "fluid/parting.h"
#include "grid/halo.h"
#include "linalg/solve.h"

namespace seiche {

// Everything the projection reads. phi and geometry must be valid one cell around the owned ones.
template <int Dim>
struct ProjectionInput {
  const Layout<Dim>& layout;
  const Halo<Dim>& halo;
  const Communicator& ranks;
  const CellField<Dim>& phi;
  const FaceGeometry<Dim>& faces;
  double density;                         // kg/m^3
  double dt;                              // s
  const Parting<Dim>* parting = nullptr;  // where liquid may part from solids
  double gas_density = 0;                 // kg/m^3; 0: beyond the surface there is no more than a pressure of 0
  // p_liquid - p_gas where the surface crosses the link of a face's two cells, Pa; null: 0 everywhere.
  const FaceField<Dim>* surface_jump = nullptr;

  bool has_gas() const { return gas_density > 0; }
  bool is_liquid(Site cell) const { return phi[cell] < 0; }
  bool is_parted(Site cell) const { return parting && parting->parted[cell]; }
  // Flux that a cell must take in before it is full, per face area, m/s.
  double missing_flux(Site cell) const { return parting ? parting->gap[cell] * layout.h() / dt : 0; }
};

// The unknowns: one row a cell of liquid, or gas that flows, that an open face touches and that has not parted.
template <int Dim>
struct PressureRows {
  CellField<Dim, std::int64_t> row;  // global row or -1, filled one cell around
  std::vector<Site> cells;           // owned cells with a row, in row order
  Row first = 0, global = 0;
  std::int64_t isolated = 0;  // liquid cells without an open face, over all ranks
};

template <int Dim>
PressureRows<Dim> number_rows(const ProjectionInput<Dim>& in);

// Connected liquid without a face at a given pressure: its pressure is free up to a constant, and the volume prescribed
// around it must balance.
template <int Dim>
NullSpace find_closed_components(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows);

// Distance from a liquid cell's centre to the free surface towards an air cell, in cells. Clamped at 1e-8: any clamp
// large enough to matter breaks hydrostatic rest (docs/decisions/0003).
double surface_distance(double phi_liquid, double phi_air);

// rho/rho_f: the liquid's density over that of the link between the centres of two cells, theta rho + (1 - theta)
// rho_gas with the liquid's part theta of it (Kang, Fedkiw, Liu 2000). Without gas 1/theta: the surface ends the link.
template <int Dim>
double link_lightness(const ProjectionInput<Dim>& in, Site cell, Site across);
// rho over the density of a cell.
template <int Dim>
double cell_lightness(const ProjectionInput<Dim>& in, Site cell);
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

// Largest |net flux|/cell volume over the rows, 1/s, over all ranks.
template <int Dim>
double max_divergence(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& u);

}  // namespace seiche
