#pragma once
// Which rows of the pressure the nodes of a surface push liquid in and out of, and the least change of their fluxes
// that gives these wanted sums.
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include <Eigen/SparseCholesky>

#include "base/communicator.h"
#include "linalg/core/sparse_cholesky.h"

namespace seiche {

struct Link {
  std::int64_t row, node;
  auto operator<=>(const Link&) const = default;
};

// Those of all ranks, ascending. Collective.
std::vector<Link> gather_links(const std::set<Link>& mine, const Communicator& ranks);

// Rows and nodes, numbered, joined by links.
class LinkGraph {
 public:
  explicit LinkGraph(std::vector<Link> links);

  // Numbers rows and nodes, ascending.
  void number();
  // Adds nodes, and links that make one piece of the graph where it is in several.
  void complete(const std::vector<int>& nodes);

  const std::vector<Link>& links() const { return links_; }
  int rows() const { return int(row_.size()); }
  int nodes() const { return int(node_.size()); }
  int row(const Link& l) const { return row_.at(l.row); }
  int node(const Link& l) const { return node_.at(int(l.node)); }
  const std::map<int, int>& node_numbers() const { return node_; }
  const std::map<std::int64_t, int>& row_numbers() const { return row_; }
  // Of each row and then each node: a member of its connected piece, the same for all of the piece.
  std::vector<int> pieces() const;

 private:
  void join_pieces();

  std::vector<Link> links_;
  std::map<std::int64_t, int> row_;
  std::map<int, int> node_;
};

// d_cn, one a link, least in the sum of squares, with sum_c d_cn = wanted_n, and sum_n d_cn the same for all c (zero
// where sum_n wanted_n = 0): d_cn = y_c + z_n.
class MinimumNormFlux {
 public:
  explicit MinimumNormFlux(const LinkGraph& graph);  // keeps a reference; the graph is complete
  std::vector<double> solve(const Eigen::VectorXd& wanted) const;

 private:
  const LinkGraph& graph_;
  SparseMatrix of_row_;
  Eigen::VectorXd row_degree_;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

// d_cn, one a link, least in the sum of squares, with sum_n d_cn = wanted_c for all rows and sum_c d_cn = 0 for all
// nodes that are not held: d_cn = y_c + z_n, z_n = 0 for held nodes. In a connected piece without held nodes that is
// possible only if sum_c wanted_c = 0; what is left of that sum goes to its nodes in equal parts.
class BalancedMinimumNormFlux {
 public:
  BalancedMinimumNormFlux(const LinkGraph& graph, const std::vector<char>& held);  // keeps both; the graph is numbered
  std::vector<double> solve(const Eigen::VectorXd& wanted) const;

 private:
  bool is_held(int node) const { return held_[std::size_t(node)] != 0; }
  Eigen::VectorXd rests(const Eigen::VectorXd& wanted) const;

  const LinkGraph& graph_;
  const std::vector<char>& held_;
  std::vector<int> piece_;
  std::vector<double> nodes_of_piece_;  // 0 where a node is held
  SparseMatrix of_row_;                 // ones, of nodes that are not held
  Eigen::VectorXd row_degree_;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

}  // namespace seiche
