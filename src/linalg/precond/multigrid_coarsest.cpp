#include "linalg/precond/multigrid_coarsest.h"

#include "linalg/core/symmetric_eigen.h"

namespace seiche {
namespace {

// The matrix of a level on the cells that carry an equation.
template <int Dim>
Eigen::MatrixXd dense(const MultigridLevel<Dim>& level, const std::vector<float>& excess,
                      const std::vector<std::size_t>& cells) {
  const auto n = Eigen::Index(cells.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  std::vector<int> number(level.rows.size(), -1);
  for (Eigen::Index i = 0; i < n; ++i) number[cells[std::size_t(i)]] = int(i);
  Eigen::Index i = 0;
  for_each_cell(level.rows.cells, [&](std::array<int, 3> c) {
    const std::size_t cell = level.rows.at(c);
    if (number[cell] < 0) return;
    A(i, i) += excess[cell];
    for (int a = 0; a < Dim; ++a) {
      if (level.face[a][cell] == 0) continue;
      std::array<int, 3> next = c;
      if (++next[a] == level.periodic[a]) next[a] = 0;
      const Eigen::Index j = number[level.rows.at(next)];
      const double w = level.face[a][cell];
      A(i, i) += w, A(j, j) += w, A(i, j) -= w, A(j, i) -= w;
    }
    ++i;
  });
  return A;
}

}  // namespace

template <int Dim>
CoarsestSolve<Dim>::CoarsestSolve(const MultigridLevel<Dim>& level, const std::vector<float>& excess) {
  for_each_cell(level.rows.cells, [&](const std::array<int, 3>& c) {
    if (level.inverse[level.rows.at(c)] > 0) cell_.push_back(level.rows.at(c));
  });
  const auto n = Eigen::Index(cell_.size());
  rhs_.resize(cell_.size());
  inverse_.resize(cell_.size() * cell_.size());
  if (n == 0) return;
  // Scaled to a unit diagonal: coefficients of gas are 1000 times those of liquid.
  const Eigen::MatrixXd A = dense(level, excess, cell_);
  const Eigen::VectorXd s = A.diagonal().cwiseSqrt().cwiseInverse();
  const SymmetricEigen eigen = symmetric_eigen(s.asDiagonal() * A * s.asDiagonal());
  constexpr double zero = 1e-11;
  const Eigen::VectorXd kept = eigen.values.unaryExpr([](double v) { return v > zero ? 1 / v : 0.0; });
  Eigen::Map<Eigen::MatrixXd>(inverse_.data(), n, n) =
      s.asDiagonal() * eigen.vectors * kept.asDiagonal() * eigen.vectors.transpose() * s.asDiagonal();
}

template <int Dim>
void CoarsestSolve<Dim>::apply(MultigridLevel<Dim>& level) {
  const std::size_t n = cell_.size();
  for (std::size_t i = 0; i < n; ++i) rhs_[i] = level.b[cell_[i]];
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += inverse_[i * n + j] * rhs_[j];
    level.x[cell_[i]] = float(sum);
  }
}

template class CoarsestSolve<2>;
template class CoarsestSolve<3>;

}  // namespace seiche
