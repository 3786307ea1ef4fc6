#include "linalg/core/block_columns.h"

#include <algorithm>

#include <cstring>

namespace seiche {

void ColumnBlock::add(int in_row, int in_column, double entry) {
  if (row.empty() || row.back() != in_row) row.push_back(in_row), start.push_back(start.back());
  column.push_back(in_column);
  value.push_back(entry);
  ++start.back();
}

std::vector<int> BlockColumns::first_columns() const {
  std::vector<int> first{0};
  for (const ColumnBlock& b : blocks) first.push_back(first.back() + b.width);
  return first;
}

bool BlockColumns::any_deforms() const {
  return std::any_of(blocks.begin(), blocks.end(), [](const ColumnBlock& b) { return b.deforms(); });
}

int BlockColumns::columns() const {
  int sum = 0;
  for (const ColumnBlock& b : blocks) sum += b.width;
  return sum;
}

void add_multiplied(const BlockColumns& J, const Eigen::VectorXd& v, Vector& y) {
  int first = 0;
  for (const ColumnBlock& b : J.blocks) {
    for (std::size_t i = 0; i < b.row.size(); ++i) {
      double sum = 0;
      for (int n = b.start[i]; n < b.start[i + 1]; ++n)
        sum += b.value[std::size_t(n)] * v[first + b.column[std::size_t(n)]];
      y[b.row[i]] += sum;
    }
    first += b.width;
  }
}

Eigen::VectorXd local_transposed(const BlockColumns& J, const Vector& x) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(J.columns());
  J.for_each([&](int i, int k, double value) { v[k] += value * x[i]; });
  return v;
}

Eigen::VectorXd multiply_transposed(const BlockColumns& J, const Vector& x, const Communicator& ranks) {
  Eigen::VectorXd v = local_transposed(J, x);
  if (v.size() > 0) ranks.global_sum(std::span<double>(v.data(), std::size_t(v.size())));
  return v;
}

void make_identical(Eigen::VectorXd& v, const Communicator& ranks) {
  if (ranks.size() == 1 || v.size() == 0) return;
  const std::size_t bytes = std::size_t(v.size()) * sizeof(double);
  const std::string text = ranks.broadcast(std::string(reinterpret_cast<const char*>(v.data()), bytes));
  std::memcpy(v.data(), text.data(), bytes);
}

}  // namespace seiche
