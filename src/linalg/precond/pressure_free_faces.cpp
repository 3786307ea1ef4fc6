#include "linalg/precond/pressure_free_faces.h"

#include <algorithm>
#include <cstring>

#include "linalg/core/matrix_entries.h"

namespace seiche {
namespace {

template <class T>
std::vector<T> of_all_ranks(const std::vector<T>& mine, const Communicator& ranks) {
  std::string all;
  for (const std::string& part :
       ranks.all_gather(std::string(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(T))))
    all += part;
  std::vector<T> items(all.size() / sizeof(T));
  if (!all.empty()) std::memcpy(static_cast<void*>(items.data()), all.data(), all.size());
  return items;
}

// Loose rows that a chain of loose rows of this rank joins to one of another rank; flags with ghosts.
std::vector<char> find_shared(const LinearSystem& F, const Vector& flags) {
  const DistributedMatrix& P = F.pattern();
  std::vector<char> shared(std::size_t(F.rows()), 0);
  std::vector<int> next;
  const auto for_each_pressure_free = [&](int i, auto visit) {
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k) {
      const int j = F.halo().local_index(P.column[std::size_t(k)]);
      if (flags[std::size_t(j)] != 0) visit(j);
    }
  };
  const auto reach = [&](int i) {
    if (!shared[std::size_t(i)]) shared[std::size_t(i)] = 1, next.push_back(i);
  };
  for (int i = 0; i < F.rows(); ++i)
    if (flags[std::size_t(i)] != 0)
      for_each_pressure_free(i, [&](int j) {
        if (j >= F.rows()) reach(i);
      });
  while (!next.empty()) {
    const int i = next.back();
    next.pop_back();
    for_each_pressure_free(i, [&](int j) {
      if (j < F.rows()) reach(j);
    });
  }
  return shared;
}

// F on `rows`, by global number and ascending, from entries of all of them.
SparseMatrix assemble(const std::vector<MatrixEntry>& entries, const std::vector<Row>& rows) {
  std::vector<Eigen::Triplet<double>> triplets;
  const auto place = [&](Row row) { return int(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin()); };
  for (const MatrixEntry& e : entries) triplets.emplace_back(place(e.row), place(e.column), e.value);
  SparseMatrix part(Eigen::Index(rows.size()), Eigen::Index(rows.size()));
  part.setFromTriplets(triplets.begin(), triplets.end());
  return part;
}

// Entries of F in `rows` whose columns are loose.
std::vector<MatrixEntry> pressure_free_entries(const LinearSystem& F, const std::vector<int>& rows,
                                               const Vector& flags) {
  const DistributedMatrix& P = F.pattern();
  std::vector<MatrixEntry> entries;
  for (const int i : rows)
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k) {
      const Row column = P.column[std::size_t(k)];
      if (flags[std::size_t(F.halo().local_index(column))] != 0)
        entries.push_back({P.first_row + i, column, F.values()[std::size_t(k)]});
    }
  return entries;
}

std::vector<Row> numbered(const std::vector<int>& rows, Row first) {
  std::vector<Row> global;
  for (const int i : rows) global.push_back(first + i);
  return global;
}

Eigen::VectorXd taken(const Vector& r, const std::vector<int>& rows) {
  Eigen::VectorXd b(Eigen::Index(rows.size()));
  for (std::size_t n = 0; n < rows.size(); ++n) b[Eigen::Index(n)] = r[std::size_t(rows[n])];
  return b;
}

}  // namespace

PressureFreeRows::PressureFreeRows(const LinearSystem& F, const std::vector<char>& pressure_free) : ranks_(F.ranks()) {
  Vector flags(pressure_free.begin(), pressure_free.end());
  flags.resize(std::size_t(F.rows() + F.halo().ghosts()), 0.0);
  F.halo().fill_ghosts(flags);
  const std::vector<char> shared = find_shared(F, flags);
  for (int i = 0; i < F.rows(); ++i)
    if (pressure_free[std::size_t(i)]) (shared[std::size_t(i)] ? shared_ : own_).push_back(i);
  if (!own_.empty())
    good_ = own_factor_.factor(assemble(pressure_free_entries(F, own_, flags), numbered(own_, F.pattern().first_row)));
  factor_shared(F, flags);
  good_ = !ranks_.any(!good_);
}

void PressureFreeRows::factor_shared(const LinearSystem& F, const Vector& flags) {
  const std::vector<Row> rows = of_all_ranks(numbered(shared_, F.pattern().first_row), ranks_);
  shared_rows_ = Eigen::Index(rows.size());
  shared_first_ = std::lower_bound(rows.begin(), rows.end(), F.pattern().first_row) - rows.begin();
  if (rows.empty()) return;
  good_ =
      shared_factor_.factor(assemble(of_all_ranks(pressure_free_entries(F, shared_, flags), ranks_), rows)) && good_;
}

void PressureFreeRows::add_solved(const Vector& r, Vector& z) const {
  const auto add = [&](const Eigen::VectorXd& x, Eigen::Index first, const std::vector<int>& rows) {
    for (std::size_t n = 0; n < rows.size(); ++n) z[std::size_t(rows[n])] += x[first + Eigen::Index(n)];
  };
  if (!own_.empty()) add(own_factor_.solve(taken(r, own_)), 0, own_);
  if (shared_rows_ == 0) return;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(shared_rows_);
  b.segment(shared_first_, Eigen::Index(shared_.size())) = taken(r, shared_);
  ranks_.global_sum(std::span<double>(b.data(), std::size_t(b.size())));
  add(shared_factor_.solve(b), shared_first_, shared_);
}

// I - z-operator F = (I - S F)(I - B F)(I - S F), S the solve on the loose faces
void PressureFreeFaces::apply(const Vector& r, Vector& z) {
  Vector first(r.size(), 0.0), rest(r.size());
  pressure_free_.add_solved(r, first);
  F_.residual(r, first, rest);
  B_->apply(rest, z);
  add_scaled(z, 1, first);
  F_.residual(r, z, rest);
  pressure_free_.add_solved(rest, z);
}

}  // namespace seiche
