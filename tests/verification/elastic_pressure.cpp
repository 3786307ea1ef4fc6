// Loads of a constant pressure and of hydrostatic pressure on the nodes of elastic bodies, against integrals over their
// elements.
#include "base/scene.h"
#include "exchange.h"

namespace elastic_pressure_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

struct LinearPressure {
  double constant;  // Pa, at the origin
  Vec3 slope;       // Pa/m
};

// Divergence theorem for each shape function: the load of p on the surface is
//   -int p n N_i dA = -int (N_i grad p + p grad N_i) dV
// on the deformed body. This reference uses no facets.
template <int Dim>
Eigen::VectorXd load_by_elements(const ElasticMesh<Dim>& mesh, const Eigen::VectorXd& u, const LinearPressure& p) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(u.size());
  const Vec<Dim> slope = truncate<Dim>(p.slope);
  const int count = mesh.nodes_per_element();
  for (int e = 0; e < mesh.element_count(); ++e) {
    Eigen::Matrix<double, Dim, Eigen::Dynamic> x(Dim, count);
    for (int i = 0; i < count; ++i)
      x.col(i) = mesh.nodes[std::size_t(mesh.element(e)[i])] + u.segment<Dim>(Dim * mesh.element(e)[i]);
    for (const auto& q : elastic::quadrature(Dim, 6)) {
      const Eigen::VectorXd N = elastic::shape_values(Dim, mesh.order, q.xi);
      const Eigen::MatrixXd dN = elastic::shape_gradients(Dim, mesh.order, q.xi);
      const Eigen::Matrix<double, Dim, Dim> dx = x * dN;
      const Eigen::MatrixXd gradient = dN * dx.inverse();
      const double pressure = p.constant + slope.dot(x * N), volume = q.weight * dx.determinant();
      for (int i = 0; i < count; ++i)
        load.segment<Dim>(Dim * mesh.element(e)[i]) -=
            volume * (N[i] * slope + pressure * Vec<Dim>(gradient.row(i).transpose()));
    }
  }
  return load;
}

// Balls and boxes of one to three cells, one in each quarter of the domain.
Scene scene_of(int dim, int order, int seed) {
  Scene s = box_scene(dim, dim == 2 ? 17 : 12);
  Dice dice{std::mt19937(unsigned(seed))};
  s.gravity = dice.vector(dim, -10, 10);
  for (int k = 0; k < 4; ++k) {
    SolidSpec& solid = s.solids.emplace_back();
    solid.name = fmt::format("solid{}", k);
    solid.kind = SolidKind::elastic;
    solid.shape.where = "test";
    solid.shape.kind = k < 2 ? "sphere" : "box";
    solid.shape.radius = dice(0.1, 0.15);
    solid.shape.upper = dice.vector(dim, 0.06, dim == 2 ? 0.13 : 0.1);
    solid.shape.lower = -solid.shape.upper;
    solid.shape.transform.translate =
        Vec3(0.26 + 0.48 * (k % 2), 0.26 + 0.48 * (k / 2), dim == 2 ? 0 : 0.5) + dice.vector(dim, -0.03, 0.03);
    if (k == 2) solid.shape.transform.rotate = {dim == 2 ? Vec3(0, 0, 1) : Vec3(dice.vector(3, 0.1, 1)), dice(0, 90)};
    solid.rigid.density = 500;
    solid.elastic.youngs_modulus = 1e5;
    solid.elastic.element_order = order;
    solid.elastic.element_size = dim == 2 ? 0.07 : 0.1;
  }
  return s;
}

// Largest difference, relative to the largest load.
template <int Dim>
double error_of(const Projection<Dim>& p, const LinearPressure& linear) {
  Vector pressure;
  for (const Site c : p.rows.cells)
    pressure.push_back(linear.constant + linear.slope.dot(extend<Dim>(p.setup.domain.layout.position(
                                             p.setup.domain.layout.index(c), cell_offset<Dim>()))));
  const double area = p.setup.domain.layout.geometry().face_area();
  const Eigen::VectorXd found = area * multiply_transposed(p.coupling.J, pressure, p.setup.domain.ranks);
  double worst = 0;
  for (std::size_t b = 0; b < p.coupling.bodies.size(); ++b) {
    const int k = p.coupling.bodies[b], first = p.coupling.first[b], n = p.coupling.first[b + 1] - first;
    const Eigen::VectorXd& u = elastic_motions(p.state.solids)[std::size_t(k)]->state.u;
    const Eigen::VectorXd exact =
        load_by_elements(p.setup.solids.bodies[std::size_t(k)].elastic().body.mesh, u, linear);
    Eigen::VectorXd mine = found.segment(first, n);
    if (!linear.slope.isZero()) mine += p.coupling.buoyancy_correction.segment(first, n);
    worst = std::max(worst, (mine - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff());
  }
  return worst;
}

template <class Check>
void for_bodies_in_full_box(const Check& check) {
  for (const int order : {1, 2})
    for (int seed = 0; seed < 4; ++seed) {
      Dice dice{std::mt19937(unsigned(seed + 100))};
      const auto deform = [&](ElasticState& e) {
        for (double& u : e.u) u = dice(-3e-3, 3e-3);
      };
      check(Projection<2>(scene_of(2, order, seed), Filling::closed, seed, deform));
      check(Projection<3>(scene_of(3, order, seed), Filling::closed, seed, deform));
    }
}

}  // namespace

TEST_CASE("a constant pressure loads each node of an elastic body as its own surface does", "[elastic][pressure]") {
  double worst = 0;
  for_bodies_in_full_box([&](const auto& p) { worst = std::max(worst, error_of(p, {1e4, Vec3::Zero()})); });
  WARN("largest error over the largest load: " << worst << ", bar 1e-12");
  CHECK(worst <= 1e-12);
}

TEST_CASE("liquid at rest loads each node of an elastic body as its own surface does", "[elastic][pressure]") {
  double worst = 0;
  for_bodies_in_full_box([&](const auto& p) {
    worst = std::max(worst, error_of(p, {1e4, p.setup.fluids.density() * p.setup.fluids.gravity.at(0)}));
  });
  WARN("largest error over the largest load: " << worst << ", bar 1e-12");
  CHECK(worst <= 1e-12);
}

}  // namespace elastic_pressure_tests
