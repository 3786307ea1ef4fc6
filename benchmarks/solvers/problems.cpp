#include "problems.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seiche::problems {
namespace {

double noise(std::int64_t n) {  // in (0, 1)
  std::uint64_t h = std::uint64_t(n) * 0x9E3779B97F4A7C15ull + 0x632BE59BD9B4E019ull;
  h = (h ^ (h >> 31)) * 0xBF58476D1CE4E5B9ull;
  h ^= h >> 29;
  return double(h >> 11) / double(1ull << 53);
}

struct Builder {
  const Problem& p;
  int nx = p.cells[0], ny = p.cells[1], nz = p.cells[2];
  double h = 1.0 / *std::max_element(p.cells.begin(), p.cells.end());
  std::array<int, 3> stride{1, nx, nx* ny};
  std::vector<float> phi;
  std::array<std::vector<float>, 3> weight;  // of the low face of each cell; 0 at walls
  std::vector<int> row;

  explicit Builder(const Problem& problem) : p(problem) {}

  template <class Visit>
  void for_cells(Visit visit) const {
    for (int k = 0, c = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i, ++c) visit(std::array<int, 3>{i, j, k}, c);
  }
  Point centre(const std::array<int, 3>& c) const {
    return {(c[0] + 0.5) * h, (c[1] + 0.5) * h, p.dimension == 3 ? (c[2] + 0.5) * h : 0.5};
  }
  // The open share of a face from the solid's distance at its centre.
  double open(const std::array<int, 3>& c, int axis) const {
    if (c[axis] == 0) return 0;
    if (!p.solid) return 1;
    Point at = centre(c);
    at[axis] -= 0.5 * h;
    const double share = p.solid(at) / h + 0.5;
    return share < 1e-3 ? 0 : std::min(1.0, share);
  }
  // 1 / density between two cells, ghost-fluid
  double lightness(double a, double b) const {
    const double gas = p.gas_density;
    const double theta =
        (a < 0) == (b < 0) ? (a < 0 ? 1.0 : 0.0) : std::max(1e-8, std::min(a, b) / (std::min(a, b) - std::max(a, b)));
    return 1 / (theta + (1 - theta) * gas);
  }
  bool is_liquid(int c) const { return phi[std::size_t(c)] < 0 || p.gas_density > 0; }

  void fill() {
    const auto cells = std::size_t(nx) * std::size_t(ny) * std::size_t(nz);
    phi.resize(cells);
    row.assign(cells, -1);
    for_cells([&](const auto& c, int n) { phi[std::size_t(n)] = float(p.liquid(centre(c))); });
    for (int a = 0; a < p.dimension; ++a) {
      weight[a].resize(cells);
      for_cells([&](const auto& c, int n) {
        const double w = open(c, a);
        if (w == 0 || (!is_liquid(n) && !is_liquid(n - stride[a]))) return;
        weight[a][std::size_t(n)] = float(w * lightness(phi[std::size_t(n)], phi[std::size_t(n - stride[a])]));
      });
    }
  }
  template <class Visit>
  void for_links(const std::array<int, 3>& c, int n, Visit visit) const {
    for (int a = p.dimension - 1; a >= 0; --a)
      if (c[a] > 0) visit(n - stride[a], double(weight[a][std::size_t(n)]));
    for (int a = 0; a < p.dimension; ++a)
      if (c[a] + 1 < p.cells[a]) visit(n + stride[a], double(weight[a][std::size_t(n + stride[a])]));
  }
  void number(System& s) {
    int next = 0;
    for_cells([&](const auto& c, int n) {
      bool any = false;
      for_links(c, n, [&](int, double w) { any = any || w > 0; });
      if (any && is_liquid(n)) row[std::size_t(n)] = next++;
    });
    s.A.global_rows = next;
    s.grid = {p.dimension, {0, 0, 0}, p.cells, {0, 0, 0}, row};
  }
  void assemble(System& s) const {
    for_cells([&](const auto& c, int n) {
      if (row[std::size_t(n)] < 0) return;
      const std::size_t diagonal = s.A.value.size();
      s.A.column.push_back(row[std::size_t(n)]);
      s.A.value.push_back(0);
      for_links(c, n, [&](int across, double w) {
        if (w == 0) return;
        s.A.value[diagonal] += w;
        if (row[std::size_t(across)] < 0) return;
        s.A.column.push_back(row[std::size_t(across)]);
        s.A.value.push_back(-w);
      });
      s.A.row_start.push_back(int(s.A.value.size()));
    });
  }
};

// Components without a held pressure.
void label(System& s) {
  const DistributedMatrix& A = s.A;
  std::vector<int>& component = s.null_space.component;
  component.assign(std::size_t(A.rows()), -2);
  std::vector<int> members;
  for (int seed = 0; seed < A.rows(); ++seed) {
    if (component[std::size_t(seed)] != -2) continue;
    members = {seed};
    component[std::size_t(seed)] = s.null_space.count;
    bool held = false;
    for (std::size_t m = 0; m < members.size(); ++m) {
      double sum = 0;
      for (int k = A.row_start[members[m]]; k < A.row_start[members[m] + 1]; ++k) {
        sum += A.value[std::size_t(k)];
        const int other = int(A.column[std::size_t(k)]);
        if (component[std::size_t(other)] != -2) continue;
        component[std::size_t(other)] = s.null_space.count;
        members.push_back(other);
      }
      held = held || sum > 1e-9 * A.value[std::size_t(A.row_start[members[m]])];
    }
    if (!held) ++s.null_space.count;
    for (std::size_t m = 0; m < members.size() && held; ++m) component[std::size_t(members[m])] = -1;
  }
}

}  // namespace

System build(const Problem& problem) {
  System s;
  Builder builder(problem);
  builder.fill();
  builder.number(s);
  builder.assemble(s);
  label(s);
  return s;
}

Problem sloping_surface(std::array<int, 3> cells) {
  Problem p{"fs", cells, 3, {}, {}, 0};
  p.liquid = [](const Point& x) { return (x[1] - 0.37 - 0.13 * x[0] - 0.07 * x[2]) / 1.02; };
  return p;
}

Problem drop_in_gas(std::array<int, 3> cells) {
  Problem p{"drop", cells, 3, {}, {}, 1e-3};
  p.liquid = [](const Point& x) {
    const double drop = std::hypot(x[0] - 0.5, x[1] - 0.6, x[2] - 0.5) - 0.23;
    return std::min(drop, x[1] - 0.2);
  };
  return p;
}

Problem full_box(std::array<int, 3> cells) {
  Problem p{"full", cells, cells[2] == 1 ? 2 : 3, {}, {}, 0};
  p.liquid = [](const Point&) { return -1.0; };
  return p;
}

Problem with_balls(Problem p, int count, double radius) {
  std::vector<Point> centres;
  for (int n = 0; n < count; ++n)
    centres.push_back({noise(3 * n + 100), noise(3 * n + 101), p.dimension == 3 ? noise(3 * n + 102) : 0.5});
  p.name += p.dimension == 3 ? ", balls" : ", discs";
  p.solid = [centres, radius](const Point& x) {
    double least = 10;
    for (const Point& c : centres) least = std::min(least, std::hypot(x[0] - c[0], x[1] - c[1], x[2] - c[2]));
    return least - radius;
  };
  return p;
}

Problem with_pores(Problem p) {
  p.name += ", pores";
  const double n = *std::max_element(p.cells.begin(), p.cells.end());
  // A face is open if the cells on both sides are: cells are told by noise, faces by their nearest two centres.
  const auto is_solid = [](int i, int j, int k) { return noise(i + 1000 * (j + 1000 * std::int64_t(k))) < 1.0 / 3; };
  p.solid = [n, is_solid](const Point& x) {
    std::array<int, 3> low{}, high{};
    for (int a = 0; a < 3; ++a) low[a] = int(std::floor(x[a] * n - 0.25)), high[a] = int(std::floor(x[a] * n + 0.25));
    return is_solid(low[0], low[1], low[2]) || is_solid(high[0], high[1], high[2]) ? -1.0 : 1.0;
  };
  return p;
}

}  // namespace seiche::problems
