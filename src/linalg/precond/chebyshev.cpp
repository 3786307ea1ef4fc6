#include "linalg/precond/chebyshev.h"

#include <algorithm>
#include <array>
#include <span>

namespace seiche {
namespace {

// Coefficients of the Chebyshev steps: d = first D^-1 r, then d = of_d d + of_r D^-1 r.
class Recurrence {
 public:
  explicit Recurrence(const SpectralInterval& i)
      : half_(0.5 * (i.high - i.low)), middle_(0.5 * (i.high + i.low)), rho_(half_ / middle_) {}
  double first() const { return 1 / middle_; }
  struct Step {
    double of_d, of_r;
  };
  Step next() {
    const double rho = half_ > 0 ? 1 / (2 * middle_ / half_ - rho_) : 0;
    const Step step{rho * rho_, half_ > 0 ? 2 * rho / half_ : 1 / middle_};
    rho_ = rho;
    return step;
  }

 private:
  double half_, middle_, rho_;
};

// Rows within a given number of neighbours of the nonzeros of the columns, the nearest first.
class Reach {
 public:
  // Finds rows up to `far` neighbours away; F's pattern must be symmetric. Collective.
  Reach(const LinearSystem& F, const std::vector<Vector>& columns, int far)
      : F_(F), flags_(std::size_t(F.rows() + F.halo().ghosts()), 0.0) {
    for (int i = 0; i < F.rows(); ++i) {
      const auto differs = [&](const Vector& c) { return c[std::size_t(i)] != 0; };
      if (std::any_of(columns.begin(), columns.end(), differs)) add(i);
    }
    find_border();
    ends_.push_back(rows_.size());
    for (int n = 0; n < far; ++n) grow();
  }

  std::span<const int> rows(int within) const { return {rows_.data(), ends_[std::size_t(within)]}; }
  std::span<const int> rows() const { return rows_; }

 private:
  bool is_foreign(Row column) const {
    return column < F_.pattern().first_row || column >= F_.pattern().first_row + F_.rows();
  }
  void add(int row) {
    if (flags_[std::size_t(row)] != 0) return;
    flags_[std::size_t(row)] = 1;
    rows_.push_back(row);
  }
  void find_border() {
    const DistributedMatrix& P = F_.pattern();
    for (int i = 0; i < F_.rows(); ++i) {
      const auto begin = P.column.begin() + P.row_start[i], end = P.column.begin() + P.row_start[i + 1];
      if (std::any_of(begin, end, [&](Row c) { return is_foreign(c); })) border_.push_back(i);
    }
  }
  void grow() {
    F_.halo().fill_ghosts(flags_);
    const DistributedMatrix& P = F_.pattern();
    const std::size_t begin = ends_.size() > 1 ? ends_[ends_.size() - 2] : 0, end = ends_.back();
    for (std::size_t n = begin; n < end; ++n)
      for (int k = P.row_start[rows_[n]]; k < P.row_start[rows_[n] + 1]; ++k)
        if (!is_foreign(P.column[k])) add(int(P.column[k] - P.first_row));
    for (const int i : border_)
      for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
        if (is_foreign(P.column[k]) && flags_[std::size_t(F_.halo().local_index(P.column[k]))] != 0) add(i);
    std::sort(rows_.begin() + std::ptrdiff_t(end), rows_.end());
    ends_.push_back(rows_.size());
  }

  const LinearSystem& F_;
  Vector flags_;  // with ghosts
  std::vector<int> rows_, border_;
  std::vector<std::size_t> ends_;  // rows_ up to ends_[n] lie within n neighbours
};

// Upper bound of the eigenvalues of D^-1 F: max_i sum_j |F_ij| / F_ii. Collective.
double gershgorin_bound(const LinearSystem& F) {
  const DistributedMatrix& P = F.pattern();
  double high = 0;
  for (int i = 0; i < F.rows(); ++i) {
    double sum = 0;
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k) sum += std::abs(F.values()[std::size_t(k)]);
    high = std::max(high, sum / F.diagonal(i));
  }
  return F.ranks().global_max(high);
}

}  // namespace

// Starts from the constant vector. Relaxation removes its rough layers beside walls; x'F x / x'D x can only fall.
SpectralInterval estimate_interval(const LinearSystem& F) {
  constexpr int relaxations = 10;
  const double high = gershgorin_bound(F);
  if (high == 0) return {};  // no unknowns on any rank
  Vector x(std::size_t(F.rows()), 1.0), Fx(x.size());
  for (int n = 0;; ++n) {
    F.multiply(x, Fx);
    if (n == relaxations) break;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= Fx[i] / (high * F.diagonal(int(i)));
  }
  std::array<double, 2> sums{0, 0};
  for (std::size_t i = 0; i < x.size(); ++i) sums[0] += x[i] * Fx[i], sums[1] += F.diagonal(int(i)) * x[i] * x[i];
  F.ranks().global_sum(sums);
  const double quotient = sums[1] > 0 ? sums[0] / sums[1] : high;
  return {std::clamp(quotient, 1e-12 * high, high), high};
}

// Bound on the error: |T_n((high + low)/(high - low))|^-1 < 2 exp(-2 n / sqrt(condition)).
int chebyshev_steps(const SpectralInterval& interval, double share) {
  const double wanted = 0.5 * std::sqrt(interval.condition()) * std::log(2 / share);
  return int(std::ceil(std::clamp(wanted, 1.0, 1e6)));
}

Chebyshev::Chebyshev(const LinearSystem& F, const SpectralInterval& interval, int steps)
    : F_(F), interval_(interval), steps_(steps), inverse_(std::size_t(F.rows())) {
  for (int i = 0; i < F.rows(); ++i) inverse_[std::size_t(i)] = 1 / F.diagonal(i);
  rest_.resize(inverse_.size());
  d_.resize(inverse_.size());
  Fd_.resize(inverse_.size());
}

void Chebyshev::apply(const Vector& r, Vector& z) {
  Recurrence recurrence(interval_);
  const double first = recurrence.first();
  rest_ = r;
  for (std::size_t i = 0; i < r.size(); ++i) z[i] = d_[i] = first * inverse_[i] * r[i];
  for (int n = 1; n < steps_; ++n) {
    const auto [of_d, of_r] = recurrence.next();
    F_.multiply(d_, Fd_);
    for (std::size_t i = 0; i < r.size(); ++i) {
      rest_[i] -= Fd_[i];
      d_[i] = of_d * d_[i] + of_r * inverse_[i] * rest_[i];
      z[i] += d_[i];
    }
  }
}

namespace {

// Chebyshev iteration on a growing set of rows; vectors are zero elsewhere.
class LocalIteration {
 public:
  explicit LocalIteration(const LinearSystem& F)
      : F_(F), rest_(std::size_t(F.rows())), d_(rest_.size() + std::size_t(F.halo().ghosts())), z_(rest_.size()) {}

  SparseVector solve(const SpectralInterval& interval, int steps, const Vector& column, const Reach& reach) {
    Recurrence recurrence(interval);
    rest_ = column;
    std::fill(d_.begin(), d_.end(), 0.0);
    std::fill(z_.begin(), z_.end(), 0.0);
    advance({0, recurrence.first()}, reach.rows(0));
    for (int n = 1; n < steps; ++n) {
      take_from_rest(reach.rows(n));
      advance(recurrence.next(), reach.rows(n));
    }
    return nonzeros(z_);
  }

 private:
  // rest -= F d
  void take_from_rest(std::span<const int> rows) {
    const DistributedMatrix& P = F_.pattern();
    F_.halo().fill_ghosts(d_);
    for (const int i : rows)
      for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
        rest_[std::size_t(i)] -= F_.values()[std::size_t(k)] * d_[std::size_t(F_.halo().local_index(P.column[k]))];
  }
  void advance(const Recurrence::Step& step, std::span<const int> rows) {
    for (const int i : rows) {
      const auto n = std::size_t(i);
      d_[n] = step.of_d * d_[n] + step.of_r * rest_[n] / F_.diagonal(i);
      z_[n] += d_[n];
    }
  }

  const LinearSystem& F_;
  Vector rest_, d_, z_;  // d with ghosts
};

}  // namespace

std::vector<SparseVector> solve_locally(const LinearSystem& F, const SpectralInterval& interval, int steps,
                                        const std::vector<Vector>& columns) {
  const Reach reach(F, columns, steps - 1);
  LocalIteration iteration(F);
  std::vector<SparseVector> solved;
  for (const Vector& column : columns) solved.push_back(iteration.solve(interval, steps, column, reach));
  return solved;
}

}  // namespace seiche
