#include "linalg/core/body_matrix.h"

#include <algorithm>
#include <numeric>

#include "linalg/core/dense_factors.h"
#include "linalg/core/shared_columns.h"

namespace seiche {
namespace {

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Rows of each connected part of the graph of H; parts ordered by their first rows.
std::vector<std::vector<int>> connected_parts(const SparseMatrix& H) {
  std::vector<int> parent(std::size_t(H.rows()));
  std::iota(parent.begin(), parent.end(), 0);
  for (int k = 0; k < H.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it) {
      const int a = root_of(parent, k), b = root_of(parent, int(it.row()));
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::vector<int>> list;
  std::vector<int> place(parent.size(), -1);  // in the list, of each root: the first row of its part
  for (int i = 0; i < int(parent.size()); ++i) {
    int& n = place[std::size_t(root_of(parent, i))];
    if (n < 0) n = int(list.size()), list.emplace_back();
    list[std::size_t(n)].push_back(i);
  }
  return list;
}

Eigen::VectorXd gathered(const Eigen::VectorXd& b, const std::vector<int>& rows) {
  return b(rows);
}

}  // namespace

void BodyMatrix::find_parts() {
  std::vector<Part> old = std::move(parts_);
  parts_.clear();
  shared_.clear();
  blocks_ = connected_parts(H_);
  for (std::vector<int> rows : blocks_) {
    if (int(rows.size()) <= shared_limit) {
      shared_.insert(shared_.end(), rows.begin(), rows.end());
      continue;
    }
    const auto known = std::find_if(old.begin(), old.end(), [&](const Part& p) { return p.rows == rows; });
    parts_.push_back({std::move(rows), 0, known != old.end() ? std::move(known->factor) : SparseCholesky()});
  }
  std::sort(shared_.begin(), shared_.end());
}

// Load of a rank: sum of n^2 over its parts, the cost of a factor in 3D with nested dissection.
void BodyMatrix::share_out() {
  std::vector<std::size_t> order(parts_.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts_[a].rows.size() > parts_[b].rows.size(); });
  std::vector<double> load(std::size_t(ranks_.size()), 0.0);
  for (const std::size_t p : order) {
    parts_[p].owner = int(std::min_element(load.begin(), load.end()) - load.begin());
    load[std::size_t(parts_[p].owner)] += std::pow(double(parts_[p].rows.size()), 2);
  }
}

SparseMatrix BodyMatrix::submatrix(const std::vector<int>& rows) const {
  std::vector<int> place(std::size_t(H_.rows()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[std::size_t(rows[i])] = int(i);
  SparseMatrix part(Eigen::Index(rows.size()), Eigen::Index(rows.size()));
  part.reserve(H_.nonZeros());
  for (const int k : rows) {
    part.startVec(place[std::size_t(k)]);
    for (SparseMatrix::InnerIterator it(H_, k); it; ++it)
      part.insertBack(place[std::size_t(it.row())], place[std::size_t(k)]) = it.value();
  }
  part.finalize();
  return part;
}

bool BodyMatrix::factor_shared() {
  if (shared_.empty()) return true;
  return shared_factor_.factor(parts_.empty() ? H_ : submatrix(shared_)) && shared_factor_.is_positive();
}

bool BodyMatrix::set(SparseMatrix H, const SparseMatrix& C) {
  H_.swap(H);  // Eigen 3.4 copies where it should move
  shared_out_ = false;
  find_parts();
  share_out();
  std::vector<std::vector<int>> small;
  for (const std::vector<int>& block : blocks_)
    if (block.size() <= SmallBlocks::most) small.push_back(block);
  all_small_ = small.size() == blocks_.size();
  bool good = small_.factor(H_, small) && (all_small_ || factor_shared());
  for (Part& part : parts_)
    if (good && part.owner == ranks_.rank()) good = part.factor.factor(submatrix(part.rows));
  constraints_ = {};
  if (ranks_.any(!good)) return false;
  if (C.rows() > 0) constraints_ = {C, solve_rows_freely(C)};
  return true;
}

// Columns of rigid bodies, which no other body shares, are solved for by themselves, so that they stay sparse.
SparseMatrix BodyMatrix::solve_rows_freely(const SparseMatrix& C) const {
  std::vector<Eigen::Triplet<double>> entries;
  SparseMatrix rest(C.rows(), C.cols());
  std::vector<Eigen::Triplet<double>> of_rest;
  small_.append_solved(C, entries);
  for (const std::vector<int>& block : blocks_)
    if (block.size() > SmallBlocks::most)
      for (const int k : block)
        for (SparseMatrix::InnerIterator it(C, k); it; ++it) of_rest.emplace_back(int(it.row()), k, it.value());
  SparseMatrix X(C.cols(), C.rows());
  X.setFromTriplets(entries.begin(), entries.end());
  if (of_rest.empty()) return X;
  rest.setFromTriplets(of_rest.begin(), of_rest.end());
  return X + SparseMatrix(solve_columns_freely(Eigen::MatrixXd(rest.transpose())).sparseView());
}

void BodyMatrix::keep(const SparseMatrix& H) {
  shared_out_ = ranks_.size() > 1;
  constraints_ = {};
  SparseMatrix own = with_columns(H, share_of_rank(int(H.cols()), ranks_));
  H_.swap(own);  // as in set()
}

Eigen::VectorXd BodyMatrix::diagonal() const {
  return shared_out_ ? shared_diagonal(H_, ranks_) : Eigen::VectorXd(H_.diagonal());
}

Eigen::VectorXd BodyMatrix::multiply(const Eigen::VectorXd& v) const {
  return shared_out_ ? multiply_shared(H_, v, ranks_) : Eigen::VectorXd(H_ * v);
}

Eigen::VectorXd BodyMatrix::prescribed(const Eigen::VectorXd& b) const {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(size());
  return constraints_.empty() ? none : constraints_.moved_onto(none, b);
}

Eigen::VectorXd BodyMatrix::multipliers_against(const Eigen::VectorXd& f) const {
  return -constraints_.multipliers(constraints_.rows() * solve_freely(f));
}

Eigen::VectorXd BodyMatrix::solve(const Eigen::VectorXd& b) const {
  const Eigen::VectorXd y = solve_freely(b);
  return constraints_.empty() ? y : constraints_.moved_onto(y, Eigen::VectorXd::Zero(constraints_.rows().rows()));
}

Eigen::MatrixXd BodyMatrix::solve_columns(const Eigen::MatrixXd& B) const {
  return constraints_.empty() ? solve_columns_freely(B) : constraints_.moved_onto_zero(solve_columns_freely(B));
}

Eigen::VectorXd BodyMatrix::solve_freely(const Eigen::VectorXd& b) const {
  if (all_small_) return small_.solve(b);
  if (parts_.empty()) return shared_.empty() ? b : shared_factor_.solve(b);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  for (const Part& part : parts_)
    if (part.owner == ranks_.rank()) x(part.rows) = part.factor.solve(gathered(b, part.rows));
  // Each sum has a single nonzero term, so there is no rounding.
  ranks_.global_sum(std::span<double>(x.data(), std::size_t(x.size())));
  // Assigned through a temporary vector: otherwise Eigen permutes within the rows of x and reads entries that it has
  // overwritten.
  if (!shared_.empty()) x(shared_) = shared_factor_.solve(gathered(b, shared_));
  return x;
}

Eigen::MatrixXd BodyMatrix::solve_columns_freely(const Eigen::MatrixXd& B) const {
  if (all_small_) return small_.solve_columns(B);
  if (parts_.empty()) return shared_.empty() ? B : shared_factor_.solve_columns(B);
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(B.rows(), B.cols());
  for (const Part& part : parts_)
    if (part.owner == ranks_.rank()) X(part.rows, Eigen::all) = part.factor.solve_columns(B(part.rows, Eigen::all));
  ranks_.global_sum(std::span<double>(X.data(), std::size_t(X.size())));  // without rounding, as in solve()
  if (!shared_.empty()) X(shared_, Eigen::all) = shared_factor_.solve_columns(B(shared_, Eigen::all));
  return X;
}

}  // namespace seiche
