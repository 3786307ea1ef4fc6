// Requirements that every kind of solid in the table must meet.
#include <bit>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "base/scene.h"
#include "coupling/solids/solid_kinds.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/step/initial_state.h"
#include "unit/files/scratch.h"
#include "verification/scenes.h"

namespace participants_tests {
using namespace seiche;

namespace {

// Two tetrahedra that differ in height, as a sequence of meshes.
const std::filesystem::path& tetrahedra() {
  static const ScratchFolder folder;
  static std::filesystem::path first;
  for (const int n : {1, 0})
    first = folder.write(
        fmt::format("tet.{}.obj", n),
        fmt::format("v 0 0 0\nv 0.6 0 0\nv 0 0.6 0\nv 0 0 {}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n", 0.6 + 0.1 * n));
  return first;
}

// Two outlines of a triangle that differ in height.
const std::filesystem::path& triangles() {
  static const ScratchFolder folder;
  static std::filesystem::path first;
  for (const int n : {1, 0})
    first = folder.write(fmt::format("flat.{}.csv", n), fmt::format("0 0\n0.6 0\n0 {}\n", 0.6 + 0.1 * n));
  return first;
}

// Two solids of a kind.
Scene two_of(int dim, const SolidKindRow& row) {
  Scene scene = test::box_scene(dim, 8);
  for (const double x : {0.25, 0.75}) {
    SolidSpec spec;
    spec.name = fmt::format("at {}", x);
    spec.kind = row.kind;
    spec.shape.kind = "box";
    spec.shape.lower = {x - 0.1, 0.4, dim == 3 ? 0.4 : 0.0};
    spec.shape.upper = {x + 0.1, 0.6, dim == 3 ? 0.6 : 0.0};
    spec.motion.translate[1] = "0.1*t";
    spec.rigid.density = 500;
    spec.rigid.velocity = {0, 0.5, 0};
    spec.elastic.youngs_modulus = 1e5;
    spec.elastic.poisson_ratio = 0.3;
    spec.elastic.element_size = 0.2;
    if (row.kind.follows_meshes) {
      spec.shape.kind = "mesh";
      spec.shape.file = dim == 2 ? triangles() : tetrahedra();
      spec.shape.transform.translate = {x - 0.2, 0.2, dim == 2 ? 0 : 0.2};
      spec.sequence = {2, 5, 0, true};
    }
    for (const Option& option : row.numbers) spec.numbers[option.key] = 1;
    scene.solids.push_back(spec);
  }
  return scene;
}

// Compares bits, since some values are NaN.
using Bits = std::vector<std::uint64_t>;

struct Recorder : StateVisitor {
  std::map<std::string, Bits> all;
  void number(const std::string& name, double& value) override {
    REQUIRE(all.emplace(name, Bits{std::bit_cast<std::uint64_t>(value)}).second);
  }
  void vector(const std::string& name, Eigen::VectorXd& v) override {
    Bits bits;
    for (const double x : v) bits.push_back(std::bit_cast<std::uint64_t>(x));
    REQUIRE(all.emplace(name, bits).second);
  }
};

template <int Dim>
std::map<std::string, Bits> recorded(Participants<Dim> solids) {
  Recorder recorder;
  for (std::size_t k = 0; k < solids.size(); ++k) solids[k].visit(recorder);
  return recorder.all;
}

template <int Dim>
void check_row(const SolidKindRow& row) {
  INFO(row.kind.name << " in " << Dim << "D");
  const bool keeps_state = row.kind.is_free() || row.kind.follows_meshes;
  const Setup<Dim> setup(two_of(Dim, row), Communicator());
  const State<Dim> start = initial_state(setup);
  for (std::size_t k = 0; k < start.solids.size(); ++k) {
    const Participant<Dim>& p = start.solids[k];
    CHECK(p.index() == int(k));
    CHECK((p.unknowns() > 0) == keeps_state);
    CHECK(p.velocity().size() == p.unknowns());
    CHECK(p.velocity_over(0, 0.1, 0.2).size() == p.unknowns());
    CHECK(p.unit_speeds().size() == p.unknowns());
    CHECK(p.generalised({}).size() == p.unknowns());
    CHECK(recorded(start.solids).empty() == !keeps_state);
  }
  // Advancing a copy changes all of its state and nothing of the original.
  const auto before = recorded(start.solids);
  State<Dim> moved = start;
  for (std::size_t k = 0; k < start.solids.size(); ++k) {
    const Eigen::VectorXd v = start.solids[k].velocity();
    moved.solids[k].advance({setup, start, 0.1, 0.1, v});
  }
  CHECK(recorded(start.solids) == before);
  CHECK((recorded(moved.solids) != before) == keeps_state);
}

}  // namespace

TEST_CASE("kinds of solids have names of their own") {
  std::set<std::string> names;
  for (const SolidKindRow& row : solid_kinds()) CHECK(names.insert(row.kind.name).second);
}

TEST_CASE("solids of every kind are values with as many velocities as unknowns") {
  for (const SolidKindRow& row : solid_kinds()) {
    check_row<2>(row);
    check_row<3>(row);
  }
}

}  // namespace participants_tests
