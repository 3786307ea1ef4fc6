// Waves of small height and a box that floats upright, free to heave alone: linear potential flow, for the references
// of case.toml. Not part of the build:
// c++ -O3 -I /usr/include/eigen3 -o make_reference make_reference.cpp && ./make_reference DEPTH HALF_WIDTH DRAFT PERIOD
//
// Outside of the box eigenfunctions of the depth, below it those of the gap; potential and its slope meet at the box's
// sides by Galerkin's method (as Black, Mei and Bray 1971). Prints amplitude and phase lag of the heave over those of
// the wave, added mass and damping over the displaced mass, and the damping once more by the far field (Haskind).
#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <cstdio>
#include <string>
#include <vector>

using C = std::complex<double>;
using Matrix = Eigen::MatrixXcd;
using Vector = Eigen::VectorXcd;

constexpr double kGravity = 9.81;
constexpr C kI(0, 1);

struct Problem {
  double h, b, draft, omega;
  int modes;
  std::vector<C> k;  // k[0] = -i k of the wave: cos(k (z + h)) = cosh
  double gap() const { return h - draft; }
};

// Roots of omega^2 = g k tanh kh and omega^2 = -g k tan kh.
void find_wave_numbers(Problem& p) {
  const double nu = p.omega * p.omega / kGravity;
  double k = std::max(nu, std::sqrt(nu / p.h));
  for (int i = 0; i < 200; ++i) {
    const double t = std::tanh(k * p.h);
    k -= (k * t - nu) / (t + k * p.h * (1 - t * t));
  }
  p.k = {C(0, -k)};
  for (int n = 1; n < p.modes; ++n) {
    double low = (n - 0.5) * M_PI / p.h, high = n * M_PI / p.h;
    for (int i = 0; i < 200; ++i) {
      const double x = (low + high) / 2;
      (x * std::sin(x * p.h) + nu * std::cos(x * p.h) > 0) == (n % 2 == 1) ? low = x : high = x;
    }
    p.k.push_back(low);
  }
}

// Integral of cos a y cos c y over y from 0 to s.
C overlap(C a, C c, double s) {
  const auto part = [&](C q) { return std::abs(q) * s < 1e-9 ? C(s) : std::sin(q * s) / q; };
  return (part(a + c) + part(a - c)) / 2.0;
}

// Even potential e^{-i omega t}: outside sum A_n cos k_n y / N_n e^{-k_n (x - b)} and the wave that comes, below the
// box sum B_m cos l_m y cosh l_m x / cosh l_m b and, for a heave of unit speed, (y^2 - x^2) / 2 s.
struct Solution {
  C force;    // i omega rho times the potential, over the bottom, for rho = 1
  C leaving;  // amplitude of the wave that leaves, its potential at the surface
};

Solution solve(const Problem& p, C incoming, double heave) {
  const int n = p.modes;
  const double s = p.gap();
  Matrix m(n, n), below(n, n), norms = Matrix::Zero(n, n);
  const auto l = [&](int j) { return j * M_PI / s; };
  for (int i = 0; i < n; ++i) {
    norms(i, i) = overlap(p.k[i], p.k[i], p.h);
    for (int j = 0; j < n; ++j) below(i, j) = overlap(p.k[i], l(j), s);  // outer i over gap j
  }
  Vector wave = Vector::Zero(n), slope = Vector::Zero(n), inner = Vector::Zero(n), inner_slope = Vector::Zero(n);
  wave[0] = incoming;  // incoming e^{-i k (x - b)}, here k_0 = -i k: slope + k_0
  slope[0] = incoming * p.k[0];
  for (int i = 0; i < n; ++i) inner_slope[i] = -heave * p.b / s * overlap(p.k[i], 0, s);
  for (int j = 0; j < n; ++j) {  // of (y^2 - b^2)/2s over cos l_j y
    const double y2 = j == 0 ? s * s * s / 3 : 2 * s * std::cos(l(j) * s) / (l(j) * l(j));
    inner[j] = heave / (2 * s) * (y2 - (j == 0 ? p.b * p.b * s : 0.0));
  }
  // norms (-k A + slope) = below (l tanh B) + inner_slope;  gap norm B + inner = below^T (A + wave)
  Matrix system(2 * n, 2 * n);
  system.setZero();
  Vector right(2 * n);
  for (int i = 0; i < n; ++i) {
    system(i, i) = -p.k[i] * norms(i, i);
    for (int j = 0; j < n; ++j) system(i, n + j) = -below(i, j) * l(j) * std::tanh(l(j) * p.b);
    right[i] = inner_slope[i] - norms(i, i) * slope[i];
  }
  for (int j = 0; j < n; ++j) {
    system(n + j, n + j) = j == 0 ? s : s / 2;
    for (int i = 0; i < n; ++i) system(n + j, i) = -below(i, j);
  }
  right.tail(n) = below.transpose() * wave - inner;
  const Vector x = system.partialPivLu().solve(right);
  C sum = heave / (2 * s) * (2 * p.b * s * s - 2 * p.b * p.b * p.b / 3);
  for (int j = 0; j < n; ++j)
    sum += x[n + j] * std::cos(l(j) * s) * (j == 0 ? 2 * p.b : 2 * std::tanh(l(j) * p.b) / l(j));
  return {kI * p.omega * sum, x[0] * std::cos(p.k[0] * p.h)};
}

int main(int, char** arguments) {
  for (const int modes : {20, 40, 80, 160}) {
    Problem p{std::stod(arguments[1]),
              std::stod(arguments[2]),
              std::stod(arguments[3]),
              2 * M_PI / std::stod(arguments[4]),
              modes,
              {}};
    find_wave_numbers(p);
    // A wave of unit height at x = 0: surface = i omega/g potential. Half of it is even.
    const C incoming = kGravity / (kI * p.omega) / std::cos(p.k[0] * p.h) * std::exp(p.k[0] * p.b);
    const C excitation = solve(p, incoming / 2.0, 0).force;
    const Solution radiation = solve(p, 0, 1);
    const double mass = 2 * p.b * p.draft;
    // force = i omega a + ... : for velocity e^{-i omega t}, force = i omega added - damping
    const double added = radiation.force.imag() / p.omega, damping = -radiation.force.real();
    const C heave = excitation / (kGravity * 2 * p.b - p.omega * p.omega * (mass + added) - kI * p.omega * damping);
    // energy: damping/2 = two waves of surface a: g a^2/2 c_g each
    const double k = -p.k[0].imag(), a = p.omega / kGravity * std::abs(radiation.leaving);
    const double group = p.omega / k / 2 * (1 + 2 * k * p.h / std::sinh(2 * k * p.h));
    std::printf(
        "%3d modes: kh %.4f force/(g 2b) %.5f heave %.5f lag %.4f added/m %.5f damping/(m omega) %.5f by waves "
        "%.5f\n",
        modes, k * p.h, std::abs(excitation) / (kGravity * 2 * p.b), std::abs(heave), -std::arg(heave), added / mass,
        damping / (mass * p.omega), 2 * kGravity * a * a * group / (mass * p.omega));
  }
}
