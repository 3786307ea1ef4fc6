#include "coupling/solids/link_graph.h"

#include <cstring>
#include <numeric>

namespace seiche {

std::vector<Link> gather_links(const std::set<Link>& mine, const Communicator& ranks) {
  const std::vector<Link> list(mine.begin(), mine.end());
  std::set<Link> all;
  for (const std::string& bytes :
       ranks.all_gather(std::string(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(Link))))
    for (std::size_t n = 0; n < bytes.size(); n += sizeof(Link)) {
      Link link;
      std::memcpy(&link, bytes.data() + n, sizeof link);
      all.insert(link);
    }
  return {all.begin(), all.end()};
}

LinkGraph::LinkGraph(std::vector<Link> links) : links_(std::move(links)) {
  for (const Link& l : links_) row_.try_emplace(l.row, 0), node_.try_emplace(int(l.node), 0);
}

void LinkGraph::number() {
  int next = 0;
  for (auto& [row, number] : row_) number = next++;
  next = 0;
  for (auto& [node, number] : node_) number = next++;
}

void LinkGraph::complete(const std::vector<int>& nodes) {
  for (const int n : nodes) node_.try_emplace(n, 0);
  number();
  join_pieces();
}

std::vector<int> LinkGraph::pieces() const {
  std::vector<int> root(std::size_t(rows() + nodes()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[std::size_t(i)] != i) i = root[std::size_t(i)] = root[std::size_t(root[std::size_t(i)])];
    return i;
  };
  for (const Link& l : links_) root[std::size_t(find(row(l)))] = find(rows() + node(l));
  for (int i = 0; i < int(root.size()); ++i) root[std::size_t(i)] = find(i);
  return root;
}

void LinkGraph::join_pieces() {
  const std::vector<int> piece = pieces();
  std::set<int> joined{piece[0]};
  for (const auto& [n, number] : node_)
    if (joined.insert(piece[std::size_t(rows() + number)]).second) links_.push_back({row_.begin()->first, n});
}

// With y eliminated: (D_n - B' D_c^-1 B) z = wanted - B' D_c^-1 s. B is the incidence matrix of rows and nodes, D_c and
// D_n are their degrees, s is the row sums. The matrix is a graph Laplacian; 1 is added to entry (0, 0) to make it
// regular.
MinimumNormFlux::MinimumNormFlux(const LinkGraph& graph) : graph_(graph), of_row_(graph.rows(), graph.nodes()) {
  std::vector<Eigen::Triplet<double>> ones;
  for (const Link& l : graph.links()) ones.emplace_back(graph.row(l), graph.node(l), 1.0);
  of_row_.setFromTriplets(ones.begin(), ones.end());
  row_degree_ = of_row_ * Eigen::VectorXd::Ones(graph.nodes());
  const Eigen::VectorXd node_degree = of_row_.transpose() * Eigen::VectorXd::Ones(graph.rows());
  SparseMatrix L = -SparseMatrix(of_row_.transpose() * row_degree_.cwiseInverse().asDiagonal() * of_row_);
  for (int n = 0; n < graph.nodes(); ++n) L.coeffRef(n, n) += node_degree[n] + (n == 0 ? 1 : 0);
  (void)factor_.factor(L);  // positive definite: a node of each piece is held or tied
}

std::vector<double> MinimumNormFlux::solve(const Eigen::VectorXd& wanted) const {
  const Eigen::VectorXd row_sum = Eigen::VectorXd::Constant(graph_.rows(), wanted.sum() / graph_.rows());
  const Eigen::VectorXd right = wanted - of_row_.transpose() * row_sum.cwiseQuotient(row_degree_);
  const Eigen::VectorXd z = factor_.solve(right), y = (row_sum - of_row_ * z).cwiseQuotient(row_degree_);
  std::vector<double> d;
  for (const Link& l : graph_.links()) d.push_back(y[graph_.row(l)] + z[graph_.node(l)]);
  return d;
}

// With y eliminated as above. Columns of held nodes are left out of B. In each piece without held nodes, 1 is added to
// one diagonal entry.
BalancedMinimumNormFlux::BalancedMinimumNormFlux(const LinkGraph& graph, const std::vector<char>& held)
    : graph_(graph),
      held_(held),
      piece_(graph.pieces()),
      nodes_of_piece_(piece_.size()),
      of_row_(graph.rows(), graph.nodes()),
      row_degree_(Eigen::VectorXd::Zero(graph.rows())) {
  std::vector<Eigen::Triplet<double>> ones;
  for (const Link& l : graph.links()) {
    row_degree_[graph.row(l)] += 1;
    if (!is_held(graph.node(l))) ones.emplace_back(graph.row(l), graph.node(l), 1.0);
  }
  of_row_.setFromTriplets(ones.begin(), ones.end());
  std::vector<char> has_held(piece_.size());
  for (int n = 0; n < graph.nodes(); ++n) has_held[std::size_t(piece_[std::size_t(graph.rows() + n)])] |= is_held(n);
  const Eigen::VectorXd node_degree = of_row_.transpose() * Eigen::VectorXd::Ones(graph.rows());
  SparseMatrix L = -SparseMatrix(of_row_.transpose() * row_degree_.cwiseInverse().asDiagonal() * of_row_);
  for (int n = 0; n < graph.nodes(); ++n) {
    const auto piece = std::size_t(piece_[std::size_t(graph.rows() + n)]);
    const bool tied = !has_held[piece] && nodes_of_piece_[piece] == 0;
    if (!has_held[piece]) nodes_of_piece_[piece] += 1;
    L.coeffRef(n, n) += is_held(n) ? 1 : node_degree[n] + (tied ? 1 : 0);
  }
  (void)factor_.factor(L);  // positive definite: a node of each piece is held or tied
}

// Node sums: the sum of `wanted` over the piece in equal parts; 0 in pieces with held nodes.
Eigen::VectorXd BalancedMinimumNormFlux::rests(const Eigen::VectorXd& wanted) const {
  std::vector<double> sum(piece_.size());
  for (int c = 0; c < graph_.rows(); ++c) sum[std::size_t(piece_[std::size_t(c)])] += wanted[c];
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(graph_.nodes());
  for (int n = 0; n < graph_.nodes(); ++n) {
    const auto piece = std::size_t(piece_[std::size_t(graph_.rows() + n)]);
    if (nodes_of_piece_[piece] > 0) rest[n] = sum[piece] / nodes_of_piece_[piece];
  }
  return rest;
}

std::vector<double> BalancedMinimumNormFlux::solve(const Eigen::VectorXd& wanted) const {
  const Eigen::VectorXd right = rests(wanted) - of_row_.transpose() * wanted.cwiseQuotient(row_degree_);
  const Eigen::VectorXd z = factor_.solve(right), y = (wanted - of_row_ * z).cwiseQuotient(row_degree_);
  std::vector<double> d;
  for (const Link& l : graph_.links()) d.push_back(y[graph_.row(l)] + z[graph_.node(l)]);
  return d;
}

}  // namespace seiche
