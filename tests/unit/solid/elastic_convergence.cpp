// Orders of convergence: manufactured static solutions in space, refined steps in time.
#include <Eigen/Dense>

#include "unit/solid/elastic_cases.h"

namespace elastic_convergence_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

// u_i = a sin(k_i . X + i) on the unit box, k_i = pi (1, ..., 1) with the i-th entry halved.
template <int Dim>
struct Manufactured {
  ElasticMaterial<Dim> material;
  Lame lame = lame_of(1e5, 0.3);
  double amplitude = 0.05;

  static Vec<Dim> wave(int i) {
    Vec<Dim> k = Vec<Dim>::Constant(3.14159265358979323846);
    k[i] /= 2;
    return k;
  }
  Vec<Dim> displacement(const Vec<Dim>& X) const {
    Vec<Dim> u;
    for (int i = 0; i < Dim; ++i) u[i] = amplitude * std::sin(wave(i).dot(X) + i);
    return u;
  }
  Gradient<Dim> deformation(const Vec<Dim>& X) const {
    Gradient<Dim> F = Gradient<Dim>::Identity();
    for (int i = 0; i < Dim; ++i) F.row(i) += amplitude * std::cos(wave(i).dot(X) + i) * wave(i).transpose();
    return F;
  }
  // f = -Div P by central differences; error about 1e-8 of f.
  Vec<Dim> load(const Vec<Dim>& X) const {
    const double h = 1e-4;
    Vec<Dim> f = Vec<Dim>::Zero();
    for (int j = 0; j < Dim; ++j) {
      const Vec<Dim> step = h * Vec<Dim>::Unit(j);
      f -= (material.stress(lame, deformation(X + step)) - material.stress(lame, deformation(X - step))).col(j) /
           (2 * h);
    }
    return f;
  }
};

// sqrt of the integral of |u_h - u|^2
template <int Dim>
double error_norm(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Manufactured<Dim>& exact) {
  double sum = 0;
  for (const auto& [xi, weight] : elastic::quadrature(Dim, 5)) {
    const Eigen::VectorXd N = elastic::shape_values(Dim, body.mesh.order, xi);
    const Eigen::MatrixXd dN = elastic::shape_gradients(Dim, body.mesh.order, xi);
    for (int e = 0; e < body.mesh.element_count(); ++e) {
      Vec<Dim> X = Vec<Dim>::Zero(), here = Vec<Dim>::Zero();
      Gradient<Dim> map = Gradient<Dim>::Zero();
      for (int a = 0; a < N.size(); ++a) {
        const int node = body.mesh.element(e)[a];
        X += N[a] * body.mesh.nodes[node];
        here += N[a] * u.template segment<Dim>(Dim * node);
        map += body.mesh.nodes[node] * dN.row(a);
      }
      sum += weight * map.determinant() * (here - exact.displacement(X)).squaredNorm();
    }
  }
  return std::sqrt(sum);
}

template <int Dim>
double space_error(const Manufactured<Dim>& exact, int cells, int order) {
  ElasticProperties properties;
  properties.lame = exact.lame;
  const auto body = make_elastic_body<Dim>(
      box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Constant(cells), order), exact.material, properties);
  Pins pins = pin_nodes<Dim>(nodes_where(
      body.mesh, [](const Vec<Dim>& X) { return (X.array() < 1e-9).any() || (X.array() > 1 - 1e-9).any(); }));
  const Eigen::VectorXd at = at_nodes(body.mesh, [&](const Vec<Dim>& X) { return exact.displacement(X); });
  for (size_t i = 0; i < pins.dofs.size(); ++i) pins.targets[i] = at[pins.dofs[i]];
  const Eigen::VectorXd force = body_force<Dim>(body, [&](const Vec<Dim>& X) { return exact.load(X); });
  ElasticWorkspace workspace;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(body.size());
  const auto report = solve_static<Dim>(body, force, pins, 1, {}, workspace, u);
  INFO(report.failure);
  REQUIRE(report.converged);
  return error_norm(body, u, exact);
}

// A block in free flight, rotating and stretched from its rest shape. Steps alternate as in wag(). The energy that
// steps add is removed (solid/elastic/excess.h).
Eigen::VectorXd tumble(const ElasticBody<2>& block, ElasticScheme scheme, int steps) {
  const double duration = 0.2;
  ElasticState state = at_rest(block);
  state.v = at_nodes(block.mesh, [](const Vec<2>& X) { return Vec<2>(0.5 * X[0] - 2 * X[1], 2 * X[0] - 0.3 * X[1]); });
  MinimizeOptions options;
  options.step_tolerance = 1e-11;
  ElasticWorkspace workspace;
  const StepLoad none{Eigen::VectorXd::Zero(block.size()), true};
  for (int n = 0; n < steps; ++n) {
    const double dt = duration / steps * (n % 2 ? 1.2 : 0.8);
    REQUIRE(advance<2>(block, scheme, dt, none, {}, options, workspace, state).converged);
  }
  return state.u;
}

// Displacements at the end of a clamped strip under a load sin^2 in time, from rest: smooth in time, so that the order
// shows. Steps alternate between 0.8 and 1.2 dt.
Eigen::VectorXd wag(const Strip& strip, const Eigen::VectorXd& load, ElasticScheme scheme, int steps) {
  const double duration = 0.1;
  ElasticState state = at_rest(strip.body);
  MinimizeOptions options;
  options.step_tolerance = 1e-11;  // far below the differences between step sizes
  ElasticWorkspace workspace;
  double time = 0;
  for (int n = 0; n < steps; ++n) {
    const double dt = duration / steps * (n % 2 ? 1.2 : 0.8);
    time += dt;
    const double share = std::pow(std::sin(3.14159265358979323846 * time / duration), 2);
    const auto report =
        advance<2>(strip.body, scheme, dt, {share * load, false}, strip.clamp, options, workspace, state);
    REQUIRE(report.converged);
  }
  return state.u;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Displacements converge at order 2 (P1) and 3 (P2)", "[elastic]", ((int Dim), Dim), 2, 3) {
  for (const auto& row : elastic_materials<Dim>()) {
    if (Dim == 3 && row.name != "stable_neo_hookean" && row.name != "st_venant_kirchhoff") continue;
    for (int order : {1, 2}) {
      const std::vector<int> cells = Dim == 2 ? std::vector<int>{8, 16, 32} : std::vector<int>{2, 4, 6};
      std::vector<double> error;
      for (int n : cells) error.push_back(space_error(Manufactured<Dim>{row}, n, order));
      const double rate = std::log(error[1] / error[2]) / std::log(double(cells[2]) / cells[1]);
      WARN(Dim << "D, P" << order << ", " << row.name << ": L2 errors " << error[0] << ", " << error[1] << ", "
               << error[2] << "; order " << rate);
      CHECK(rate > order + 1 - 0.2);
    }
  }
}

TEST_CASE("Time steps converge at order 1 (backward Euler) and 2 (BDF2), uneven steps too", "[elastic]") {
  const auto strip = clamped_strip(0.2, 0.02, IVec<2>(10, 1), 2, "stable_neo_hookean", 1000, 2e6, 0.3975);
  const Eigen::VectorXd load = body_force<2>(strip.body, [](const Vec<2>&) -> Vec<2> { return {0, -1e4}; });
  const auto block = elastic_body<2>(box_mesh<2>(Vec<2>::Zero(), Vec<2>::Ones(), IVec<2>::Constant(2), 1),
                                     "stable_neo_hookean", 1000, 1e5, 0.4);
  for (const bool clamped : {true, false})
    for (const auto scheme : {ElasticScheme::backward_euler, ElasticScheme::bdf2}) {
      const int expected = scheme == ElasticScheme::bdf2 ? 2 : 1;
      std::vector<Eigen::VectorXd> u;
      for (int steps : {100, 200, 400, 800})
        u.push_back(clamped ? wag(strip, load, scheme, steps) : tumble(block, scheme, steps));
      const double coarse = (u[1] - u[2]).norm(), fine = (u[2] - u[3]).norm(), rate = std::log2(coarse / fine);
      WARN((expected == 2 ? "BDF2" : "backward Euler")
           << (clamped ? ", strip" : ", block in flight") << ": differences " << (u[0] - u[1]).norm() << ", " << coarse
           << ", " << fine << "; order " << rate);
      CHECK(rate > expected - 0.2);
    }
}

}  // namespace elastic_convergence_tests
