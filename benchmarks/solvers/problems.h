#pragma once
// Pressure systems on a box of cells as the program makes them: ghost-fluid surfaces, jumps of density, cut cells.
#include <array>
#include <functional>
#include <string>

#include "linalg/core/distributed_matrix.h"

namespace seiche::problems {

using Point = std::array<double, 3>;  // in units of the longest side of the box

struct Problem {
  std::string name;
  std::array<int, 3> cells{1, 1, 1};
  int dimension = 3;
  std::function<double(const Point&)> liquid;  // phi, < 0 inside
  std::function<double(const Point&)> solid;   // phi, < 0 inside; none: no solids
  double gas_density = 0;                      // relative to the liquid's; 0: outside of the liquid pressure is held
};

struct System {
  DistributedMatrix A;
  RowGrid grid;
  NullSpace null_space;
};

System build(const Problem& problem);

// A box 47 % full under a sloping surface; a drop over a pool in gas of a thousandth of the density, all walls closed.
Problem sloping_surface(std::array<int, 3> cells);
Problem drop_in_gas(std::array<int, 3> cells);
// With 20 balls, or 200 discs in 2D, anywhere; with a third of the cells solid.
Problem with_balls(Problem problem, int count, double radius);
Problem with_pores(Problem problem);
// Liquid everywhere between closed walls.
Problem full_box(std::array<int, 3> cells);

}  // namespace seiche::problems
