#include "linalg/block_columns.h"

#include <cstring>

namespace seiche {

std::vector<int> BlockColumns::first_columns() const {
  std::vector<int> first{0};
  for (const ColumnBlock& b : blocks) first.push_back(first.back() + b.width);
  return first;
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
      for (int k = 0; k < b.width; ++k) sum += b.value[i * b.width + k] * v[first + k];
      y[b.row[i]] += sum;
    }
    first += b.width;
  }
}

Eigen::VectorXd local_transposed(const BlockColumns& J, const Vector& x) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(J.columns());
  int first = 0;
  for (const ColumnBlock& b : J.blocks) {
    for (std::size_t i = 0; i < b.row.size(); ++i)
      for (int k = 0; k < b.width; ++k) v[first + k] += b.value[i * b.width + k] * x[b.row[i]];
    first += b.width;
  }
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
