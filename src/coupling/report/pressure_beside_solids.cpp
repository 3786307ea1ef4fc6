#include "coupling/report/pressure_beside_solids.h"

#include "coupling/geometry/cell_distance.h"
#include "grid/loops.h"
#include "linalg/core/dense_factors.h"

namespace seiche {
namespace {

constexpr int reach = 2;              // cells on each side of the point's cell
constexpr double passable = 1e-2;     // least open part of a face that joins two cells
constexpr double deepest = 0.5;       // cells: centres of cut cells may lie so deep in the solid
constexpr double farthest_fit = 2.0;  // cells: the fit's cells lie nearer to the point, where there are enough

// The cells around a point, numbered within a cube of 2 reach + 1 cells.
template <int Dim>
class Neighbourhood {
 public:
  static constexpr int width = 2 * reach + 1;
  static constexpr int count = Dim == 2 ? width * width : width * width * width;

  Neighbourhood(const Geometry<Dim>& grid, const Vec<Dim>& x) {
    for (int a = 0; a < Dim; ++a)
      lower_[a] = std::clamp(int(std::floor((x[a] - grid.lower[a]) / grid.h)), 0, grid.cells[a] - 1) - reach;
  }

  IVec<Dim> index(int n) const {
    IVec<Dim> i = lower_;
    for (int a = 0; a < Dim; ++a, n /= width) i[a] += n % width;
    return i;
  }
  // Number of the neighbour of cell n along an axis, or -1 outside the cube.
  int neighbour(int n, int axis, int sign) const {
    int stride = 1;
    for (int a = 0; a < axis; ++a) stride *= width;
    const int place = n / stride % width + sign;
    return place < 0 || place >= width ? -1 : n + sign * stride;
  }

 private:
  IVec<Dim> lower_;
};

// Values of a neighbourhood, the same on all ranks.
template <int Dim>
struct Samples {
  std::vector<double> pressure, usable;       // per cell; usable: 1 or 0
  std::array<std::vector<double>, Dim> open;  // of each cell's low faces
  bool any_solid = false;
};

// Each rank fills in the cells that it owns. Collective.
template <int Dim>
Samples<Dim> gather(const Domain<Dim>& domain, const State<Dim>& state, const StepGeometry<Dim>& g,
                    const Neighbourhood<Dim>& around, bool liquid) {
  constexpr int count = Neighbourhood<Dim>::count;
  std::vector<double> values(std::size_t(count) * (2 + Dim) + 1);
  for (int n = 0; n < count; ++n) {
    const IVec<Dim> i = around.index(n);
    if (!domain.layout.cells().contains(i)) continue;
    const Site c = domain.layout.site(i);
    double* const v = &values[std::size_t(n) * (2 + Dim)];
    v[0] = state.pressure[c];
    v[1] = (state.phi[c] < 0) == liquid && v[0] != 0 &&
           distance_at_cell(domain.layout, g.psi, c).first >= -deepest * domain.layout.h();
    for (int a = 0; a < Dim; ++a) {
      v[2 + a] = g.faces.open.at(a, c);
      if (v[2 + a] < 1) values.back() = 1;
    }
  }
  domain.ranks.global_sum(values);
  Samples<Dim> s;
  s.any_solid = values.back() > 0;
  for (int n = 0; n < count; ++n) {
    const double* const v = &values[std::size_t(n) * (2 + Dim)];
    s.pressure.push_back(v[0]);
    s.usable.push_back(v[1]);
    for (int a = 0; a < Dim; ++a) s.open[a].push_back(v[2 + a]);
  }
  return s;
}

// Outward normal of the nearest solid that has a distance, if that is within two cells; else zero.
template <int Dim>
Vec<Dim> normal_at(const Layout<Dim>& layout, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
                   const Vec<Dim>& x) {
  const double h = layout.h(), step = 1e-3 * h;
  double nearest = 2 * h;
  Vec<Dim> normal = Vec<Dim>::Zero();
  for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
    const Body<Dim>& body = solids.bodies[k];
    if (body.deforms()) continue;
    const auto distance = [&](const Vec<Dim>& y) { return body.distance_in(g.placed[k].pose, y); };
    if (std::abs(distance(x)) >= nearest) continue;
    nearest = std::abs(distance(x));
    for (int a = 0; a < Dim; ++a)
      normal[a] = distance(x + step * Vec<Dim>::Unit(a)) - distance(x - step * Vec<Dim>::Unit(a));
    if (normal.norm() > 0) normal.normalize();
  }
  return normal;
}

// The usable cell nearest to a point, or -1.
template <int Dim>
int nearest_usable(const Layout<Dim>& layout, const Neighbourhood<Dim>& around, const Samples<Dim>& s,
                   const Vec<Dim>& x) {
  int best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (int n = 0; n < around.count; ++n) {
    const double away = (layout.position(around.index(n), cell_offset<Dim>()) - x).norm();
    if (s.usable[n] == 0 || away >= nearest) continue;
    nearest = away;
    best = n;
  }
  return best;
}

// Flags of the usable cells that open faces join to the cell `start`.
template <int Dim>
std::vector<char> joined(const Neighbourhood<Dim>& around, const Samples<Dim>& s, int start) {
  std::vector<char> found(s.usable.size(), 0);
  std::vector<int> left{start};
  found[start] = 1;
  while (!left.empty()) {
    const int n = left.back();
    left.pop_back();
    for (int a = 0; a < Dim; ++a)
      for (const int sign : {-1, 1}) {
        const int to = around.neighbour(n, a, sign);
        if (to < 0 || found[to] || s.usable[to] == 0 || s.open[a][sign < 0 ? n : to] < passable) continue;
        found[to] = 1;
        left.push_back(to);
      }
  }
  return found;
}

// True if no usable cell lies on another side of a solid.
template <int Dim>
bool all_joined(const Samples<Dim>& s, const std::vector<char>& joined) {
  for (std::size_t n = 0; n < joined.size(); ++n)
    if (s.usable[n] != 0 && !joined[n]) return false;
  return true;
}

// Least squares for a + b.(x_c - x)/h over the cells, with weights 1/(1/10 + |x_c - x|^2/h^2)^2, which leave next to
// nothing of the curvature that a line through far cells would see. Directions without cells get no slope.
template <int Dim>
double fit(const Layout<Dim>& layout, const Neighbourhood<Dim>& around, const Samples<Dim>& s,
           const std::vector<char>& cells, const Vec<Dim>& x, double farthest) {
  std::vector<Eigen::Matrix<double, Dim + 1, 1>> rows;
  std::vector<double> right;
  for (int n = 0; n < around.count; ++n) {
    const Vec<Dim> way = (layout.position(around.index(n), cell_offset<Dim>()) - x) / layout.h();
    if (!cells[n] || way.norm() > farthest) continue;
    const double weight = 1 / (0.1 + way.squaredNorm());  // its square is the weight
    Eigen::Matrix<double, Dim + 1, 1> row;
    row << 1, way;
    rows.push_back(weight * row);
    right.push_back(weight * s.pressure[n]);
  }
  Eigen::MatrixXd A(rows.size(), Dim + 1);
  for (std::size_t r = 0; r < rows.size(); ++r) A.row(Eigen::Index(r)) = rows[r];
  const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(right.data(), Eigen::Index(right.size()));
  return shortest_least_squares(A, b)[0];
}

}  // namespace

template <int Dim>
std::optional<double> pressure_beside_solids(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                             const State<Dim>& state, const StepGeometry<Dim>& g, const Vec<Dim>& x,
                                             bool liquid) {
  if (solids.bodies.empty()) return {};
  const Layout<Dim>& layout = domain.layout;
  const Neighbourhood<Dim> around(layout.geometry(), x);
  const Samples<Dim> samples = gather(domain, state, g, around, liquid);
  if (!samples.any_solid) return {};
  const int start =
      nearest_usable(layout, around, samples, Vec<Dim>(x + 0.5 * layout.h() * normal_at(layout, solids, g, x)));
  if (start < 0) return {};
  const std::vector<char> cells = joined(around, samples, start);
  if (all_joined(samples, cells)) return {};
  const double to_start = (layout.position(around.index(start), cell_offset<Dim>()) - x).norm() / layout.h();
  return fit(layout, around, samples, cells, x, std::max(farthest_fit, to_start + 1));
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template std::optional<double> pressure_beside_solids<D>(const Domain<D>&, const Solids<D>&, const State<D>&, \
                                                           const StepGeometry<D>&, const Vec<D>&, bool);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
