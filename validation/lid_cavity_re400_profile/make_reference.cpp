// Steady flow in the lid-driven cavity, for profile.csv here and beside lid_cavity_re100. Not part of the build:
// c++ -O3 -I /usr/include/eigen3 -o make_reference make_reference.cpp && ./make_reference 400 128 < points.csv
//
// Stream function s and vorticity w at the nodes of grids of N/4, N/2 and N cells, finer at the walls, central
// differences of second order, Newton's method with a direct solver; then Richardson's extrapolation of the two finer
// grids. The error is taken from how far that of the two coarser grids is from it.
#include <Eigen/SparseLU>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

constexpr double kCluster = 0.8;  // how much finer cells are at the walls: x = q - c/(2 pi) sin 2 pi q

double place(double q) {
  return q - kCluster / (2 * M_PI) * std::sin(2 * M_PI * q);
}

double stretch(double q) {
  return 1 - kCluster * std::cos(2 * M_PI * q);
}

class Cavity {
 public:
  Cavity(int cells, double reynolds) : n_(cells), viscosity_(1 / reynolds), s_(count(), 0.0), w_(count(), 0.0) {}

  void start_from(const Cavity& other) {
    s_ = other.s_;
    w_ = other.w_;
  }

  void solve() {
    for (int k = 0; k < 30; ++k) {
      set_walls();
      const double change = newton();
      if (change < 1e-11) return;
    }
    std::fprintf(stderr, "not converged\n");
  }

  // Velocity at a node: differences of the stream function.
  double u(int i, int j) const {
    if (j == 0 || j == n_) return j == 0 ? 0 : 1;
    return (s_[at(i, j + 1)] - s_[at(i, j - 1)]) * n_ / (2 * stretch(double(j) / n_));
  }
  double v(int i, int j) const {
    if (i == 0 || i == n_) return 0;
    return -(s_[at(i + 1, j)] - s_[at(i - 1, j)]) * n_ / (2 * stretch(double(i) / n_));
  }

  // Velocity at x of the line through the middle, by a polynomial through eight nodes.
  double on_line(char component, double x) const {
    double q = x;
    for (int k = 0; k < 50; ++k) q -= (place(q) - x) / stretch(q);
    const int first = std::min(std::max(int(q * n_) - 3, 0), n_ - 7);
    double sum = 0;
    for (int a = first; a < first + 8; ++a) {
      double weight = 1;
      for (int b = first; b < first + 8; ++b)
        if (b != a) weight *= (q * n_ - b) / double(a - b);
      sum += weight * (component == 'x' ? u(n_ / 2, a) : v(a, n_ / 2));
    }
    return sum;
  }

 private:
  int n_;
  double viscosity_;
  std::vector<double> s_, w_;

  std::size_t count() const { return std::size_t(n_ + 1) * (n_ + 1); }
  std::size_t at(int i, int j) const { return std::size_t(i) * (n_ + 1) + j; }
  int inner(int i, int j) const { return (i - 1) * (n_ - 1) + j - 1; }
  bool inside(int i, int j) const { return i > 0 && i < n_ && j > 0 && j < n_; }

  // The vorticity at a wall from two nodes inside, h and H from it: (H g - h G)/(H - h) 2, g = (s - slope h)/h^2.
  void wall_weights(double& near, double& far, double& slope) const {
    const double h = place(1.0 / n_), H = place(2.0 / n_);
    near = -2 * H / (H - h) / (h * h);
    far = 2 * h / (H - h) / (H * H);
    slope = -(near * h + far * H);
  }

  void set_walls() {
    double near, far, slope;
    wall_weights(near, far, slope);
    for (int k = 1; k < n_; ++k) {
      w_[at(0, k)] = near * s_[at(1, k)] + far * s_[at(2, k)];
      w_[at(n_, k)] = near * s_[at(n_ - 1, k)] + far * s_[at(n_ - 2, k)];
      w_[at(k, 0)] = near * s_[at(k, 1)] + far * s_[at(k, 2)];
      w_[at(k, n_)] = near * s_[at(k, n_ - 1)] + far * s_[at(k, n_ - 2)] - slope;  // ds/dn = -1 inwards
    }
  }

  // A term of the equation of the vorticity; that of a wall stands for two nodes inside.
  void add(std::vector<Eigen::Triplet<double>>& entries, int row, int i, int j, double weight) const {
    const int half = (n_ - 1) * (n_ - 1);
    if (inside(i, j)) {
      entries.emplace_back(row, half + inner(i, j), weight);
      return;
    }
    double near, far, slope;
    wall_weights(near, far, slope);
    const int di = i == 0 ? 1 : (i == n_ ? -1 : 0), dj = j == 0 ? 1 : (j == n_ ? -1 : 0);
    entries.emplace_back(row, inner(i + di, j + dj), weight * near);
    entries.emplace_back(row, inner(i + 2 * di, j + 2 * dj), weight * far);
  }

  double newton() {
    const int half = (n_ - 1) * (n_ - 1);
    std::vector<Eigen::Triplet<double>> entries;
    Vector residual(2 * half);
    for (int i = 1; i < n_; ++i)
      for (int j = 1; j < n_; ++j) rows_of(i, j, half, entries, residual);
    Matrix jacobian(2 * half, 2 * half);
    jacobian.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Matrix> solver(jacobian);
    const Vector step = solver.solve(residual);
    for (int i = 1; i < n_; ++i)
      for (int j = 1; j < n_; ++j) {
        s_[at(i, j)] -= step[inner(i, j)];
        w_[at(i, j)] -= step[half + inner(i, j)];
      }
    return step.head(half).cwiseAbs().maxCoeff();
  }

  void rows_of(int i, int j, int half, std::vector<Eigen::Triplet<double>>& entries, Vector& residual) const {
    const double gx = stretch(double(i) / n_), gy = stretch(double(j) / n_), n = n_;
    const double west = n * n / (gx * stretch((i - 0.5) / n)), east = n * n / (gx * stretch((i + 0.5) / n));
    const double south = n * n / (gy * stretch((j - 0.5) / n)), north = n * n / (gy * stretch((j + 0.5) / n));
    const int row = inner(i, j);
    const auto laplacian = [&](const std::vector<double>& f) {
      return west * (f[at(i - 1, j)] - f[at(i, j)]) + east * (f[at(i + 1, j)] - f[at(i, j)]) +
             south * (f[at(i, j - 1)] - f[at(i, j)]) + north * (f[at(i, j + 1)] - f[at(i, j)]);
    };
    const auto stream = [&](int a, int b, double weight) {
      if (inside(a, b)) entries.emplace_back(row, inner(a, b), weight);
    };
    stream(i - 1, j, west), stream(i + 1, j, east), stream(i, j - 1, south), stream(i, j + 1, north);
    stream(i, j, -(west + east + south + north));
    entries.emplace_back(row, half + row, 1.0);
    residual[row] = laplacian(s_) + w_[at(i, j)];

    const double dx = n / (2 * gx), dy = n / (2 * gy);
    const double wx = (w_[at(i + 1, j)] - w_[at(i - 1, j)]) * dx, wy = (w_[at(i, j + 1)] - w_[at(i, j - 1)]) * dy;
    const double sx = (s_[at(i + 1, j)] - s_[at(i - 1, j)]) * dx, sy = (s_[at(i, j + 1)] - s_[at(i, j - 1)]) * dy;
    residual[half + row] = sy * wx - sx * wy - viscosity_ * laplacian(w_);
    const auto vorticity = [&](int a, int b, double weight) { add(entries, half + row, a, b, weight); };
    vorticity(i - 1, j, -sy * dx - viscosity_ * west), vorticity(i + 1, j, sy * dx - viscosity_ * east);
    vorticity(i, j - 1, sx * dy - viscosity_ * south), vorticity(i, j + 1, -sx * dy - viscosity_ * north);
    vorticity(i, j, viscosity_ * (west + east + south + north));
    const auto turned = [&](int a, int b, double weight) {
      if (inside(a, b)) entries.emplace_back(half + row, inner(a, b), weight);
    };
    turned(i, j + 1, wx * dy), turned(i, j - 1, -wx * dy), turned(i + 1, j, -wy * dx), turned(i - 1, j, wy * dx);
  }
};

Cavity solved(int cells, double reynolds) {
  Cavity start(cells, std::min(reynolds, 100.0));
  start.solve();
  for (double step = 200; step < reynolds; step *= 2) {
    Cavity next(cells, step);
    next.start_from(start);
    next.solve();
    start.start_from(next);
  }
  Cavity end(cells, reynolds);
  end.start_from(start);
  end.solve();
  return end;
}

int main(int, char** arguments) {
  const double reynolds = std::stod(arguments[1]);
  const int n = std::stoi(arguments[2]);
  const Cavity coarse = solved(n / 4, reynolds), middle = solved(n / 2, reynolds), fine = solved(n, reynolds);
  std::printf("# Made by make_reference.cpp: Re %g, grids of %d, %d and %d cells, extrapolated\n", reynolds, n / 4,
              n / 2, n);
  std::printf("component,along,x,y,z,value\n");
  double worst = 0;
  for (std::string line; std::getline(std::cin, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 'c') continue;
    std::stringstream row(line);
    std::string part[6];
    for (auto& p : part) std::getline(row, p, ',');
    const char component = part[0][0];
    const double x = std::stod(component == 'x' ? part[3] : part[2]);
    const double a = coarse.on_line(component, x), b = middle.on_line(component, x), c = fine.on_line(component, x);
    const double value = c + (c - b) / 3;
    worst = std::max(worst, std::abs(value - (b + (b - a) / 3)));
    std::printf("%s,%s,%s,%s,%s,%.6f\n", part[0].c_str(), part[1].c_str(), part[2].c_str(), part[3].c_str(),
                part[4].c_str(), value);
  }
  std::fprintf(stderr, "extrapolations of the two pairs of grids differ by %.2g at most\n", worst);
}
