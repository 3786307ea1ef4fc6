#include "linalg/core/sparse_inverse.h"

#include <cmath>

#include "base/parallel_range.h"
#include "linalg/core/dense_factors.h"

namespace seiche {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

// Dense submatrix of H on the rows and columns S. `place` is -1 everywhere before and after.
Eigen::MatrixXd dense_part(const SparseMatrix& H, const std::vector<int>& S, std::vector<int>& place) {
  Eigen::MatrixXd part = Eigen::MatrixXd::Zero(Eigen::Index(S.size()), Eigen::Index(S.size()));
  for (std::size_t a = 0; a < S.size(); ++a) place[std::size_t(S[a])] = int(a);
  for (std::size_t a = 0; a < S.size(); ++a)
    for (SparseMatrix::InnerIterator it(H, S[a]); it; ++it)
      if (place[std::size_t(it.row())] >= 0) part(place[std::size_t(it.row())], Eigen::Index(a)) = it.value();
  for (const int s : S) place[std::size_t(s)] = -1;
  return part;
}

// Row i of G on its columns S: g = y/sqrt(y_i) with H_SS y = e_i.
void add_row(const SparseMatrix& H, const std::vector<char>& wanted, int i, std::vector<int>& place, Entries& entries) {
  std::vector<int> S;
  bool any = false;
  for (SparseMatrix::InnerIterator it(H, i); it && it.row() <= i; ++it) {
    S.push_back(int(it.row()));
    any = any || wanted[std::size_t(it.row())];
  }
  if (!any) return;
  const Eigen::MatrixXd part = dense_part(H, S, place);
  const Eigen::VectorXd y = DenseLlt(part).solve(Eigen::VectorXd::Unit(part.rows(), part.rows() - 1));
  for (std::size_t a = 0; a < S.size(); ++a)
    if (wanted[std::size_t(S[a])]) entries.emplace_back(i, S[a], y[Eigen::Index(a)] / std::sqrt(y[part.rows() - 1]));
}

}  // namespace

SparseMatrix sparse_inverse_factor(const SparseMatrix& H, const std::vector<char>& wanted) {
  constexpr std::size_t rows_a_task = 128;
  const auto n = std::size_t(H.rows());
  std::vector<Entries> parts(n / rows_a_task + 1);
  parallel_pieces(n, rows_a_task, [&](std::size_t begin, std::size_t end) {
    std::vector<int> place(n, -1);
    for (std::size_t i = begin; i < end; ++i) add_row(H, wanted, int(i), place, parts[begin / rows_a_task]);
  });
  Entries entries;
  for (const Entries& part : parts) entries.insert(entries.end(), part.begin(), part.end());
  SparseMatrix G(H.rows(), H.rows());
  G.setFromTriplets(entries.begin(), entries.end());
  return G;
}

}  // namespace seiche
