// Stresses in frames, and points that probes follow.
#include "base/error.h"
#include "base/probe_spec.h"
#include "solid/elastic/output.h"
#include "solid/mesh/point.h"
#include "unit/solid/elastic_cases.h"

namespace elastic_output_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

// A slightly curved bar along x, so that the maps of its quadratic elements are not affine.
template <int Dim>
ElasticMesh<Dim> bar(int order, double bend) {
  ElasticMesh<Dim> mesh = box_mesh<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), IVec<Dim>::Constant(2), order);
  for (auto& X : mesh.nodes) X[1] += bend * X[0] * X[0];
  return mesh;
}

}  // namespace

// Uniaxial stress at small strain e: 3D sigma = E e; 2D E e / (1 - nu^2) along x and nu times that across.
TEMPLATE_TEST_CASE_SIG("Von Mises stress of a stretched bar", "[elastic][output]", ((int Dim), Dim), 2, 3) {
  const double E = 1e6, nu = 0.3, e = 1e-6;
  for (const int order : {1, 2}) {
    for (const char* model : {"stable_neo_hookean", "neo_hookean", "corotated", "st_venant_kirchhoff"}) {
      const auto body = elastic_body<Dim>(bar<Dim>(order, 0.1), model, 1000, E, nu);
      const double across = Dim == 2 ? nu / (1 - nu) : nu;
      const Eigen::VectorXd u = at_nodes(body.mesh, [&](const Vec<Dim>& X) {
        Vec<Dim> r = -across * e * X;
        r[0] = e * X[0];
        return r;
      });
      const double expected = Dim == 2 ? E * e / (1 - nu * nu) * std::sqrt(1 - nu + nu * nu) : E * e;
      INFO(model << ", order " << order);
      for (const double stress : von_mises_stress(body, u))
        CHECK(stress == Approx(expected).epsilon(1e-4));  // O(e), and round-off over E e
    }
  }
}

TEMPLATE_TEST_CASE_SIG("Turning a body gives no stress", "[elastic][output]", ((int Dim), Dim), 2, 3) {
  const auto body = elastic_body<Dim>(bar<Dim>(2, 0.1), "stable_neo_hookean", 1000, 1e6, 0.4);
  const Eigen::VectorXd u = at_nodes(body.mesh, [](const Vec<Dim>& X) {
    Vec<Dim> r = Vec<Dim>::Zero();
    r[0] = -X[0] - X[1];
    r[1] = X[0] - X[1];
    return r;
  });
  for (const double stress : von_mises_stress(body, u)) CHECK(stress < 1e-6);  // round-off of 1e6 Pa
}

TEMPLATE_TEST_CASE_SIG("A frame of a body is plain data", "[elastic][output]", ((int Dim), Dim), 2, 3) {
  const auto body = elastic_body<Dim>(bar<Dim>(2, 0), "corotated", 1000, 1e6, 0.3);
  ElasticSurface surface = surface_of(body.mesh);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(body.size()), v = u;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    u[i] = 0.001 * double(i);
    v[i] = -double(i);
  }
  const VolumeFrame frame = volume_frame(body, surface, u, v);
  CHECK(frame.dimension == Dim);
  CHECK(frame.order == 2);
  CHECK(frame.elements == body.mesh.elements);
  REQUIRE(frame.rest.size() == body.mesh.nodes.size());
  CHECK(frame.von_mises.size() == frame.rest.size());
  CHECK(frame.displacement[3][1] == u[3 * Dim + 1]);
  CHECK(frame.velocity[3][0] == v[3 * Dim]);
  move_surface(surface, body.mesh, u);
  REQUIRE(frame.surface_nodes.size() == surface.facets.points.size());
  for (std::size_t p = 0; p < frame.surface_nodes.size(); ++p) {
    const auto n = std::size_t(frame.surface_nodes[p]);
    CHECK((frame.rest[n] + frame.displacement[n] - surface.facets.points[p]).norm() < 1e-14);
  }
}

TEMPLATE_TEST_CASE_SIG("Material points are found and followed", "[elastic][output]", ((int Dim), Dim), 2, 3) {
  for (const int order : {1, 2}) {
    const auto mesh = bar<Dim>(order, order == 2 ? 0.1 : 0);
    // A field that elements of this order represent exactly, in the coordinates of the undistorted box.
    const auto plain = [&](Vec<Dim> X) {
      if (order == 2) X[1] -= 0.1 * X[0] * X[0];
      return X;
    };
    const Eigen::VectorXd values = at_nodes(mesh, [&](const Vec<Dim>& X) { return plain(X); });
    for (const double x : {0., 0.1, 0.5, 0.77, 1.}) {
      for (const double y : {0., 0.31, 0.5, 1.}) {
        Vec<Dim> X = Vec<Dim>::Constant(0.4);
        X[0] = x;
        X[1] = y + (order == 2 ? 0.1 * x * x : 0);
        const MaterialPoint point = locate<Dim>(mesh, X);
        INFO("order " << order << " at " << x << ", " << y);
        CHECK(point.distance < 1e-12);
        CHECK((interpolate(mesh, point, values) - plain(X)).norm() < 1e-11);
        CHECK(point.weights.sum() == Approx(1));
      }
    }
  }
}

TEST_CASE("A probe beside its solid is refused with the distance", "[elastic][output]") {
  const auto mesh = bar<3>(2, 0);
  ProbeSpec probe;
  probe.name = "tip";
  probe.solid = "gate";
  probe.where = "scene.toml:30";
  probe.position = {1.25, 0.5, 0.5};
  CHECK_THROWS_WITH(
      point_of_probe<3>(mesh, probe),
      "scene.toml:30: probe 'tip' lies 0.25 m outside solid 'gate' at rest; the nearest point of it is (1, "
      "0.5, 0.5)");
  probe.position = {1.001, 0.5, 0.5};
  CHECK(point_of_probe<3>(mesh, probe).distance == Approx(0.001));
}

}  // namespace elastic_output_tests
