// Minimum-norm fluxes on links between pressure rows and surface nodes.
#include <catch2/catch.hpp>
#include <random>

#include <Eigen/Dense>

#include "coupling/solids/link_graph.h"

namespace link_graph_tests {
using namespace seiche;

namespace {

struct Sums {
  Eigen::VectorXd rows, nodes;
};

Sums sums_of(const LinkGraph& graph, const std::vector<double>& flux) {
  Sums s{Eigen::VectorXd::Zero(graph.rows()), Eigen::VectorXd::Zero(graph.nodes())};
  for (std::size_t n = 0; n < flux.size(); ++n) {
    s.rows[graph.row(graph.links()[n])] += flux[n];
    s.nodes[graph.node(graph.links()[n])] += flux[n];
  }
  return s;
}

// Rows 10 to 14 in a ring with nodes 0, 3, ... 12, each row linked to three nodes.
std::vector<Link> ring() {
  std::vector<Link> links;
  for (int r = 0; r < 5; ++r)
    for (int n = 0; n < 3; ++n) links.push_back({10 + r, 3 * ((r + n) % 5)});
  return links;
}

Eigen::VectorXd some_numbers(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-1, 1);
  Eigen::VectorXd r(count);
  for (double& x : r) x = some(random);
  return r;
}

// The flux y_c + z_n has no part in the cycles of the graph: the minimum of the norm.
void check_no_circulation(const LinkGraph& graph, const std::vector<double>& flux) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(Eigen::Index(flux.size()), graph.rows() + graph.nodes());
  for (Eigen::Index n = 0; n < B.rows(); ++n) {
    const Link& l = graph.links()[std::size_t(n)];
    B(n, graph.row(l)) = B(n, graph.rows() + graph.node(l)) = 1;
  }
  const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(flux.data(), B.rows());
  const Eigen::VectorXd nearest = B * B.completeOrthogonalDecomposition().solve(d);
  CHECK((d - nearest).norm() <= 1e-12 * d.norm());
}

constexpr double round_off = 1e-13;  // of solves with numbers of order one

}  // namespace

TEST_CASE("links of a set come back ascending, each once") {
  const std::set<Link> mine{{3, 1}, {1, 5}, {1, 2}};
  const std::vector<Link> all = gather_links(mine, Communicator());
  CHECK(all == std::vector<Link>{{1, 2}, {1, 5}, {3, 1}});
}

TEST_CASE("rows and nodes are numbered from 0 in ascending order") {
  LinkGraph graph(ring());
  graph.number();
  CHECK((graph.rows() == 5 && graph.nodes() == 5));
  for (int r = 0; r < 5; ++r) CHECK(graph.row_numbers().at(10 + r) == r);
  for (int n = 0; n < 5; ++n) CHECK(graph.node_numbers().at(3 * n) == n);
  const std::vector<int> piece = graph.pieces();
  CHECK(std::count(piece.begin(), piece.end(), piece[0]) == 10);
}

TEST_CASE("a completed graph is connected and has the nodes asked for") {
  LinkGraph graph({{0, 0}, {1, 1}, {1, 2}});
  graph.complete({7, 1});
  CHECK(graph.nodes() == 4);
  const std::vector<int> piece = graph.pieces();
  CHECK(std::count(piece.begin(), piece.end(), piece[0]) == graph.rows() + graph.nodes());
}

TEST_CASE("a minimum-norm flux brings each node what it wants, alike from all rows") {
  LinkGraph graph(ring());
  graph.complete({});
  const Eigen::VectorXd wanted = some_numbers(graph.nodes());
  const std::vector<double> flux = MinimumNormFlux(graph).solve(wanted);
  const Sums s = sums_of(graph, flux);
  CHECK((s.nodes - wanted).norm() <= round_off);
  CHECK((s.rows - Eigen::VectorXd::Constant(5, wanted.sum() / 5)).norm() <= round_off);
  check_no_circulation(graph, flux);
}

TEST_CASE("a balanced flux brings each row what it wants and leaves free nodes without any") {
  LinkGraph graph(ring());
  graph.number();
  const Eigen::VectorXd wanted = some_numbers(graph.rows());
  const std::vector<char> held{0, 1, 0, 0, 1};
  const Sums s = sums_of(graph, BalancedMinimumNormFlux(graph, held).solve(wanted));
  CHECK((s.rows - wanted).norm() <= round_off);
  for (int n = 0; n < 5; ++n)
    if (!held[std::size_t(n)]) CHECK(std::abs(s.nodes[n]) <= round_off);
}

TEST_CASE("a balanced flux without held nodes spreads what is left over all nodes alike") {
  LinkGraph graph(ring());
  graph.number();
  const Eigen::VectorXd wanted = some_numbers(graph.rows());
  const std::vector<char> held(5, 0);
  const std::vector<double> flux = BalancedMinimumNormFlux(graph, held).solve(wanted);
  const Sums s = sums_of(graph, flux);
  CHECK((s.rows - wanted).norm() <= round_off);
  CHECK((s.nodes - Eigen::VectorXd::Constant(5, wanted.sum() / 5)).norm() <= round_off);
  check_no_circulation(graph, flux);
}

}  // namespace link_graph_tests
