// Kinetic energy of the Taylor-Green vortex over time by a pseudo-spectral method, for energy.csv. Not part of the
// build: c++ -O3 -o make_reference make_reference.cpp && ./make_reference 64 100 > energy.csv
//
// In the periodic box of side 2 pi, N points a side: u_t = P(u x omega) - nu k^2 u, P without gradients, products
// without the modes from N/3 on, classical Runge-Kutta steps of 1/20.
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <vector>

using C = std::complex<double>;
using Field = std::vector<C>;
using Vector = std::array<Field, 3>;

int n;
double nu;

std::size_t at(int i, int j, int k) {
  return (std::size_t(i) * n + j) * n + k;
}

// In place, along one pencil; direction -1 forwards.
void transform(std::vector<C>& x, const std::vector<C>& roots, int direction) {
  for (int i = 1, j = 0; i < n; ++i) {
    int bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (int length = 2; length <= n; length *= 2)
    for (int i = 0; i < n; i += length)
      for (int k = 0; k < length / 2; ++k) {
        const C root = roots[k * (n / length)];
        const C a = x[i + k], b = x[i + k + length / 2] * (direction < 0 ? root : std::conj(root));
        x[i + k] = a + b;
        x[i + k + length / 2] = a - b;
      }
}

void transform(Field& f, int direction) {
  std::vector<C> roots(n), x(n);
  for (int k = 0; k < n; ++k) roots[k] = std::polar(1.0, -2 * M_PI * k / n);
  const std::size_t strides[3] = {std::size_t(n) * n, std::size_t(n), 1};
  for (int a = 0; a < 3; ++a)
    for (int p = 0; p < n; ++p)
      for (int q = 0; q < n; ++q) {
        const std::size_t start = p * strides[(a + 1) % 3] + q * strides[(a + 2) % 3];
        for (int i = 0; i < n; ++i) x[i] = f[start + i * strides[a]];
        transform(x, roots, direction);
        for (int i = 0; i < n; ++i) f[start + i * strides[a]] = x[i] * (direction < 0 ? 1.0 / n : 1.0);
      }
}

double wave(int i) {
  return i <= n / 2 ? i : i - n;
}

template <class Visit>
void for_each_mode(const Visit& visit) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) visit(at(i, j, k), std::array<double, 3>{wave(i), wave(j), wave(k)});
}

Vector rate(const Vector& u) {
  Vector v = u, w, force;
  for (int a = 0; a < 3; ++a) w[a].resize(u[a].size()), force[a].resize(u[a].size());
  for_each_mode([&](std::size_t m, const std::array<double, 3>& k) {
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      w[a][m] = C(0, 1) * (k[b] * u[c][m] - k[c] * u[b][m]);
    }
  });
  for (int a = 0; a < 3; ++a) transform(v[a], 1), transform(w[a], 1);
  for (std::size_t m = 0; m < v[0].size(); ++m)
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      force[a][m] = v[b][m].real() * w[c][m].real() - v[c][m].real() * w[b][m].real();
    }
  for (int a = 0; a < 3; ++a) transform(force[a], -1);
  for_each_mode([&](std::size_t m, const std::array<double, 3>& k) {
    const double square = k[0] * k[0] + k[1] * k[1] + k[2] * k[2], limit = n / 3.0;
    const bool kept = std::abs(k[0]) < limit && std::abs(k[1]) < limit && std::abs(k[2]) < limit;
    C along = 0;
    for (int a = 0; a < 3; ++a) along += k[a] * force[a][m];
    for (int a = 0; a < 3; ++a)
      force[a][m] = (kept && square > 0 ? force[a][m] - k[a] * along / square : C(0)) - nu * square * u[a][m];
  });
  return force;
}

Vector plus(Vector u, double factor, const Vector& v) {
  for (int a = 0; a < 3; ++a)
    for (std::size_t m = 0; m < u[a].size(); ++m) u[a][m] += factor * v[a][m];
  return u;
}

int main(int, char** argv) {
  n = std::atoi(argv[1]);
  nu = 1 / std::atof(argv[2]);
  Vector u;
  for (Field& f : u) f.assign(std::size_t(n) * n * n, 0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const double x = 2 * M_PI * i / n, y = 2 * M_PI * j / n, z = 2 * M_PI * k / n;
        u[0][at(i, j, k)] = std::sin(x) * std::cos(y) * std::cos(z);
        u[1][at(i, j, k)] = -std::cos(x) * std::sin(y) * std::cos(z);
      }
  for (Field& f : u) transform(f, -1);
  const double dt = 0.05;
  std::printf(
      "# By make_reference.cpp, %d points a side, Re = %s: kinetic energy over its first value, 1/8 a volume.\n", n,
      argv[2]);
  std::printf("time,energy\n");
  for (int step = 0; step <= 200; ++step) {
    double energy = 0;
    for (const Field& f : u)
      for (const C& c : f) energy += 0.5 * std::norm(c);
    if (step % 2 == 0) std::printf("%.2f,%.10g\n", step * dt, 8 * energy), std::fflush(stdout);
    const Vector k1 = rate(u), k2 = rate(plus(u, dt / 2, k1)), k3 = rate(plus(u, dt / 2, k2)),
                 k4 = rate(plus(u, dt, k3));
    u = plus(plus(plus(plus(u, dt / 6, k1), dt / 3, k2), dt / 3, k3), dt / 6, k4);
  }
}
