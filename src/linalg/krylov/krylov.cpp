#include "linalg/krylov/krylov.h"

#include <cmath>

namespace seiche {

double HessenbergLeastSquares::append(std::vector<double> h) {
  const std::size_t k = columns_.size();
  for (std::size_t i = 0; i < k; ++i) {
    const double low = h[i], high = h[i + 1];
    h[i] = cosines_[i] * low + sines_[i] * high;
    h[i + 1] = cosines_[i] * high - sines_[i] * low;
  }
  const double length = std::hypot(h[k], h[k + 1]);
  cosines_.push_back(length > 0 ? h[k] / length : 1);
  sines_.push_back(length > 0 ? h[k + 1] / length : 0);
  h[k] = length;
  rhs_.push_back(-sines_[k] * rhs_[k]);
  rhs_[k] *= cosines_[k];
  h.pop_back();
  columns_.push_back(std::move(h));
  return std::abs(rhs_[k + 1]);
}

std::vector<double> HessenbergLeastSquares::solve() const {
  const int n = int(columns_.size());
  std::vector<double> y(rhs_.begin(), rhs_.begin() + n);
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) y[i] -= columns_[j][i] * y[j];
    y[i] = columns_[i][i] != 0 ? y[i] / columns_[i][i] : 0;
  }
  return y;
}

}  // namespace seiche
