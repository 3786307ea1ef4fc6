#pragma once
// Viscous liquid on a staggered box with cells of width 1, density 1, and one rigid body. The system is the gradient of
//   1/2 sum of weight * form * form,   a form being a sum of coefficients times velocities of faces and of the body.
// Ranks own slabs across the last axis, with the lower face of each cell.
#include <map>

#include "linalg/saddle/solver.h"
#include "unit/linalg/cases.h"

namespace seiche::cases {

struct Stokes {
  Poisson box;                                                       // walls are no-slip
  std::function<double(Cell)> viscosity = [](Cell) { return 1.0; };  // per cell, dt mu/(rho h^2)
  std::function<bool(Cell)> body = [](Cell) { return false; };       // its cells are Kind::wall in the box
  std::array<double, 3> centre{0, 0, 0};                             // of the body, in cells
  double body_density = 1;                                           // relative
  double kappa = 1;                                                  // weight of (div u)^2 in the energy
  double schur_weight = 1;                                           // of schur_mass, relative to (1 + kappa) viscosity
};

struct StokesMatrices {
  System pressure;
  DistributedMatrix F, D, Dt;
  BlockColumns G, J;
  SparseMatrix H;
  Vector schur_mass, mass;
  std::vector<int> axis;
  std::vector<std::array<double, 3>> position;
  SaddleSystem system() const {
    return {F, G, D, Dt, J, pressure.A, pressure.grid, pressure.null_space, 1.0, schur_mass, mass, axis, position};
  }
};

class StokesBuilder {
 public:
  StokesBuilder(const Stokes& s, const Communicator& ranks) : s_(s), p_(s.box), ranks_(ranks), dim_(p_.dimension) {
    made_.pressure = build(p_, ranks);
    cells_ = number_rows(p_);
    number_faces();
    rows_.resize(std::size_t(last_ - first_));
    body_rows_.resize(rows_.size());
    H_.setZero(unknowns(), unknowns());
  }

  StokesMatrices make() {
    add_mass();
    for_cells({0, 0, 0}, p_.size, [&](Cell c) {
      add_cell(c);
      for (int a = 0; a < dim_; ++a)
        for (int b = 0; b < a; ++b) add_edge(c, b, a);
    });
    add_inertia();
    finish_faces();
    finish_divergence();
    return std::move(made_);
  }

 private:
  // A velocity: an unknown face, the body at a face, or zero.
  struct Sample {
    std::int64_t face = -1;
    bool of_body = false, exists = true;
    Eigen::VectorXd twist;
  };
  struct Form {
    std::vector<std::pair<std::int64_t, double>> faces;
    Eigen::VectorXd body;
  };

  int unknowns() const { return has_body() ? dim_ * (dim_ + 1) / 2 : 0; }
  bool has_body() const { return s_.body_density >= 0; }
  // Wraps c along periodic axes. Returns the kind of the cell, or that of the outside.
  Kind kind(Cell& c) const {
    for (int a = 0; a < dim_; ++a) {
      if (p_.periodic[a]) c[a] = (c[a] + p_.size[a]) % p_.size[a];
      if (c[a] < 0 || c[a] >= p_.size[a]) return p_.outside;
    }
    return p_.kind(c);
  }
  bool in_body(Cell c) const {
    kind(c);
    for (int a = 0; a < dim_; ++a)
      if (c[a] < 0 || c[a] >= p_.size[a]) return false;
    return s_.body(c);
  }
  bool is_liquid(Cell c) const { return kind(c) == Kind::liquid; }
  static Cell moved(Cell c, int axis, int step) {
    c[axis] += step;
    return c;
  }
  // Lower face of c: unknown beside liquid, and in air if an edge at it touches liquid.
  bool is_unknown(Cell c, int axis) const {
    Cell low = moved(c, axis, -1), high = c;
    const Kind a = kind(low), b = kind(high);
    if (a == Kind::wall || b == Kind::wall) return false;
    if (a == Kind::liquid || b == Kind::liquid) return true;
    for (int t = 0; t < dim_; ++t)
      for (const int step : {-1, 1})
        if (t != axis && (is_liquid(moved(c, t, step)) || is_liquid(moved(moved(c, axis, -1), t, step)))) return true;
    return false;
  }
  void number_faces() {
    std::int64_t next = 0;
    const int last = dim_ - 1;
    const auto& grid = made_.pressure.grid;
    faces_.assign(std::size_t(p_.size[0]) * p_.size[1] * p_.size[2] * dim_, -1);
    bool begun = false;
    for_cells({0, 0, 0}, p_.size, [&](Cell c) {
      const bool mine = c[last] >= grid.lower[last] && c[last] < grid.upper[last];
      if (mine && !begun) first_ = next, begun = true;
      for (int a = 0; a < dim_; ++a)
        if (is_unknown(c, a)) faces_[std::size_t(index_of(p_, c) * dim_ + a)] = next++;
      if (mine) last_ = next;
    });
    global_ = next;
    first_ = ranks_.exclusive_prefix_sum(last_ - first_);
  }
  // True if the cell lies in the box.
  bool inside(const Cell& c) const {
    for (int a = 0; a < dim_; ++a)
      if (c[a] < 0 || c[a] >= p_.size[a]) return false;
    return true;
  }
  Sample sample(Cell c, int axis) const {
    Cell low = moved(c, axis, -1), wrapped = c;
    kind(wrapped);
    if (inside(wrapped)) {
      const std::int64_t face = faces_[std::size_t(index_of(p_, wrapped) * dim_ + axis)];
      if (face >= 0) return {face, false, true, {}};
    }
    if (in_body(c) || in_body(low)) return {-1, true, true, twist_at(c, axis)};
    const bool wall = kind(low) == Kind::wall || kind(wrapped) == Kind::wall;
    return {-1, false, wall, {}};
  }
  // Velocity along `axis` of the body at the lower face of c, as a form in its unknowns v, omega. The body does not
  // cross the sides of the box.
  Eigen::VectorXd twist_at(const Cell& c, int axis) const {
    Eigen::VectorXd t = Eigen::VectorXd::Zero(unknowns());
    std::array<double, 3> r{};
    for (int a = 0; a < dim_; ++a) r[a] = c[a] + (a == axis ? 0.0 : 0.5) - s_.centre[a];
    t[axis] = 1;
    if (dim_ == 2) {
      t[2] = axis == 0 ? -r[1] : r[0];
    } else {
      const int b = (axis + 1) % 3, d = (axis + 2) % 3;
      t[3 + b] = r[d];
      t[3 + d] = -r[b];
    }
    return t;
  }
  Form difference(const Sample& high, const Sample& low) const {
    Form form{{}, Eigen::VectorXd::Zero(unknowns())};
    for (const auto& [s, sign] : {std::pair{&high, 1.0}, std::pair{&low, -1.0}}) {
      if (s->face >= 0) form.faces.push_back({s->face, sign});
      if (s->of_body) form.body += sign * s->twist;
    }
    return form;
  }
  // Adds weight f g, once for each order of the two.
  void add(double weight, const Form& f, const Form& g) {
    for (const auto& [i, a] : f.faces) {
      if (i < first_ || i >= last_) continue;
      for (const auto& [j, b] : g.faces) rows_[std::size_t(i - first_)][j] += weight * a * b;
      Eigen::VectorXd& row = body_rows_[std::size_t(i - first_)];
      if (row.size() == 0) row = Eigen::VectorXd::Zero(unknowns());
      row += weight * a * g.body;
    }
    H_ += weight * f.body * g.body.transpose();
  }
  void add_pair(double weight, const Form& f, const Form& g) { add(weight, f, g), add(weight, g, f); }

  // Energy mu (sum g_a^2 - 2 sum g_a g_b + kappa (sum g_a)^2).
  void add_cell(const Cell& c) {
    if (!is_liquid(c)) return;
    const double mu = s_.viscosity(c);
    std::vector<Form> g;
    for (int a = 0; a < dim_; ++a) g.push_back(difference(sample(moved(c, a, 1), a), sample(c, a)));
    for (int a = 0; a < dim_; ++a) {
      add((1 + s_.kappa) * mu, g[a], g[a]);
      for (int b = 0; b < a; ++b) add_pair((s_.kappa - 1) * mu, g[a], g[b]);
    }
  }
  // Energy mu V (gx^2 + gy^2 + 2 gx gy) at the lower edge of c; links to solids have half a cell's length.
  void add_edge(const Cell& c, int a, int b) {
    for (Cell at : edge_cells(c, a, b)) add_edge_at(at, a, b);
  }
  // Edges on the upper sides of the box have no cell above.
  std::vector<Cell> edge_cells(const Cell& c, int a, int b) const {
    std::vector<Cell> cells{c};
    const bool at_a = !p_.periodic[a] && c[a] + 1 == p_.size[a], at_b = !p_.periodic[b] && c[b] + 1 == p_.size[b];
    if (at_a) cells.push_back(moved(c, a, 1));
    if (at_b) cells.push_back(moved(c, b, 1));
    if (at_a && at_b) cells.push_back(moved(moved(c, a, 1), b, 1));
    return cells;
  }
  void add_edge_at(const Cell& c, int a, int b) {
    double share = 0, mu = 0;
    int liquid = 0;
    for (int i = 0; i < 4; ++i) {
      Cell n = moved(moved(c, a, -(i & 1)), b, -(i >> 1));
      const Kind k = kind(n);
      share += k == Kind::air ? 0 : 0.25;
      if (k == Kind::liquid) mu += 1 / s_.viscosity(n), ++liquid;
    }
    if (liquid == 0) return;
    mu = liquid / mu;
    const Sample a1 = sample(c, a), a0 = sample(moved(c, b, -1), a), b1 = sample(c, b), b0 = sample(moved(c, a, -1), b);
    const auto theta = [](const Sample& x, const Sample& y) { return (x.face >= 0) == (y.face >= 0) ? 1.0 : 0.5; };
    const bool has_a = a1.exists && a0.exists, has_b = b1.exists && b0.exists;
    const Form ga = difference(a1, a0), gb = difference(b1, b0);
    if (has_a) add(share * mu / theta(a1, a0), ga, ga);
    if (has_b) add(share * mu / theta(b1, b0), gb, gb);
    if (has_a && has_b) add_pair(share * mu, ga, gb);
  }
  void add_mass() {
    for_cells({0, 0, 0}, p_.size, [&](Cell c) {
      for (int a = 0; a < dim_; ++a) {
        const std::int64_t face = faces_[std::size_t(index_of(p_, c) * dim_ + a)];
        if (face < first_ || face >= last_) continue;
        made_.axis.push_back(a);
        made_.position.push_back({c[0] + 0.5, c[1] + 0.5, c[2] + 0.5});
        made_.position.back()[std::size_t(a)] -= 0.5;
        made_.mass.push_back(is_liquid(c) || is_liquid(moved(c, a, -1)) ? 1 : 1e-3);
        rows_[std::size_t(face - first_)][face] += made_.mass.back();
      }
    });
  }
  void add_inertia() {
    for_cells({0, 0, 0}, p_.size, [&](Cell c) {
      if (!has_body() || !s_.body(c)) return;
      for (int a = 0; a < dim_; ++a)
        for (const int step : {0, 1}) {
          const Eigen::VectorXd t = twist_at(moved(c, a, step), a);
          H_ += 0.5 * s_.body_density * t * t.transpose();
        }
    });
    made_.H = H_.sparseView();
  }
  void finish_faces() {
    DistributedMatrix& F = made_.F;
    F.first_row = first_;
    F.global_rows = global_;
    ColumnBlock block;
    block.width = unknowns();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row own = first_ + Row(i);
      F.column.push_back(own), F.value.push_back(rows_[i][own]);
      for (const auto& [j, value] : rows_[i])
        if (j != own && value != 0) F.column.push_back(j), F.value.push_back(value);
      F.row_start.push_back(int(F.column.size()));
      for (int k = 0; k < body_rows_[i].size(); ++k)
        if (body_rows_[i][k] != 0) block.add(int(i), k, body_rows_[i][k]);
    }
    if (has_body()) made_.G.blocks.push_back(block);
  }
  // Net outflow of each cell, and its transpose.
  void finish_divergence() {
    std::vector<std::map<Row, double>> columns(std::size_t(last_ - first_));
    DistributedMatrix &D = made_.D, &Dt = made_.Dt;
    const DistributedMatrix& A = made_.pressure.A;
    D.first_row = A.first_row, D.global_rows = A.global_rows;
    Dt.first_row = first_, Dt.global_rows = global_;
    ColumnBlock block;
    block.width = unknowns();
    for_cells({0, 0, 0}, p_.size, [&](Cell c) {
      const Row row = cells_[std::size_t(index_of(p_, c))];
      if (row < 0) return;
      const bool mine = row >= A.first_row && row < A.first_row + A.rows();
      Eigen::VectorXd J = Eigen::VectorXd::Zero(unknowns());
      for (int a = 0; a < dim_; ++a)
        for (const int step : {0, 1}) {
          const double sign = step ? 1 : -1;
          const Sample s = sample(moved(c, a, step), a);
          if (s.of_body) J += sign * s.twist;
          if (s.face < 0) continue;
          if (mine) D.column.push_back(s.face), D.value.push_back(sign);
          if (s.face >= first_ && s.face < last_) columns[std::size_t(s.face - first_)][row] += sign;
        }
      if (!mine) return;
      D.row_start.push_back(int(D.column.size()));
      for (int k = 0; k < J.size(); ++k)
        if (J[k] != 0) block.add(int(row - A.first_row), k, J[k]);
      made_.schur_mass.push_back(s_.schur_weight * (1 + s_.kappa) * s_.viscosity(c));
    });
    for (const auto& column : columns) {
      for (const auto& [row, value] : column) Dt.column.push_back(row), Dt.value.push_back(value);
      Dt.row_start.push_back(int(Dt.column.size()));
    }
    if (has_body()) made_.J.blocks.push_back(block);
  }

  const Stokes& s_;
  const Poisson& p_;
  const Communicator& ranks_;
  int dim_;
  StokesMatrices made_;
  std::vector<std::int64_t> cells_, faces_;
  std::int64_t first_ = 0, last_ = 0, global_ = 0;
  std::vector<std::map<Row, double>> rows_;
  std::vector<Eigen::VectorXd> body_rows_;
  Eigen::MatrixXd H_;
};

}  // namespace seiche::cases
