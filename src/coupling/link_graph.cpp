#include "coupling/link_graph.h"

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

void LinkGraph::complete(const std::vector<int>& nodes) {
  for (const int n : nodes) node_.try_emplace(n, 0);
  int next = 0;
  for (auto& [row, number] : row_) number = next++;
  next = 0;
  for (auto& [node, number] : node_) number = next++;
  join_pieces();
}

void LinkGraph::join_pieces() {
  std::vector<int> root(std::size_t(rows() + nodes()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[std::size_t(i)] != i) i = root[std::size_t(i)] = root[std::size_t(root[std::size_t(i)])];
    return i;
  };
  for (const Link& l : links_) root[std::size_t(find(row(l)))] = find(rows() + node(l));
  for (const auto& [n, number] : node_) {
    if (find(rows() + number) == find(0)) continue;
    root[std::size_t(find(rows() + number))] = find(0);
    links_.push_back({row_.begin()->first, n});
  }
}

// y_c eliminated: (D_n - B' D_c^-1 B) z = wanted - B' (row sum/D_c), a Laplacian of the nodes, one of them tied.
LeastFlux::LeastFlux(const LinkGraph& graph) : graph_(graph), of_row_(graph.rows(), graph.nodes()) {
  std::vector<Eigen::Triplet<double>> ones;
  for (const Link& l : graph.links()) ones.emplace_back(graph.row(l), graph.node(l), 1.0);
  of_row_.setFromTriplets(ones.begin(), ones.end());
  row_degree_ = of_row_ * Eigen::VectorXd::Ones(graph.nodes());
  const Eigen::VectorXd node_degree = of_row_.transpose() * Eigen::VectorXd::Ones(graph.rows());
  SparseMatrix L = -SparseMatrix(of_row_.transpose() * row_degree_.cwiseInverse().asDiagonal() * of_row_);
  for (int n = 0; n < graph.nodes(); ++n) L.coeffRef(n, n) += node_degree[n] + (n == 0 ? 1 : 0);
  factor_.compute(L);
}

std::vector<double> LeastFlux::solve(const Eigen::VectorXd& wanted) const {
  const Eigen::VectorXd row_sum = Eigen::VectorXd::Constant(graph_.rows(), wanted.sum() / graph_.rows());
  const Eigen::VectorXd right = wanted - of_row_.transpose() * row_sum.cwiseQuotient(row_degree_);
  const Eigen::VectorXd z = factor_.solve(right), y = (row_sum - of_row_ * z).cwiseQuotient(row_degree_);
  std::vector<double> d;
  for (const Link& l : graph_.links()) d.push_back(y[graph_.row(l)] + z[graph_.node(l)]);
  return d;
}

}  // namespace seiche
