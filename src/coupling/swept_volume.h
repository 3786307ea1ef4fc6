#pragma once
// The volume that elastic bodies sweep in liquid without a free surface: what their faces show is made to add up to
// what their surface does (docs/method.md, "Sealed liquid").
#include "coupling/state.h"

namespace seiche {

// An entry of J: what the velocity `column` of a body takes out of a cell, per face area.
struct FluxEntry {
  int row, column;  // the row is this rank's
  double value;
};

// The wall of a cavity with liquid without a free surface in it. Its flux adds up to what it sweeps:
//   sum_c (J w)_c = -(dV/du)(u + H w_0/2) w,  V the volume that it encloses, w_0 the velocities before.
// V is not linear in w. What is missing is a flux of its own, the same out of each cell that the part touches.
template <int Dim>
struct SweptSurface {
  const ElasticSolid<Dim>* solid;
  int body, part;
  int first;                    // unknown of the body in the coupling
  Eigen::VectorXd u, gradient;  // at the start of the interval; dV/du as above
  double horizon;               // H, s
  double volume;                // V at the end of the interval, m^Dim: what it was, or what sealed liquid keeps it at
  double face_area;             // m^(Dim - 1)
  std::vector<int> rows;        // this rank's that it touches
  double row_count = 0;         // over all ranks

  // Flux out of each of the rows, per face area (m/s), with which V(u + H w) = volume to first order about w.
  double missing_flux(const Eigen::VectorXd& w) const;
};

// Adds to the entries of the body k what makes the walls of its cavities with closed liquid sweep what they do, with
// the least change in the sum of squares; forces of a uniform pressure gradient stay as they were. Collective.
template <int Dim>
std::vector<SweptSurface<Dim>> correct_swept_volume(const Setup<Dim>& setup, const PressureRows<Dim>& rows,
                                                    const NullSpace& closed, const ElasticMotion& motion, int k,
                                                    int first, double horizon, std::vector<FluxEntry>& entries);

}  // namespace seiche
