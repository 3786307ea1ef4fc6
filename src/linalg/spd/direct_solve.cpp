#include "linalg/spd/direct_solve.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cstring>

#include "linalg/core/sparse_ldlt.h"

namespace seiche {
namespace {

struct Entry {
  std::int32_t row, column;
  double value;
};

struct RowData {
  double b;
  std::int32_t component;
};

template <class T>
std::string to_bytes(const std::vector<T>& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

// Items of all ranks on rank 0, in the order of the ranks; empty elsewhere.
template <class T>
std::vector<T> gather(const std::vector<T>& items, const Communicator& ranks) {
  std::string all;
  for (const std::string& part : ranks.gather(to_bytes(items))) all += part;
  std::vector<T> result(all.size() / sizeof(T));
  if (!all.empty()) std::memcpy(result.data(), all.data(), all.size());
  return result;
}

// Entries of A and, if bodies are coupled, of J and J'. Unknowns of bodies follow those of A.
std::vector<Entry> local_entries(const CoupledSystem& coupled) {
  const LinearSystem& system = coupled.liquid();
  const DistributedMatrix& A = system.pattern();
  std::vector<Entry> entries;
  for (int i = 0; i < A.rows(); ++i) {
    for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k) {
      entries.push_back({std::int32_t(A.first_row + i), std::int32_t(A.column[k]), system.values()[k]});
    }
  }
  if (!coupled.is_coupled()) return entries;
  coupled.columns().for_each([&](int i, int k, double value) {
    const auto row = std::int32_t(A.first_row + i), column = std::int32_t(A.global_rows + k);
    entries.push_back({row, column, value});
    entries.push_back({column, row, value});
  });
  return entries;
}

// Right-hand side and component of each row; -1 for components that bodies feel, which need no grounding.
std::vector<RowData> local_rows(const CoupledSystem& coupled, const Vector& b) {
  std::vector<RowData> rows;
  const auto& component = coupled.liquid().null_space().component;
  const auto& sensed = coupled.sensed_components();
  for (int i = 0; i < coupled.rows(); ++i) {
    int c = component.empty() ? -1 : component[i];
    if (coupled.is_coupled() && std::find(sensed.begin(), sensed.end(), c) != sensed.end()) c = -1;
    rows.push_back({b[i], c});
  }
  return rows;
}

// Appends independent rows of the constraints C with their transpose, and zero right-hand sides.
void append_constraints(const CoupledSystem& coupled, std::int32_t first_unknown, std::vector<Entry>& entries,
                        std::vector<RowData>& rows) {
  const ConstraintRows& constraints = coupled.bodies().constraints();
  if (constraints.empty()) return;
  const Eigen::MatrixXd C = constraints.rows();
  for (const int row : constraints.independent()) {
    const auto here = std::int32_t(rows.size());
    for (int k = 0; k < int(C.cols()); ++k) {
      if (C(row, k) == 0) continue;
      entries.push_back({here, first_unknown + k, C(row, k)});
      entries.push_back({first_unknown + k, here, C(row, k)});
    }
    rows.push_back({0, -1});
  }
}

// Appends -H/c and zero right-hand sides.
void append_small(const CoupledSystem& coupled, std::vector<Entry>& entries, std::vector<RowData>& rows) {
  if (!coupled.is_coupled()) return;
  const SparseMatrix& H = coupled.bodies().matrix();
  const auto first = std::int32_t(rows.size());
  for (int k = 0; k < H.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it)
      entries.push_back(
          {first + std::int32_t(it.row()), first + std::int32_t(it.col()), -it.value() / coupled.scale()});
  rows.resize(rows.size() + std::size_t(H.rows()), RowData{0, -1});
  append_constraints(coupled, first, entries, rows);
}

using Matrix = Eigen::SparseMatrix<double>;

// Rows and columns of grounded unknowns keep only their diagonal.
Matrix grounded_matrix(const std::vector<Entry>& entries, const std::vector<char>& grounded) {
  std::vector<Eigen::Triplet<double>> kept;
  for (const Entry& e : entries) {
    const bool coupled = !grounded[e.row] && !grounded[e.column];
    if (coupled || e.row == e.column) kept.emplace_back(e.row, e.column, e.value);
  }
  Matrix A(Eigen::Index(grounded.size()), Eigen::Index(grounded.size()));
  A.setFromTriplets(kept.begin(), kept.end());
  return A;
}

struct SparseLu {
  bool factor(const Matrix& A) {
    lu.compute(A);
    return lu.info() == Eigen::Success;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& r) const { return lu.solve(r); }
  Eigen::SparseLU<Matrix> lu;
};

// Factors A, solves, and refines once. False if the residual stays large.
template <class Factors>
bool eliminate(const Matrix& A, const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  Factors factors;
  if (!factors.factor(A)) return false;
  Eigen::VectorXd y = factors.solve(b);
  y += factors.solve(b - A * y);
  if (!y.allFinite() || (b - A * y).norm() > 1e-12 * b.norm() * std::sqrt(double(b.size()))) return false;
  x = y;
  return true;
}

// Solves on rank 0, by LDL' and, if that fails, by LU. An empty vector means failure.
std::vector<double> solve_gathered(const std::vector<Entry>& entries, const std::vector<RowData>& rows,
                                   int components) {
  std::vector<char> grounded(rows.size(), 0), seen(components, 0);
  Eigen::VectorXd b(rows.size()), x;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int c = rows[i].component;
    grounded[i] = c >= 0 && !seen[c];
    if (c >= 0) seen[c] = 1;
    b[i] = grounded[i] ? 0 : rows[i].b;
  }
  const Matrix A = grounded_matrix(entries, grounded);
  const bool solved = eliminate<SparseLdlt>(A, b, x) || eliminate<SparseLu>(A, b, x);
  return solved ? std::vector<double>(x.begin(), x.end()) : std::vector<double>{};
}

}  // namespace

std::string solve_directly(const CoupledSystem& system, const Vector& b, Vector& x) {
  const DistributedMatrix& A = system.liquid().pattern();
  const Communicator& ranks = system.ranks();
  if (A.global_rows > direct_solve_limit) return "too many rows for elimination";
  std::vector<Entry> entries = gather(local_entries(system), ranks);
  std::vector<RowData> rows = gather(local_rows(system, b), ranks);
  std::vector<double> all;
  if (ranks.is_root()) {
    append_small(system, entries, rows);
    all = solve_gathered(entries, rows, system.liquid().null_space().count);
  }
  const std::string bytes = ranks.broadcast(to_bytes(all));
  if (bytes.empty()) return "elimination failed";
  std::memcpy(x.data(), bytes.data() + std::size_t(A.first_row) * sizeof(double), x.size() * sizeof(double));
  return {};
}

}  // namespace seiche
