// Exact properties of the small pieces of coupling.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "coupling/geometry/cell_distance.h"
#include "coupling/geometry/periodic_places.h"
#include "coupling/solids/face_columns.h"
#include "coupling/solids/potential_sum.h"
#include "coupling/state/setup.h"
#include "coupling/step/initial_state.h"
#include "coupling/tension/tension_filter.h"
#include "coupling/thin/gap_flow.h"
#include "coupling/thin/thin_solids.h"
#include "coupling/transport/two_fluids.h"
#include "grid/loops.h"
#include "verification/scenes.h"

namespace pieces_tests {
using namespace seiche;

namespace {

Fluids fluids_with(const Formula& viscosity, const std::string& model = "", double of_gas = 0) {
  Scene s = test::box_scene(2, 8);
  s.liquid.viscosity = viscosity;
  s.liquid.rheology.model = model;
  s.liquid.rheology.viscosity = 1;
  s.liquid.rheology.yield_stress = 1;
  s.gas.present = of_gas > 0;
  s.gas.viscosity = of_gas;
  return Fluids(s);
}

// E = k v^2/2 in one unknown, with a bound of the step.
struct Spring : VelocityPotential {
  int unknown;
  double k, bound;
  Spring(int i, double stiffness, double share) : unknown(i), k(stiffness), bound(share) {}
  double energy(const Eigen::VectorXd& v) const override { return 0.5 * k * v[unknown] * v[unknown]; }
  void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& g) const override { g[unknown] += k * v[unknown]; }
  Eigen::SparseMatrix<double> hessian(const Eigen::VectorXd& v, HessianProjection, IndexRange) const override {
    Eigen::SparseMatrix<double> H(v.size(), v.size());
    H.insert(unknown, unknown) = k;
    return H;
  }
  double step_bound(const Eigen::VectorXd&, const Eigen::VectorXd&) const override { return bound; }
  double round_off() const override { return k; }
};

Geometry<3> unit_box(int cells, bool periodic) {
  Geometry<3> g;
  g.h = 1.0 / cells;
  g.cells = {cells, cells, cells};
  g.periodic = {periodic, false, periodic};
  return g;
}

// A plate of half a cell that has just come in through the upper side. Before, it lay outside of the domain.
// Boxes `thickness` cells thick with their lower side at y = `bottom`.
bool box_is_thin(double thickness, double bottom) {
  Scene s = test::box_scene(2, 16);
  SolidSpec box;
  box.name = "box";
  box.kind = SolidKind::fixed;
  box.shape.kind = "box";
  box.shape.lower = {-0.5, bottom, 0};
  box.shape.upper = {1.5, bottom + thickness / 16, 0};
  s.solids.push_back(box);
  return Setup<2>(s, Communicator()).solids.bodies[0].is_thin();
}

template <int Dim>
void check_dry_beside_new_plate() {
  Scene s = test::box_scene(Dim, 16);
  SolidSpec plate;
  plate.name = "plate";
  plate.kind = SolidKind::kinematic;
  plate.shape.kind = "box";
  plate.shape.lower = {0.2, 0.48, Dim == 3 ? 0.2 : 0.0};
  plate.shape.upper = {0.8, 0.51, Dim == 3 ? 0.8 : 0.0};
  plate.motion.translate[1] = "2 - 2*t";
  s.solids.push_back(plate);
  const Setup<Dim> setup(s, Communicator());
  REQUIRE(setup.solids.bodies[0].is_thin());
  State<Dim> before;
  before.solids = setup.solids.at_start;
  before.phi = CellField<Dim>(setup.domain.layout, 1.0);
  const StepGeometry<Dim> g = setup.solids.geometry.measure({before.solids[0].place(1, 1, 1)}, 1);
  REQUIRE_FALSE(g.sealed.empty());
  CellField<Dim> phi = before.phi;
  keep_sides_apart(setup.domain, setup.solids, place_bodies(before), before.phi, g, phi);
  for_each_index_in_order(setup.domain.layout, setup.domain.layout.cells(),
                          [&](Site c, const IVec<Dim>&) { CHECK(phi[c] == 1.0); });
}

// A channel along x between walls, one cell high, whose faces open from w0 to w1.
template <int Dim>
double velocity_in_slit(double w0, double w1) {
  Scene s = test::box_scene(Dim, 8);
  s.domain.cells[1] = 1;
  s.domain.upper[1] = s.domain.cell_size;
  const Setup<Dim> setup(s, Communicator());
  FaceGeometry<Dim> faces(setup.domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(setup.domain.layout, setup.domain.layout.padded(),
                            [&](Site f, const IVec<Dim>&) { faces.open.set(a, f, w1); });
  GapFlow<Dim> flow(setup.domain.layout);
  flow.open.fill(w0);
  flow.u.fill(3.0);
  FaceField<Dim> u(setup.domain.layout, 7.0);
  set_gap_velocity(setup.domain, faces, flow, {2, 0, 0}, 0.5, u);
  return u.at(0, setup.domain.layout.site(IVec<Dim>::Unit(0) * 4));
}

}  // namespace

TEST_CASE("viscosity is constant if it is one number, and the liquid viscous unless that is 0") {
  CHECK(fluids_with("0.5").constant_viscosity() == 0.5);
  CHECK(fluids_with("2*3").constant_viscosity() == 6);
  CHECK(fluids_with("0").constant_viscosity() == 0);
  CHECK_FALSE(fluids_with("0.1+x").constant_viscosity().has_value());
  CHECK_FALSE(fluids_with("0.1", "bingham").constant_viscosity().has_value());
  CHECK(fluids_with("0.5").is_viscous());
  CHECK(fluids_with("0*x").is_viscous());
  CHECK(fluids_with("0", "bingham").is_viscous());
  CHECK_FALSE(fluids_with("0").is_viscous());
  CHECK(fluids_with("0", "", 1e-5).is_viscous());
}

TEST_CASE("gas that is not there has neither density nor viscosity") {
  CHECK(fluids_with("0").gas_density() == 0);
  CHECK(fluids_with("0").gas_viscosity() == 0);
  CHECK(fluids_with("0", "", 1e-5).gas_density() == 1.2);
  CHECK(fluids_with("0", "", 1e-5).gas_viscosity() == 1e-5);
}

// Each of the 2^d ranks then has the cells and halos of the one rank of the smaller scene.
TEST_CASE("a grid twice as fine on 2^d times the ranks needs 2^d times the memory") {
  for (const int dim : {2, 3}) {
    const int more = 1 << dim;
    const Cost one = estimate_cost(test::box_scene(dim, 40), 1), many = estimate_cost(test::box_scene(dim, 80), more);
    CHECK(many.cells == more * one.cells);
    CHECK(many.bytes == Approx(more * one.bytes).epsilon(1e-12));  // round-off of the root
  }
}

TEST_CASE("memory before the set-up counts gas and viscosity") {
  Scene scene = test::box_scene(3, 40);
  const double plain = estimate_cost(scene, 1).bytes;
  CHECK(plain > 350 * 64000);
  scene.liquid.viscosity = "0.1*t";
  const double viscous = estimate_cost(scene, 1).bytes;
  scene.gas.present = true;
  const double gas = estimate_cost(scene, 1).bytes;
  CHECK((plain < viscous && viscous < gas));
}

TEST_CASE("levels of a flow move one step into the past, and the present one stays") {
  Flow<2> flow;
  const auto first = std::make_shared<TimeLevel<2>>(), second = std::make_shared<TimeLevel<2>>();
  flow.now = first;
  age(flow);
  CHECK((flow.now == first && flow.before == first && flow.earlier == nullptr));
  flow.now = second;
  age(flow);
  CHECK((flow.now == second && flow.before == second && flow.earlier == first));
}

TEST_CASE("a sum of potentials adds energies and terms, and keeps the smallest bound") {
  const auto soft = std::make_shared<Spring>(0, 2, 0.75), stiff = std::make_shared<Spring>(1, 8, 0.25);
  CHECK(sum_of({}) == nullptr);
  CHECK(sum_of({soft}) == soft);
  const auto sum = sum_of({soft, stiff});
  const Eigen::VectorXd v = Eigen::Vector2d(3, -1);
  CHECK(sum->energy(v) == 9 + 4);
  CHECK(sum->step_bound(v, v) == 0.25);
  CHECK(sum->round_off() == 10);
  Eigen::VectorXd g = Eigen::Vector2d(1, 1);
  sum->add_gradient(v, g);
  CHECK(g == Eigen::VectorXd(Eigen::Vector2d(7, -7)));
  const Eigen::Matrix2d hessian = sum->hessian(v, HessianProjection{}, {0, 2});
  CHECK(hessian == Eigen::Matrix2d(Eigen::Vector2d(2, 8).asDiagonal()));
}

TEST_CASE("the distance at a cell centre is exact for a plane") {
  const Geometry<3> grid = unit_box(8, false);
  const Layout<3> layout(grid, grid.box(), 2);
  const Vec<3> slope(0.5, -0.25, 0.125);
  NodeField<3> psi(layout);
  for_each_index_in_order(layout, layout.padded(),
                          [&](Site s, const IVec<3>& i) { psi[s] = slope.dot(layout.position(i, node_offset<3>())); });
  for_each_index_in_order(layout, layout.cells(), [&](Site s, const IVec<3>& i) {
    const auto [distance, gradient] = distance_at_cell(layout, psi, s);
    CHECK(distance == slope.dot(layout.position(i, cell_offset<3>())));
    CHECK(gradient == Vec<3>(slope * grid.h));
  });
}

TEST_CASE("nodes at periodic sides take the least distance of all their images") {
  const Geometry<3> grid = unit_box(8, true);
  const Layout<3> layout(grid, grid.box(), 2);
  const Vec<3> corner(1, 0.5, 1);  // an image of (0, 0.5, 0)
  const auto distance = [&](const Vec<3>& x) { return (x - corner).norm(); };
  for (const IVec<3>& i : {IVec<3>(0, 4, 0), IVec<3>(8, 4, 0), IVec<3>(0, 4, 8), IVec<3>(8, 4, 8)})
    CHECK(least_distance(layout, i, distance) == 0);
  CHECK(least_distance(layout, {4, 4, 8}, distance) == 0.5);  // only z has an image
  CHECK(least_distance(layout, {8, 0, 8}, distance) == 0.5);  // sides along y are walls
  CHECK(to_other_side(layout, 0, {0, 4, 3}) == 1);
  CHECK(to_other_side(layout, 0, {8, 4, 3}) == -1);
  CHECK(to_other_side(layout, 0, {5, 4, 3}) == 0);
  CHECK(to_other_side(layout, 1, {0, 0, 0}) == 0);
}

TEST_CASE("liquid in a widening slit keeps its kinetic energy w u^2 and takes up gravity") {
  for (const double w : {0.05, 0.1}) {
    CHECK(velocity_in_slit<2>(0.01, w) == Approx(3 * std::sqrt(0.01 / w) + 1).epsilon(1e-15));
    CHECK(velocity_in_slit<3>(0.01, w) == Approx(3 * std::sqrt(0.01 / w) + 1).epsilon(1e-15));
  }
  CHECK(velocity_in_slit<2>(0.1, 0.05) == 7);        // a narrowing slit
  CHECK(velocity_in_slit<2>(0.1, least_open) == 7);  // no slit any more
}

TEST_CASE("boxes count as thin if no ball of a cell fits in, wherever they begin") {
  CHECK(box_is_thin(0.9, 0.3));
  CHECK_FALSE(box_is_thin(1.2, 0.3));  // no sample a quarter of a cell apart lay in its middle
  CHECK_FALSE(box_is_thin(3, 0.3));
  CHECK_FALSE(box_is_thin(3, -3.0 / 16));  // its top is the floor of the domain
  CHECK_FALSE(box_is_thin(3, 1.5));        // it may come in later
  CHECK(box_is_thin(0.9, 1.5));
}

TEST_CASE("a thin plate that comes in from outside does not wet the air beside it") {
  check_dry_beside_new_plate<2>();
  check_dry_beside_new_plate<3>();
}

TEST_CASE("curvature is filtered only in steps longer than the explicit limit, by a length that grows as dt^(2/3)") {
  const double sigma = 0.07, rho = 1000, h = 1e-3;
  const double limit = std::sqrt(rho * h * h * h / (4 * 3.14159265358979323846 * sigma));
  CHECK(filter_length(sigma, rho, h, 0.999 * limit) == 0);
  const double one = filter_length(sigma, rho, h, 2 * limit), eight = filter_length(sigma, rho, h, 16 * limit);
  CHECK(one > 0);
  CHECK(eight == Approx(4 * one).epsilon(1e-14));
  CHECK(filter_length(sigma, rho, 2 * h, 16 * limit) == Approx(eight / 2).epsilon(1e-14));  // a length, in cells
}

TEST_CASE("liquid share of a box is exact at its sides and its middle, and both fluids fill it") {
  CHECK(liquid_share_at(-0.5, 1) == 1);
  CHECK(liquid_share_at(0, 1) == 0.5);
  CHECK(liquid_share_at(0.5, 1) == 0);
  for (const double phi : {-2.0, -0.375, 0.125, 0.4, 3.0})
    CHECK(liquid_share_at(phi, 1) + liquid_share_at(-phi, 1) == 1);
}

TEST_CASE("entries of one row and column add up, and go to the block of their kind only") {
  std::vector<FluxEntry> entries{{2, 1, 0.5}, {0, 0, 1.0}, {2, 1, 0.25}, {1, 0, 2.0}, {1, 0, -2.0}};
  sort_by_rows(entries);
  const std::vector<Freedom> freedom{Freedom::fixed, Freedom::free, Freedom::fixed};  // the body begins at 1
  const auto sums = [&](Freedom kind) {
    std::vector<std::array<double, 3>> found;
    make_block(entries, freedom, kind, 1, 2).for_each([&](int row, int column, double value) {
      if (value != 0) found.push_back({double(row), double(column), value});
    });
    return found;
  };
  using Sums = std::vector<std::array<double, 3>>;
  CHECK(sums(Freedom::free) == Sums{{0, 0, 1.0}});
  CHECK(sums(Freedom::fixed) == Sums{{2, 1, 0.75}});
}

}  // namespace pieces_tests
