#include "fluid/pressure/separation_search.h"

#include "fluid/pressure/pressure.h"

namespace seiche {
namespace {

constexpr int most_rounds = 50;
constexpr int most_fruitless = 5;  // rounds that flip all wrong guesses although their number does not decrease

}  // namespace

template <int Dim>
SeparationSearch<Dim>::SeparationSearch(const ProjectionInput<Dim>& in, double tolerance,
                                        const CellField<Dim, char>* earlier, Separation<Dim>& separation)
    : in_(in), tolerance_(tolerance), separation_(separation) {
  if (earlier && !earlier->empty())
    separation.separated = *earlier;
  else
    start_separation(in, separation);
  best_ = separation.separated;
}

template <int Dim>
bool SeparationSearch<Dim>::has_converged_with(const PressureRows<Dim>& rows, const std::vector<int>& closed_component,
                                               const CellField<Dim>& pressure, const FaceField<Dim>& u_star) {
  if (rounds_ == 0) eligible_ = cells_that_may_part(in_, rows, closed_component);
  const WrongGuesses wrong = find_wrong_guesses(in_, rows, pressure, u_star, eligible_, tolerance_, separation_);
  error_ = wrong.worst;
  if (wrong.count == 0 || rounds_ == most_rounds) return true;
  if (wrong.worst < least_) least_ = wrong.worst, best_ = separation_.separated;
  fruitless_ = wrong.count < fewest_ ? 0 : fruitless_ + 1;
  fewest_ = std::min(fewest_, wrong.count);
  if (++rounds_ == most_rounds)
    separation_.separated = best_;
  else if (fruitless_ <= most_fruitless)
    turn_over(wrong);
  else
    turn_over_last(wrong);
  in_.halo.fill_ghosts({separation_.separated.data()});
  return false;
}

template <int Dim>
void SeparationSearch<Dim>::turn_over(const WrongGuesses& wrong) {
  for (const Site c : wrong.cells) separation_.separated[c] = !separation_.separated[c];
}

template <int Dim>
void SeparationSearch<Dim>::turn_over_last(const WrongGuesses& wrong) {
  double last = -1;
  for (const Site c : wrong.cells) last = std::max(last, number(c));
  last = in_.ranks.global_max(last);
  for (const Site c : wrong.cells)
    if (number(c) == last) separation_.separated[c] = !separation_.separated[c];
}

// Global number of a cell, which does not depend on the number of ranks.
template <int Dim>
double SeparationSearch<Dim>::number(Site cell) const {
  const IVec<Dim> i = in_.layout.index(cell);
  double n = 0;
  for (int a = Dim - 1; a >= 0; --a) n = n * in_.layout.geometry().cells[a] + i[a];
  return n;
}

template class SeparationSearch<2>;
template class SeparationSearch<3>;

}  // namespace seiche
