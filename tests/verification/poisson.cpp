// Manufactured pressures: the cut-cell projection recovers p from u* = u + (dt/rho) grad p, u tangential to solids.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "coupling/geometry/step_geometry.h"
#include "fluid/pressure/pressure.h"
#include "grid/loops.h"
#include "levelset/redistance.h"
#include "scenes.h"

namespace poisson_tests {
using namespace seiche;

namespace {

constexpr double pi = 3.14159265358979323846;

// Grid, solids, surface and projection, set up as in a step (dt = rho = 1).
template <int Dim>
class Problem {
 public:
  Problem(int n, const std::vector<SolidSpec>& solids, std::function<double(const Vec<Dim>&)> phi)
      : scene_(test::box_scene(Dim, n)),
        layout_(geometry(n), geometry(n).box(), 4),
        halo_(layout_, {geometry(n).box()}, ranks_),
        sides_(scene_.domain),
        bodies_(make_bodies(solids)),
        solids_(layout_, sides_, bodies_),
        step_(solids_.measure(std::vector<Placement>(bodies_.size()), 0)),
        phi_(layout_) {
    for_each_index(layout_, layout_.cells(), [&](Site s, const IVec<Dim>& i) { phi_[s] = phi(center(i)); });
    fill_level_set_ghosts(layout_, halo_, phi_);
  }

  // L-infinity error of the pressure in cells with liquid centres, without its mean if `closed`. `velocity(axis, x)` is
  // free of divergence and tangential to the solids.
  double error(std::function<double(int, const Vec<Dim>&)> velocity, std::function<double(const Vec<Dim>&)> p,
               std::function<double(int, const Vec<Dim>&)> slope) {
    const ProjectionInput<Dim> in{layout_, halo_, ranks_, phi_, step_.faces, 1.0, 1.0};
    FaceField<Dim> u(layout_);
    for (int a = 0; a < Dim; ++a)
      for_each_index(layout_, layout_.grown(1), [&](Site f, const IVec<Dim>& i) {
        const Vec<Dim> x = layout_.position(i, face_offset<Dim>(a));
        u.at(a, f) = velocity(a, x) + slope(a, x);
        if (step_.faces.kind_at(a, f) == FaceKind::prescribed) step_.faces.prescribed.set(a, f, velocity(a, x));
      });
    const PressureRows<Dim> rows = number_rows(in);
    const NullSpace closed = find_closed_components(in, rows);
    std::vector<double> x(rows.cells.size());
    const SolveReport report =
        solve_spd(assemble_pressure_matrix(in, rows), row_grid(in, rows), closed, pressure_right_side(in, rows, u), x,
                  {.tolerance = 1e-11}, ranks_);  // below all discretisation errors here
    REQUIRE(report.converged);
    return largest_difference(rows, x, p, closed.count > 0);
  }

 private:
  static Geometry<Dim> geometry(int n) {
    Geometry<Dim> g;
    g.h = 1.0 / n;
    g.cells = IVec<Dim>::Constant(n);
    return g;
  }
  std::vector<Body<Dim>> make_bodies(const std::vector<SolidSpec>& specs) {
    std::vector<Body<Dim>> bodies;
    for (const SolidSpec& spec : specs) {
      const Vec<Dim> lower = Vec<Dim>::Zero(), upper = Vec<Dim>::Ones();
      bodies.emplace_back(spec, ShapeOptions{layout_.h(), nullptr}, lower, upper);
    }
    return bodies;
  }
  Vec<Dim> center(const IVec<Dim>& i) const { return layout_.position(i, cell_offset<Dim>()); }

  double largest_difference(const PressureRows<Dim>& rows, const std::vector<double>& x,
                            std::function<double(const Vec<Dim>&)> p, bool free_constant) const {
    double mean = 0;
    int count = 0;
    const auto counts = [&](Site c) { return step_.psi[c] > -layout_.h() && inside(c); };
    for (std::size_t n = 0; n < x.size(); ++n)
      if (counts(rows.cells[n])) mean += x[n] - p(center(layout_.index(rows.cells[n]))), ++count;
    mean = free_constant ? mean / count : 0;
    double largest = 0;
    for (std::size_t n = 0; n < x.size(); ++n)
      if (counts(rows.cells[n]))
        largest = std::max(largest, std::abs(x[n] - p(center(layout_.index(rows.cells[n]))) - mean));
    return largest;
  }

  // True if the centre of a cell lies outside the solids: mean psi of its nodes.
  bool inside(Site c) const {
    double sum = 0;
    for (int k = 0; k < (1 << Dim); ++k) {
      Site node = c;
      for (int a = 0; a < Dim; ++a) node += ((k >> a) & 1) * layout_.stride(a);
      sum += step_.psi[node];
    }
    return sum > 0;
  }

  Communicator ranks_;
  Scene scene_;
  Layout<Dim> layout_;
  Halo<Dim> halo_;
  DomainBoundary<Dim> sides_;
  std::vector<Body<Dim>> bodies_;
  SolidGeometry<Dim> solids_;
  StepGeometry<Dim> step_;
  CellField<Dim> phi_;
};

SolidSpec solid(const std::string& kind) {
  SolidSpec s;
  s.name = kind;
  s.shape.kind = kind;
  s.shape.where = "test";
  return s;
}

template <int Dim>
SolidSpec ball(bool container) {
  SolidSpec s = solid("sphere");
  s.shape.center = extend<Dim>(Vec<Dim>::Constant(0.5));
  s.shape.radius = container ? 0.4321 : 0.2345;
  s.shape.invert = container;
  return s;
}

// A container with plane walls at odd offsets: boxes cut by planes that are not aligned with the grid.
template <int Dim>
SolidSpec cut_box() {
  SolidSpec s = solid("box");
  s.shape.lower = extend<Dim>(Vec<Dim>::Constant(0.1037));
  s.shape.upper = extend<Dim>(Vec<Dim>::Constant(0.8931));
  s.shape.invert = true;
  return s;
}

template <int Dim>
double wave(const Vec<Dim>& x) {
  double p = 1;
  for (int a = 0; a < Dim; ++a) p *= std::cos(pi * x[a] * (1 + 0.5 * a) + 0.3 * a);
  return p;
}
template <int Dim>
double wave_slope(int axis, const Vec<Dim>& x) {
  double p = 1;
  for (int a = 0; a < Dim; ++a) {
    const double k = pi * (1 + 0.5 * a);
    p *= a == axis ? -k * std::sin(k * x[a] + 0.3 * a) : std::cos(k * x[a] + 0.3 * a);
  }
  return p;
}

// Rigid rotation about the middle: tangential to spheres there.
template <int Dim>
double rotation(int axis, const Vec<Dim>& x) {
  return axis == 0 ? -(x[1] - 0.5) : axis == 1 ? x[0] - 0.5 : 0;
}
template <int Dim>
double still(int, const Vec<Dim>&) {
  return 0;
}
template <int Dim>
double full(const Vec<Dim>&) {
  return -1;
}

template <int Dim>
void check_order(const std::string& name, const std::vector<SolidSpec>& solids,
                 std::function<double(int, const Vec<Dim>&)> u, std::function<double(const Vec<Dim>&)> phi,
                 std::function<double(const Vec<Dim>&)> p, std::function<double(int, const Vec<Dim>&)> slope) {
  const std::vector<int> sizes = Dim == 2 ? std::vector<int>{32, 64, 128} : std::vector<int>{24, 48, 96};
  std::vector<double> e;
  for (int n : sizes) e.push_back(Problem<Dim>(n, solids, phi).error(u, p, slope));
  const double fit = 0.5 * test::order(e[0], e[2]);  // least-squares slope through three points a factor of two apart
  WARN(name << " " << Dim << "D: L-infinity " << e[0] << ", " << e[1] << ", " << e[2] << ", order " << fit);
  CHECK(fit >= 1.9);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("pressure converges at second order between plane cut cells", "", ((int Dim), Dim), 2, 3) {
  check_order<Dim>("plane cut cells", {cut_box<Dim>()}, still<Dim>, full<Dim>, wave<Dim>, wave_slope<Dim>);
}

TEMPLATE_TEST_CASE_SIG("pressure converges at second order around a ball and within one", "[long]", ((int Dim), Dim), 2,
                       3) {
  check_order<Dim>("in a ball", {ball<Dim>(true)}, rotation<Dim>, full<Dim>, wave<Dim>, wave_slope<Dim>);
  check_order<Dim>("around a ball", {ball<Dim>(false)}, rotation<Dim>, full<Dim>, wave<Dim>, wave_slope<Dim>);
}

TEMPLATE_TEST_CASE_SIG("pressure converges at second order under a curved free surface", "", ((int Dim), Dim), 2, 3) {
  // p = (r^2 - R^2) (1 + x): zero on the surface r = R of a drop.
  const auto center = Vec<Dim>::Constant(0.5);
  const double R = 0.3789;
  const auto phi = [&](const Vec<Dim>& x) { return (x - center).norm() - R; };
  const auto p = [&](const Vec<Dim>& x) { return ((x - center).squaredNorm() - R * R) * (1 + x[0]); };
  const auto slope = [&](int a, const Vec<Dim>& x) {
    return 2 * (x[a] - 0.5) * (1 + x[0]) + (a == 0 ? (x - center).squaredNorm() - R * R : 0);
  };
  check_order<Dim>("drop", {}, still<Dim>, phi, p, slope);
}

}  // namespace poisson_tests
