#include "base/steady_waves.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "base/error.h"
#include "base/water_waves.h"

namespace seiche {
namespace {

using Vector = Eigen::VectorXd;

// Modes of the sums.
constexpr int order = 16;

// In the frame of the waves the flow is steady, with the speed -c0 + sum_j j k B_j C_j cos jkx along x, and C_j, S_j
// short for cosh and sinh jk(z + h) over cosh jkh. Unknowns, with lengths in depths h and times in sqrt(h/g):
//   k, c0, Q, R, B_1 ... B_N, eta_0 ... eta_N at kx = m pi/N from crest to trough.
// Equations at each m: the surface is a line of flow, Q = c0 (1 + eta) - sum B_j S_j cos, and Bernoulli's
// R = (u^2 + w^2)/2 + eta. Then eta_0 - eta_N = H, the mean of eta is 0, and k Q T = 2 pi, for without a net volume the
// waves move at c = Q.
class SteadyWaveEquations {
 public:
  explicit SteadyWaveEquations(double period) : period_(period) {}
  static constexpr int size = 2 * order + 5;

  Vector residual(const Vector& x, double height) const {
    Vector r(size);
    const double k = x[0];
    double mean = 0;
    for (int m = 0; m <= order; ++m) {
      const double eta = surface(x, m), end = m == 0 || m == order ? 0.5 : 1;
      mean += end * eta;
      double u = -x[1], w = 0, flux = x[1] * (1 + eta);
      for (int j = 1; j <= order; ++j) {
        const double b = x[3 + j], angle = j * m * M_PI / order, up = std::exp(j * k * eta),
                     down = std::exp(-j * k * (2 + eta)), scale = 1 + std::exp(-2 * j * k);
        u += j * k * b * (up + down) / scale * std::cos(angle);
        w += j * k * b * (up - down) / scale * std::sin(angle);
        flux -= b * (up - down) / scale * std::cos(angle);
      }
      r[m] = flux - x[2];
      r[order + 1 + m] = (u * u + w * w) / 2 + eta - x[3];
    }
    r[2 * order + 2] = surface(x, 0) - surface(x, order) - height;
    r[2 * order + 3] = mean / order;
    r[2 * order + 4] = k * x[2] * period_ - 2 * M_PI;
    return r;
  }

  // Linear waves.
  Vector start(double height) const {
    const double w = 2 * M_PI / period_, k = wave_number(w, 1, 1), c = w / k;
    Vector x = Vector::Zero(size);
    x[0] = k, x[1] = x[2] = c, x[3] = c * c / 2;
    x[4] = height / 2 * w / std::tanh(k) / k;
    for (int m = 0; m <= order; ++m) x[order + 4 + m] = height / 2 * std::cos(m * M_PI / order);
    return x;
  }

  // Newton's method, with differences for the slopes. True if it has converged.
  bool solve(double height, Vector& x) const {
    constexpr double close = 1e-11, shift = 1e-7;
    for (int n = 0; n < 30; ++n) {
      const Vector r = residual(x, height);
      if (!r.allFinite()) return false;
      if (r.lpNorm<Eigen::Infinity>() < close) return true;
      Eigen::MatrixXd slopes(size, size);
      for (int c = 0; c < size; ++c) {
        Vector ahead = x, behind = x;
        ahead[c] += shift, behind[c] -= shift;
        slopes.col(c) = (residual(ahead, height) - residual(behind, height)) / (2 * shift);
      }
      x -= slopes.partialPivLu().solve(r);
    }
    return false;
  }

  static double surface(const Vector& x, int m) { return x[order + 4 + m]; }

 private:
  double period_;
};

// Coefficients of the surface's cosines.
double cosine_of_surface(const Vector& x, int j) {
  double sum = 0;
  for (int m = 0; m <= order; ++m)
    sum += (m == 0 || m == order ? 0.5 : 1) * SteadyWaveEquations::surface(x, m) * std::cos(j * m * M_PI / order);
  return sum * (j == order ? 1.0 : 2.0) / order;
}

}  // namespace

// By steps in height from linear waves.
SteadyWaves steady_waves(double height, double period, double depth, double gravity) {
  constexpr int steps = 8;
  const double time = std::sqrt(depth / gravity), h = height / depth;
  const SteadyWaveEquations equations(period / time);
  Vector x = equations.start(h / steps), last = x;
  for (int n = 1; n <= steps; ++n) {
    const Vector before = x;
    if (n > 2) x += x - last;
    if (!equations.solve(h * n / steps, x))
      throw Error(ExitCode::bad_input,
                  fmt::format("no steady waves {:g} m high with a period of {:g} s are found in {:g} m of depth; lower "
                              "their height, or take theory = \"stokes\"",
                              height, period, depth));
    last = before;
  }
  SteadyWaves waves;
  waves.number = x[0] / depth;
  waves.current = (x[2] - x[1]) * depth / time;
  for (int j = 1; j <= order; ++j) {
    waves.elevation.push_back(cosine_of_surface(x, j) * depth);
    waves.speed.push_back(j * x[0] * x[3 + j] * depth / time);
  }
  return waves;
}

}  // namespace seiche
