#pragma once
// Drops: liquid too little for a cell of its own, which flies as points (coupling/drops).
#include <cmath>
#include <cstdint>
#include <vector>

#include "grid/layout.h"

namespace seiche {

template <int Dim>
struct Drop {
  Vec<Dim> place, velocity;  // m, m/s
  double volume;             // m^Dim
  std::int64_t id;           // step of its making times the cells of the domain, plus its cell
};

// Radius (m) of the ball, in 2D the disc, with a volume.
template <int Dim>
double radius_of_drop(double volume) {
  constexpr double pi = 3.14159265358979323846;
  return Dim == 2 ? std::sqrt(volume / pi) : std::cbrt(0.75 * volume / pi);
}

template <int Dim>
struct Drops {
  std::vector<Drop<Dim>> list;  // those in cells of this rank, by id
  double left_out = 0;          // volume of drops that were not kept (liquid.spray = false), so far, m^Dim
  double made = 0;              // sum of V |v|^2/2 of those made in the last step, over all ranks, m^(Dim+2)/s^2
};

// Sorts drops by id.
template <int Dim>
void sort_drops(std::vector<Drop<Dim>>& drops);

// Drops as numbers, and back.
template <int Dim>
std::vector<double> pack_drops(const std::vector<Drop<Dim>>& drops);
template <int Dim>
std::vector<Drop<Dim>> unpack_drops(const std::vector<double>& numbers);

// Index of the cell around x.
template <int Dim>
IVec<Dim> cell_around(const Geometry<Dim>& grid, const Vec<Dim>& x) {
  IVec<Dim> cell;
  for (int a = 0; a < Dim; ++a) cell[a] = int(std::floor((x[a] - grid.lower[a]) / grid.h));
  return cell;
}

}  // namespace seiche
