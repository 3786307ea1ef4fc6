#include "linalg/loose_faces.h"

namespace seiche {
namespace {

// Without those that touch loose faces of ranks before this one: solves at once must not meet.
std::vector<int> choose_rows(const LinearSystem& F, const std::vector<char>& loose) {
  const DistributedMatrix& P = F.pattern();
  Vector flags(loose.begin(), loose.end());
  flags.resize(std::size_t(F.rows() + F.halo().ghosts()), 0.0);
  F.halo().fill_ghosts(flags);
  std::vector<int> rows;
  for (int i = 0; i < F.rows(); ++i) {
    bool meets = false;
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
      meets = meets || (P.column[k] < P.first_row && flags[std::size_t(F.halo().local_index(P.column[k]))] != 0);
    if (loose[std::size_t(i)] && !meets) rows.push_back(i);
  }
  return rows;
}

SparseMatrix submatrix(const LinearSystem& F, const std::vector<int>& rows) {
  const DistributedMatrix& P = F.pattern();
  std::vector<int> place(std::size_t(F.rows()), -1);
  for (std::size_t n = 0; n < rows.size(); ++n) place[std::size_t(rows[n])] = int(n);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (int k = P.row_start[rows[n]]; k < P.row_start[rows[n] + 1]; ++k) {
      const Row column = P.column[k] - P.first_row;
      if (column < 0 || column >= F.rows() || place[std::size_t(column)] < 0) continue;
      entries.emplace_back(int(n), place[std::size_t(column)], F.values()[k]);
    }
  SparseMatrix part(Eigen::Index(rows.size()), Eigen::Index(rows.size()));
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

}  // namespace

LooseFaces::LooseFaces(const LinearSystem& F, const std::vector<char>& loose, std::unique_ptr<Preconditioner> B)
    : F_(F), B_(std::move(B)), rows_(choose_rows(F, loose)) {
  if (!rows_.empty()) good_ = factor_.factor(submatrix(F, rows_));
}

void LooseFaces::add_solved(const Vector& r, Vector& z) const {
  if (rows_.empty()) return;
  Eigen::VectorXd b(Eigen::Index(rows_.size()));
  for (std::size_t n = 0; n < rows_.size(); ++n) b[Eigen::Index(n)] = r[std::size_t(rows_[n])];
  const Eigen::VectorXd x = factor_.solve(b);
  for (std::size_t n = 0; n < rows_.size(); ++n) z[std::size_t(rows_[n])] += x[Eigen::Index(n)];
}

// I - z-operator F = (I - S F)(I - B F)(I - S F), S the solve on the loose faces
void LooseFaces::apply(const Vector& r, Vector& z) {
  Vector first(r.size(), 0.0), rest(r.size());
  add_solved(r, first);
  F_.residual(r, first, rest);
  B_->apply(rest, z);
  add_scaled(z, 1, first);
  F_.residual(r, z, rest);
  add_solved(rest, z);
}

}  // namespace seiche
