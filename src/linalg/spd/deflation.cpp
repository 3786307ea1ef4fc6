#include "linalg/spd/deflation.h"

#include <algorithm>
#include <numeric>

#include "base/parallel_range.h"
#include "linalg/spd/column_products.h"

namespace seiche {
namespace {

// Width (cells) of the neighbourhood to which a body's columns of B J are cut if there are many bodies. A wider one
// saves iterations but needs more colours (docs/decisions/0006-many-bodies.md).
constexpr int cut_reach = 4;
// Bodies at least this far apart (cells) share applications of B: columns of neither are kept where the other's are.
constexpr int sharing_distance = 2 * cut_reach;
// Least number of columns for dense factors.
constexpr Eigen::Index least_dense = 100;

// Nonzeros of v in the given rows.
SparseVector cut(const Vector& v, const std::vector<int>& rows) {
  SparseVector c;
  c.row.reserve(rows.size()), c.value.reserve(rows.size());
  for (const int i : rows)
    if (v[std::size_t(i)] != 0) c.row.push_back(i), c.value.push_back(v[std::size_t(i)]);
  return c;
}

// Weight of each row: 1, linearly to zero over the outer cells of the range. A sharp cut leaves large A z at the edge
// and doubles the iterations.
std::vector<double> fading_weights(const std::vector<int>& rows, const std::vector<std::array<int, 3>>& cells,
                                   const CellRange& range) {
  std::vector<double> weights;
  for (const int row : rows) {
    double weight = 1;
    for (int a = 0; a < 3; ++a) {
      if (range.wraps(a)) continue;
      const int n = range.offset(a, cells[std::size_t(row)][std::size_t(a)]);
      const double inside = std::min(n + 1, range.width(a) - n);
      weight = std::min(weight, inside / (cut_reach + 1));
    }
    weights.push_back(weight);
  }
  return weights;
}

std::vector<int> all_rows(const LinearSystem& A) {
  std::vector<int> rows(std::size_t(A.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

// Rows without a cell, and those in the range, ascending.
std::vector<int> with_placeless(const std::vector<std::array<int, 3>>& cells, const CellRange& range,
                                const RowGrid& grid) {
  std::vector<int> rows = rows_in(range, grid);
  const std::size_t placed = rows.size();
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!has_place(cells[i])) rows.push_back(int(i));
  std::inplace_merge(rows.begin(), rows.begin() + std::ptrdiff_t(placed), rows.end());
  return rows;
}

}  // namespace

// Deformable bodies have a preconditioner of their own, so a deflation made for A alone never meets their H.
Deflation::Deflation(const CoupledSystem& S, Preconditioner& B) : S_(S), B_(B) {
  if (S.columns().any_deforms() && !S.is_coupled()) return;
  make_columns();
  add_component_columns();
  multiply_out();
  factor_own();
}

Deflation::Regions Deflation::find_regions() const {
  const BlockColumns& J = S_.columns();
  const LinearSystem& A = S_.liquid();
  if (J.blocks.size() <= few_bodies) {
    Regions regions;
    for (std::size_t b = 0; b < J.blocks.size(); ++b) {
      regions.bodies.push_back({all_rows(A), all_rows(A), {}});
      regions.color.push_back(int(b));
    }
    regions.separate = regions.color;
    return regions;
  }
  const auto cells = cells_of_rows(A);
  std::vector<CellRange> kept, touched;
  Regions regions;
  const std::vector<CellRange> bodies = ranges_of_blocks(J, cells, A.grid().periodic, S_.ranks());
  for (const CellRange& r : bodies) {
    kept.push_back(r.grown(cut_reach));
    touched.push_back(kept.back().grown(1));  // A reaches one more cell
    const std::vector<int> rows = rows_in(kept.back(), A.grid());
    regions.bodies.push_back(
        {rows, with_placeless(cells, touched.back(), A.grid()), fading_weights(rows, cells, kept.back())});
  }
  const std::vector<char> apart = reaching_placeless(A, cells, kept);
  regions.color = color(bodies, apart, sharing_distance);
  regions.separate = color(touched, apart);
  return regions;
}

int Deflation::mode_count(std::size_t block) const {
  const ColumnBlock& b = S_.columns().blocks[block];
  return b.deforms() ? int(modes_[block].cols()) : b.width;
}

// Per deformable body: an orthonormal basis of its responses to its loads. A free body moves rigidly under forces and
// moments; a pinned one bends in its softest modes.
void Deflation::find_modes() {
  const auto& blocks = S_.columns().blocks;
  const std::vector<int> first = S_.columns().first_columns();
  modes_.resize(blocks.size());
  Eigen::Index most = 0;
  for (const ColumnBlock& b : blocks) most = std::max(most, b.loads.cols());
  if (most == 0 || !S_.is_coupled()) return;
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(first.back(), most);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (const Eigen::Index count = blocks[b].loads.cols(); count > 0)
      loads.block(first[b], 0, blocks[b].width, count) = blocks[b].loads.colwise().normalized();
  const Eigen::MatrixXd responses = S_.weigh_columns(loads);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!blocks[b].deforms()) continue;
    Eigen::MatrixXd own = responses.block(first[b], 0, blocks[b].width, blocks[b].loads.cols());
    own.colwise().normalize();
    modes_[b] = orthonormal_basis(own);
  }
}

// Bodies of one colour share one application of B per column.
void Deflation::make_columns() {
  const Regions regions = find_regions();
  find_modes();
  const auto& color = regions.color;
  const int colors = color.empty() ? 0 : 1 + *std::max_element(color.begin(), color.end());
  int modes = 0;
  for (std::size_t b = 0; b < color.size(); ++b) modes = std::max(modes, mode_count(b));
  for (int c = 0; c < colors; ++c)
    for (int mode = 0; mode < modes; ++mode) {
      std::vector<std::size_t> members;
      for (std::size_t b = 0; b < color.size(); ++b)
        if (color[b] == c && mode < mode_count(b)) members.push_back(b);
      add_columns(regions, members, mode);
    }
}

// z = B (sum of the members' columns of J), cut to a column of Z for each member.
void Deflation::add_columns(const Regions& regions, const std::vector<std::size_t>& members, int mode) {
  const LinearSystem& A = S_.liquid();
  Vector r(A.rows(), 0.0), z(A.rows());
  bool any = false;
  for (const std::size_t b : members) {
    const ColumnBlock& block = S_.columns().blocks[b];
    const bool combined = block.deforms();
    block.for_each([&](int i, int k, double value) { r[i] += value * (combined ? modes_[b](k, mode) : k == mode); });
    for (const int i : block.row) any = any || r[i] != 0;
  }
  if (!S_.ranks().any(any)) return;
  A.project(r);
  B_.apply(r, z);
  A.project(z);
  ++applications_;
  for (std::vector<std::size_t> left = members; !left.empty();) {
    const auto same = [&, c = regions.separate[left.front()]](std::size_t b) { return regions.separate[b] == c; };
    const auto rest = std::stable_partition(left.begin(), left.end(), same);
    cut_columns(regions, {left.begin(), rest}, z);
    left.erase(left.begin(), rest);
  }
}

// A column of Z from z for each member, whose ranges are separate, and one of A Z.
void Deflation::cut_columns(const Regions& regions, const std::vector<std::size_t>& members, const Vector& z) {
  Vector own(z.size(), 0.0), az(z.size());
  for (const std::size_t b : members) {
    const Neighbourhood& n = regions.bodies[b];
    for (std::size_t k = 0; k < n.kept.size(); ++k) {
      const auto row = std::size_t(n.kept[k]);
      own[row] = n.fading.empty() ? z[row] : n.fading[k] * z[row];
    }
    Z_.push_back(cut(own, n.kept));
  }
  S_.liquid().multiply(own, az);
  for (const std::size_t b : members) AZ_.push_back(cut(az, regions.bodies[b].touched));
}

// Adds indicators of the closed components that bodies feel: null vectors of A but not of S.
void Deflation::add_component_columns() {
  body_columns_ = int(Z_.size());
  const auto& component = S_.liquid().null_space().component;
  for (const int c : S_.sensed_components()) {
    SparseVector chi;
    for (std::size_t i = 0; i < component.size(); ++i)
      if (component[i] == c) chi.row.push_back(int(i)), chi.value.push_back(1);
    Z_.push_back(std::move(chi));
    AZ_.emplace_back();
  }
}

void Deflation::multiply_out() {
  zaz_ = products(Z_, AZ_, S_.rows(), S_.ranks());
  jz_ = products(S_.columns(), Z_, S_.rows(), S_.ranks());
  regularize();
}

// A share of each column's own diagonal entry, since columns of translation, rotation and closed components differ in
// units. Columns without energy, as of closed components, take the mean diagonal entry of A instead.
void Deflation::regularize() {
  constexpr double rounding = 1e-14;
  const LinearSystem& A = S_.liquid();
  std::vector<double> sums{0, double(A.rows())};
  for (int i = 0; i < A.rows(); ++i) sums[0] += A.diagonal(i);
  S_.ranks().global_sum(sums);
  regularization_.assign(Z_.size(), sums[1] > 0 ? rounding * sums[0] / sums[1] : 0);
  for (const auto& t : zaz_)
    if (t.row() == t.col() && t.value() > 0) regularization_[std::size_t(t.row())] = rounding * t.value();
}

Eigen::Map<const Eigen::VectorXd> Deflation::regularization(Eigen::Index count) const {
  return Eigen::Map<const Eigen::VectorXd>(regularization_.data(), count);
}

Eigen::MatrixXd Deflation::estimate_schur() const {
  Eigen::MatrixXd zaz = Eigen::MatrixXd::Zero(body_columns_, body_columns_);
  Eigen::MatrixXd jz = Eigen::MatrixXd::Zero(S_.columns().columns(), body_columns_);
  for (const auto& t : zaz_)
    if (t.row() < body_columns_ && t.col() < body_columns_) zaz(t.row(), t.col()) += t.value();
  for (const auto& t : jz_)
    if (t.col() < body_columns_) jz(t.row(), t.col()) += t.value();
  zaz.diagonal() += regularization(body_columns_);
  const Eigen::MatrixXd schur = jz * ScaledLdlt(zaz).solve_columns(jz.transpose());
  return 0.5 * (schur + schur.transpose());
}

// E = Z'AZ + c (J'Z)' H^-1 (J'Z). Nothing is deflated without H.
bool Deflation::refresh() {
  if (Z_.empty() || !S_.is_coupled()) return true;
  if (S_.columns().any_deforms() || S_.columns().constraints.rows() > 0) return multiply_small();
  return own_ ? factor_added_mass() : factor_extended();
}

// For large H, and for constraints, which the other ways do not know.
bool Deflation::multiply_small() {
  const auto n = Eigen::Index(Z_.size());
  Eigen::MatrixXd JZ = Eigen::MatrixXd::Zero(S_.columns().columns(), n), E = Eigen::MatrixXd::Zero(n, n);
  for (const auto& t : jz_) JZ(t.row(), t.col()) += t.value();
  for (const auto& t : zaz_) E(t.row(), t.col()) += t.value();
  E.diagonal() += regularization(n);
  weighed_ = S_.weigh_columns(JZ);
  E += JZ.transpose() * weighed_;
  small_.emplace(0.5 * (E + E.transpose()));
  return small_->succeeded() && E.allFinite();
}

// For small H and many bodies. E is the Schur complement of the extended matrix, which is sparse and quasi-definite.
bool Deflation::factor_extended() {
  const int n = int(Z_.size()), m = S_.columns().columns();
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& t : zaz_) entries.emplace_back(t.row(), t.col(), t.value());
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, regularization_[std::size_t(i)]);
  for (const auto& t : jz_) {
    entries.emplace_back(n + t.row(), t.col(), t.value());
    entries.emplace_back(t.col(), n + t.row(), t.value());
  }
  const SparseMatrix& H = S_.bodies().matrix();
  for (int k = 0; k < H.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it)
      entries.emplace_back(n + int(it.row()), n + int(it.col()), -it.value() / S_.scale());
  SparseMatrix E(n + m, n + m);
  E.setFromTriplets(entries.begin(), entries.end());
  return extended_.factor(E);
}

// Computes the factors that do not depend on H if Z'AZ is nearly dense, as for many bodies in 3D: dense factors are
// then much faster than sparse ones. Not if closed components make Z'AZ singular.
void Deflation::factor_own() {
  const auto n = Eigen::Index(Z_.size()), m = Eigen::Index(S_.columns().columns());
  constexpr double dense = 0.1;
  if (n < least_dense || n > body_columns_ || double(zaz_.size()) < dense * double(n) * double(n)) return;
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(n, n);
  for (const auto& t : zaz_) F(t.row(), t.col()) += t.value();
  F.diagonal() += regularization(n);
  own_.emplace(F);
  if (!own_->succeeded()) return own_.reset();
  W_.setZero(n, m);
  for (const auto& t : jz_) W_(t.col(), t.row()) += t.value();
  own_->solve_lower_columns(W_);
  added_.setZero(m, m);
  added_.selfadjointView<Eigen::Lower>().rankUpdate(W_.transpose());
}

bool Deflation::factor_added_mass() {
  Eigen::MatrixXd T = added_;
  const SparseMatrix& H = S_.bodies().matrix();
  for (int k = 0; k < H.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(H, k); it; ++it) T(it.row(), it.col()) += it.value() / S_.scale();
  added_mass_.compute(T);
  return added_mass_.succeeded();
}

// With F = Z'AZ = LL', W = L^-1 (J'Z)':  E^-1 = L^-T (1 - W (H/c + W'W)^-1 W') L^-1.
Eigen::VectorXd Deflation::solve_small(const Eigen::VectorXd& f) const {
  if (small_) return small_->solve(f);
  if (own_) {
    Eigen::VectorXd y = own_->solve_lower(f);
    y -= W_ * added_mass_.solve(W_.transpose() * y);
    return own_->solve_upper(y);
  }
  Eigen::VectorXd all = Eigen::VectorXd::Zero(f.size() + S_.columns().columns());
  all.head(f.size()) = f;
  return extended_.solve(all).head(f.size());
}

Eigen::VectorXd Deflation::transposed(const std::vector<SparseVector>& columns, const Vector& x) const {
  Eigen::VectorXd y(Eigen::Index(columns.size()));
  parallel_range(0, int(columns.size()), [&](int c) { y[c] = local_dot(columns[std::size_t(c)], x); });
  return y;
}

void Deflation::subtract(const Eigen::VectorXd& q, Vector& z) const {
  subtract_combination(Z_, std::span<const double>(q.data(), Z_.size()), z);
}

// (S Z)'z = (A Z)'z + (J'Z)' c H^-1 J'z: the last term, of w = J'z. Large factors of H are not asked again.
Eigen::VectorXd Deflation::felt_by_columns(const Eigen::VectorXd& w) const {
  if (small_) return weighed_.transpose() * w;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(Eigen::Index(Z_.size()));
  const Eigen::VectorXd weighed = S_.weigh(w);
  for (const auto& t : jz_) f[t.col()] += t.value() * weighed[t.row()];
  return f;
}

void Deflation::apply(const Vector& r, Vector& z) {
  B_.apply(r, z);
  S_.liquid().project(z);
  if (Z_.empty() || !S_.is_coupled()) return;
  const Eigen::Index n = Eigen::Index(Z_.size()), m = S_.columns().columns();
  Eigen::VectorXd sums(n + m);  // (AZ)'z - Z'r, J'z
  sums << transposed(AZ_, z) - transposed(Z_, r), local_transposed(S_.columns(), z);
  S_.ranks().global_sum(std::span<double>(sums.data(), std::size_t(sums.size())));
  Eigen::VectorXd f = sums.head(n) + felt_by_columns(sums.tail(m));
  Eigen::VectorXd q = solve_small(f);
  make_identical(q, S_.ranks());
  subtract(q, z);
  S_.project(z);
}

void Deflation::prepare(const Vector& b, Vector& x) {
  if (Z_.empty() || !S_.is_coupled()) return;
  Vector r(x.size());
  S_.residual(b, x, r);
  Eigen::VectorXd f = transposed(Z_, r);
  S_.ranks().global_sum(std::span<double>(f.data(), std::size_t(f.size())));
  Eigen::VectorXd q = solve_small(-f);
  make_identical(q, S_.ranks());
  subtract(q, x);
}

}  // namespace seiche
