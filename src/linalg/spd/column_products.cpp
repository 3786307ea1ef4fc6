#include "linalg/spd/column_products.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cstring>
#include <map>

namespace seiche {
namespace {

struct Item {
  std::int64_t row, column;
  double value;
};

// Sums of equal places over all ranks, in the order of the ranks.
std::vector<Eigen::Triplet<double>> totals(std::vector<Item> items, const Communicator& ranks) {
  if (ranks.size() > 1) {
    const std::string mine(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item));
    items.clear();
    for (const std::string& part : ranks.all_gather(mine)) {
      const std::size_t before = items.size();
      items.resize(before + part.size() / sizeof(Item));
      if (!part.empty()) std::memcpy(items.data() + before, part.data(), part.size());
    }
  }
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.row != b.row ? a.row < b.row : a.column < b.column; });
  std::vector<Eigen::Triplet<double>> sums;
  for (std::size_t n = 0; n < items.size();) {
    const Item& first = items[n];
    double sum = 0;
    for (; n < items.size() && items[n].row == first.row && items[n].column == first.column; ++n) sum += items[n].value;
    sums.emplace_back(int(first.row), int(first.column), sum);
  }
  return sums;
}

// Sparse columns by rows: entries start[i] up to start[i + 1] belong to row i, columns ascend.
struct Rows {
  std::vector<int> start, column;
  std::vector<double> value;

  Rows(const std::vector<SparseVector>& columns, int rows) : start(std::size_t(rows) + 1, 0) {
    for (const SparseVector& c : columns)
      for (const int i : c.row) ++start[std::size_t(i) + 1];
    for (std::size_t i = 0; i < std::size_t(rows); ++i) start[i + 1] += start[i];
    column.resize(std::size_t(start.back()));
    value.resize(column.size());
    std::vector<int> next(start.begin(), start.end() - 1);
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t n = 0; n < columns[c].row.size(); ++n) {
        const auto at = std::size_t(next[std::size_t(columns[c].row[n])]++);
        column[at] = int(c);
        value[at] = columns[c].value[n];
      }
  }
  int first(int i) const { return start[std::size_t(i)]; }
  int count(int i) const { return start[std::size_t(i) + 1] - start[std::size_t(i)]; }
  void append_columns(int i, std::vector<int>& to) const {
    to.insert(to.end(), column.begin() + first(i), column.begin() + first(i) + count(i));
  }
};

// Rows in which the same columns have entries, so that their products are those of dense matrices.
using Groups = std::map<std::vector<int>, std::vector<int>>;

Groups group_rows(const Rows& X, const Rows& Y, int rows) {
  Groups groups;
  std::vector<int> key;
  for (int i = 0; i < rows; ++i) {
    if (X.count(i) == 0 || Y.count(i) == 0) continue;
    key.clear();
    X.append_columns(i, key);
    key.push_back(-1);
    Y.append_columns(i, key);
    groups[key].push_back(i);
  }
  return groups;
}

Eigen::MatrixXd dense_part(const Rows& X, const std::vector<int>& rows) {
  Eigen::MatrixXd part(X.count(rows.front()), Eigen::Index(rows.size()));
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (int k = 0; k < X.count(rows[n]); ++k) part(k, Eigen::Index(n)) = X.value[std::size_t(X.first(rows[n]) + k)];
  return part;
}

// Columns that have entries in the rows of a block, ascending.
std::vector<int> columns_beside(const ColumnBlock& block, const Rows& Z) {
  std::vector<int> columns;
  for (const int i : block.row) Z.append_columns(i, columns);
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

// J'Z of one block, on the columns of Z beside it.
Eigen::MatrixXd dense_products(const ColumnBlock& block, const Rows& Z, const std::vector<int>& columns) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(Eigen::Index(columns.size()), block.width);
  block.for_each([&](int i, int k, double value) {
    for (int n = Z.first(i); n < Z.first(i) + Z.count(i); ++n) {
      const auto c = std::lower_bound(columns.begin(), columns.end(), Z.column[std::size_t(n)]) - columns.begin();
      sums(c, k) += value * Z.value[std::size_t(n)];
    }
  });
  return sums;
}

}  // namespace

std::vector<Eigen::Triplet<double>> products(const std::vector<SparseVector>& X, const std::vector<SparseVector>& Y,
                                             int rows, const Communicator& ranks) {
  const Rows x(X, rows), y(Y, rows);
  std::vector<Item> items;
  for (const auto& [key, list] : group_rows(x, y, rows)) {
    const Eigen::MatrixXd sums = dense_part(x, list) * dense_part(y, list).transpose();
    const int *left = x.column.data() + x.first(list.front()), *right = y.column.data() + y.first(list.front());
    for (Eigen::Index j = 0; j < sums.cols(); ++j)
      for (Eigen::Index i = 0; i < sums.rows(); ++i) items.push_back({left[i], right[j], sums(i, j)});
  }
  return totals(std::move(items), ranks);
}

std::vector<Eigen::Triplet<double>> products(const BlockColumns& J, const std::vector<SparseVector>& Z, int rows,
                                             const Communicator& ranks) {
  const Rows z(Z, rows);
  std::vector<Item> items;
  const std::vector<int> first = J.first_columns();
  for (std::size_t b = 0; b < J.blocks.size(); ++b) {
    const std::vector<int> columns = columns_beside(J.blocks[b], z);
    const Eigen::MatrixXd sums = dense_products(J.blocks[b], z, columns);
    for (Eigen::Index k = 0; k < sums.cols(); ++k)
      for (Eigen::Index c = 0; c < sums.rows(); ++c)
        if (sums(c, k) != 0) items.push_back({first[b] + k, columns[std::size_t(c)], sums(c, k)});
  }
  return totals(std::move(items), ranks);
}

}  // namespace seiche
