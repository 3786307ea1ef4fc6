#pragma once
// Search for the set of parted cells: 0 <= p, 0 <= net flux + missing flux, one of them zero.
#include "fluid/pressure/separation.h"

namespace seiche {

// Block principal pivoting (Judice, Pires 1994). Each round turns over all wrong guesses, which is policy iteration. A
// few rounds that do not lower their number are taken in; then one guess a round is turned over, the last in the order
// of the cells, until there are fewer than ever (Murty's rule, which ends for each positive definite matrix).
template <int Dim>
class SeparationSearch {
 public:
  // Starts from the cells that were parted already. Keeps references. Collective.
  SeparationSearch(const ProjectionInput<Dim>& in, double tolerance, Separation<Dim>& separation);

  // What a solution for the present guess says of it; true: it is right, or the search was over. Else the next guess
  // stands in `parting`, after the last round the one that was least wrong. Collective.
  bool has_converged_with(const PressureRows<Dim>& rows, const std::vector<int>& closed_component,
                          const CellField<Dim>& pressure, const FaceField<Dim>& u_star);

  // How wrong the guess is that the search went on with: pull or squeeze over the largest pressure; 0: it is right.
  double error() const { return error_; }

 private:
  void turn_over(const WrongGuesses& wrong);
  void turn_over_last(const WrongGuesses& wrong);
  double number(Site cell) const;

  const ProjectionInput<Dim>& in_;
  double tolerance_;
  Separation<Dim>& separation_;
  CellField<Dim, char> eligible_, best_;
  double least_ = 1e300;             // error of the best guess
  std::int64_t fewest_ = INT64_MAX;  // wrong guesses of any round
  int rounds_ = 0, fruitless_ = 0;
  double error_ = 0;
};

}  // namespace seiche
