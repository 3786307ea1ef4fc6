#pragma once
// Makes a level set a signed distance again near its zero without moving the zero.
#include "grid/halo.h"

namespace seiche {

struct RedistanceOptions {
  double band = 5;     // cells on each side within which phi is kept; beyond it is +-band
  int iterations = 8;  // each carries distance 0.45 cells outwards
  int entering = 2;    // layers beyond the band that may enter it: what the interface moved since the last call
  // Cells from the zero within which phi follows from the nearest points of its zero; at most halo - 1.
  double closest_point_cells = 0;
};

// Pseudo-time relaxation of |grad phi| = 1 with second-order ENO differences that stop at the interface (Russo, Smereka
// 2000; du Chene, Min, Gibou 2008). Cells where `kept` is set are read but keep phi. Fills ghosts. Collective. The
// relaxation moves the zero by some 1e-3 cells a call, by another amount at each place, which adds up to volume and
// which curvature feels. Within `settled` cells phi goes over to its distance from the nearest point of the zero of its
// cubic interpolant instead (levelset/closest_point.h), none of the way where it is 2 % off, all of it from 10 % on:
// what strains phi sets how much of it is done, not the number of calls. Where that finds no foot, phi stays if |grad
// phi| is within a tenth of 1 and is relaxed otherwise.
template <int Dim>
void redistance(const Layout<Dim>& layout, const Halo<Dim>& halo, const RedistanceOptions& options, CellField<Dim>& phi,
                const CellField<Dim, char>* kept = nullptr);

// Halo exchange and straight continuation beyond the sides, as level sets need it.
template <int Dim>
void fill_level_set_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, CellField<Dim>& phi);

}  // namespace seiche
