#pragma once
// Search for the set of separated cells: 0 <= p complementary to 0 <= net flux + missing flux.
#include "fluid/pressure/separation.h"

namespace seiche {

// Block principal pivoting (Judice, Pires 1994). Each round flips all wrong guesses, which is policy iteration. After
// five rounds without progress it flips only the last wrong guess in the order of the cells (Murty's rule, which
// terminates for positive definite matrices). It flips all again once there are fewer wrong ones than ever before. At
// most 50 rounds.
template <int Dim>
class SeparationSearch {
 public:
  // Starts from the guess `earlier`, or from the cells with an open gap if it is null or empty. Keeps references to
  // `in` and `separation`. Collective.
  SeparationSearch(const ProjectionInput<Dim>& in, double tolerance, const CellField<Dim, char>* earlier,
                   Separation<Dim>& separation);

  // Compares the current guess with its solution. Returns true if the guess is right or was the last one. Otherwise
  // writes the next guess to `separation`; after the last round, this is the guess with the smallest error. Collective.
  bool has_converged_with(const PressureRows<Dim>& rows, const std::vector<int>& closed_component,
                          const CellField<Dim>& pressure, const FaceField<Dim>& u_star);

  // Error of the last checked guess (WrongGuesses::worst); 0 if it is right.
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
  std::int64_t fewest_ = INT64_MAX;  // smallest number of wrong guesses so far
  int rounds_ = 0, fruitless_ = 0;
  double error_ = 0;
};

}  // namespace seiche
