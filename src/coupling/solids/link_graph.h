#pragma once
// Bipartite graph of pressure rows and surface nodes, and minimum-norm corrections of the flux on its links.
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "base/communicator.h"
#include "linalg/core/sparse_ldlt.h"

namespace seiche {

struct Link {
  std::int64_t row, node;
  auto operator<=>(const Link&) const = default;
};

// Links of all ranks, ascending, each once. Collective.
std::vector<Link> gather_links(const std::set<Link>& mine, const Communicator& ranks);

// Bipartite graph of rows and nodes. Numbers are valid after number() or complete().
class LinkGraph {
 public:
  explicit LinkGraph(std::vector<Link> links);

  // Numbers rows and nodes from 0, ascending.
  void number();
  // Adds nodes, numbers everything, and links disconnected pieces to the first row, so that the graph is connected.
  void complete(const std::vector<int>& nodes);

  const std::vector<Link>& links() const { return links_; }
  int rows() const { return int(row_.size()); }
  int nodes() const { return int(node_.size()); }
  int row(const Link& l) const { return row_.at(l.row); }
  int node(const Link& l) const { return node_.at(int(l.node)); }
  const std::map<int, int>& node_numbers() const { return node_; }
  const std::map<std::int64_t, int>& row_numbers() const { return row_; }
  // Labels of the connected pieces, first for each row, then for each node: the index of one member of the piece.
  std::vector<int> pieces() const;

 private:
  void join_pieces();

  std::vector<Link> links_;
  std::map<std::int64_t, int> row_;
  std::map<int, int> node_;
};

// Minimum-norm flux d_cn on the links with sum_c d_cn = wanted_n for each node and sum_n d_cn equal for all rows. The
// common row sum is sum_n wanted_n over the number of rows. The minimiser has the form d_cn = y_c + z_n.
class MinimumNormFlux {
 public:
  explicit MinimumNormFlux(const LinkGraph& graph);  // keeps a reference; the graph must be complete()
  std::vector<double> solve(const Eigen::VectorXd& wanted) const;

 private:
  const LinkGraph& graph_;
  SparseMatrix of_row_;
  Eigen::VectorXd row_degree_;
  SparseLdlt factor_;
};

// Minimum-norm flux d_cn on the links with sum_n d_cn = wanted_c for each row and sum_c d_cn = 0 for each node that is
// not held. It has the form d_cn = y_c + z_n with z_n = 0 at held nodes. A connected piece without held nodes has such
// a flux only if sum_c wanted_c = 0. Otherwise its node sums are sum_c wanted_c over the number of its nodes.
class BalancedMinimumNormFlux {
 public:
  BalancedMinimumNormFlux(const LinkGraph& graph,
                          const std::vector<char>& held);  // keeps references; the graph must be numbered
  std::vector<double> solve(const Eigen::VectorXd& wanted) const;

 private:
  bool is_held(int node) const { return held_[std::size_t(node)] != 0; }
  Eigen::VectorXd rests(const Eigen::VectorXd& wanted) const;

  const LinkGraph& graph_;
  const std::vector<char>& held_;
  std::vector<int> piece_;
  std::vector<double> nodes_of_piece_;  // number of nodes of each piece; 0: a node of it is held
  SparseMatrix of_row_;                 // incidence matrix, rows x nodes, without held nodes
  Eigen::VectorXd row_degree_;
  SparseLdlt factor_;
};

}  // namespace seiche
