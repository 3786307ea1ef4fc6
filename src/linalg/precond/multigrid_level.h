#pragma once
// One level of geometric multigrid on this rank: a matrix of 5 or 7 points,
//   (A x)_i = sum over faces f of c_f (x_i - x_j) + e_i x_i,  c_f, e_i >= 0,
// relaxed red-black, and what passes between two levels. A cell is red if the sum of its numbers is even.
#include "linalg/precond/block_exchange.h"
#include "linalg/precond/split_rows.h"

namespace seiche {

enum class Color { red, black };

// A red cell that does not belong to the coarse cell around it, `around`, but to a neighbour of that, `host`, or to
// none: 0. Places in storage.
struct Outsider {
  std::size_t cell, around, host;
  int odd;  // 1 for odd numbers along axis 0
};

template <int Dim>
class MultigridLevel {
 public:
  // `blocks`: the cells of all ranks. Everything is zero at first. Collective.
  MultigridLevel(std::vector<CellBox> blocks, const std::array<int, 3>& periodic, const Communicator& ranks);

  // Ghosts of a field whose values are known in own cells. Collective.
  void fill_ghosts(std::vector<float>& field);
  // From c_f, with ghosts, and e_i: 1 / a_ii, and which parts of the rows are in use.
  void finish(const std::vector<float>& excess);

  // Red then black, `sweeps` times, from x = 0. Collective.
  void relax_from_zero(int sweeps);
  // Black then red. Collective. The first pass does not look at the black values it finds.
  void relax_back(int sweeps);

  // b of the coarse level = sum over its cells' children of b - A x. After relax_from_zero, which leaves no residual in
  // black cells.
  void restrict_residual(MultigridLevel& coarse) const;
  // x of the red children += x of the coarse cells. Collective.
  void add_correction(const MultigridLevel& coarse);

  SplitRows<Dim> rows;
  std::vector<CellBox> blocks;  // of all ranks
  Communicator ranks;           // that share the level
  std::array<int, 3> periodic;
  std::vector<float> x, b, inverse;          // inverse is 0 in cells that have no equation
  std::array<std::vector<float>, Dim> face;  // c between a cell and the next one along each axis
  std::vector<Outsider> outsiders;

 private:
  // Entries of both half rows. From `even_begin` to `even_end` all c_f are c and e is 0: they need not be read.
  struct Span {
    int begin = 0, end = 0, even_begin = 0, even_end = 0;
    float c = 0;
  };
  float even_coefficient(std::size_t cell, int i) const;
  void find_even_part(Span& span, int j, int k) const;
  struct HalfRow;
  HalfRow half_row(std::size_t row, int j, int k, Color color) const;
  float residual(const Outsider& o) const;
  void relax(Color color);
  void scale_red();

  std::vector<Span> span_;  // of own rows
  BlockExchange all_, red_, black_;
};

}  // namespace seiche
