#pragma once
// Redistancing: makes a level set a signed distance again near its zero without moving the zero.
#include "grid/halo.h"

namespace seiche {

struct RedistanceOptions {
  double band = 5;     // width of the band on each side, cells; beyond it phi = +-band
  int iterations = 8;  // each carries distance 0.45 cells outwards
  int entering = 2;    // layers beyond the band that may enter it: the interface's motion since the last call, cells
  // Width of closest-point redistancing on each side of the zero, cells; at most halo - 1. 0: relaxation only.
  double closest_point_cells = 0;
};

// Marks of cells for redistancing.
struct Kept {
  static constexpr char no = 0;
  static constexpr char yes = 1;     // it keeps phi, which is read
  static constexpr char unread = 2;  // it keeps phi; relaxation takes phi to go on straight there
};

// Redistances phi (m), except in cells that are kept (`kept`: a value of Kept). Fills ghosts. Collective.
//
// Relaxes |grad phi| = 1 in pseudo-time with second-order ENO differences that stop at the interface (Russo, Smereka
// 2000; du Chene, Min, Gibou 2008). This moves the zero by some 1e-3 cells per call, non-uniformly, so that volume
// drifts and curvature becomes noisy. Within `closest_point_cells` cells, closest-point redistancing is used instead:
// phi <- phi + w (d - phi), d the distance from the zero of the cubic interpolant (levelset/closest_point.h). The
// weight w grows from 0 at a relative error of 2 % to 1 at 10 %. The correction thus depends on the distortion of phi,
// not on the number of calls. If no closest point is found, phi stays if |grad phi| is within 0.1 of 1, and is relaxed
// otherwise.
template <int Dim>
void redistance(const Layout<Dim>& layout, const Halo<Dim>& halo, const RedistanceOptions& options, CellField<Dim>& phi,
                const CellField<Dim, char>* kept = nullptr);

// Halo exchange of a level set (m), and linear extension beyond the sides with slopes of at most 1.
template <int Dim>
void fill_level_set_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, CellField<Dim>& phi);

}  // namespace seiche
