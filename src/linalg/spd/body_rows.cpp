#include "linalg/spd/body_rows.h"

#include "linalg/core/body_matrix.h"

namespace seiche {
namespace {

class EliminatedRows : public Preconditioner {
 public:
  EliminatedRows(const LinearSystem& A, const BodyCoupling& C, std::unique_ptr<Preconditioner> B);
  bool good() const { return good_; }
  void apply(const Vector& r, Vector& z) override;

 private:
  struct Own {
    int row, near;
  };
  struct Link {  // entry of A between a row of this rank outside n and a row of n
    int row, near;
    double value;
  };
  void find_rows(const LinearSystem& A, const BodyCoupling& C);
  Eigen::VectorXd summed(Eigen::VectorXd v) const;

  Communicator ranks_;
  std::vector<Own> own_;     // rows of n on this rank
  std::vector<Link> links_;  // A_on
  BodyMatrix block_;         // (A + C)_nn
  bool good_ = false;
  std::unique_ptr<Preconditioner> B_;
  Vector rest_;
};

// Number in n of this rank's rows and of those that they are linked to, -1 outside n.
class NumbersNear {
 public:
  NumbersNear(const LinearSystem& A, const std::vector<Row>& n)
      : first_(A.pattern().first_row), local_(std::size_t(A.rows()), -1), n_(n) {
    for (std::size_t k = 0; k < n.size(); ++k)
      if (is_local(n[k])) local_[std::size_t(n[k] - first_)] = int(k);
  }
  int of(Row row) const { return is_local(row) ? local_[std::size_t(row - first_)] : index_of(n_, row); }

 private:
  bool is_local(Row row) const { return row >= first_ && row < first_ + Row(local_.size()); }

  Row first_;
  std::vector<int> local_;
  const std::vector<Row>& n_;
};

// (A + C)_nn on all ranks.
SparseMatrix block_of(const LinearSystem& A, const BodyCoupling& C) {
  const DistributedMatrix& P = A.pattern();
  const NumbersNear near(A, C.rows);
  std::vector<CouplingEntry> mine;
  for (int i = 0; i < A.rows(); ++i) {
    if (near.of(P.first_row + i) < 0) continue;
    for (int k = P.row_start[std::size_t(i)]; k < P.row_start[std::size_t(i) + 1]; ++k)
      if (const int j = near.of(P.column[std::size_t(k)]); j >= 0)
        mine.push_back({P.first_row + i, j, A.values()[std::size_t(k)]});
  }
  std::vector<Eigen::Triplet<double>> triplets;
  for (const CouplingEntry& e : of_all_ranks(mine, A.ranks()))
    triplets.emplace_back(index_of(C.rows, e.row), int(e.column), e.value);
  SparseMatrix block(C.matrix.rows(), C.matrix.cols());
  block.setFromTriplets(triplets.begin(), triplets.end());
  return block + C.matrix;
}

EliminatedRows::EliminatedRows(const LinearSystem& A, const BodyCoupling& C, std::unique_ptr<Preconditioner> B)
    : ranks_(A.ranks()), block_(A.ranks()), B_(std::move(B)), rest_(std::size_t(A.rows())) {
  find_rows(A, C);
  good_ = block_.set(block_of(A, C));
}

void EliminatedRows::find_rows(const LinearSystem& A, const BodyCoupling& C) {
  const DistributedMatrix& P = A.pattern();
  const NumbersNear near(A, C.rows);
  for (int i = 0; i < A.rows(); ++i) {
    if (const int n = near.of(P.first_row + i); n >= 0) {
      own_.push_back({i, n});
      continue;
    }
    for (int k = P.row_start[std::size_t(i)]; k < P.row_start[std::size_t(i) + 1]; ++k)
      if (const int n = near.of(P.column[std::size_t(k)]); n >= 0) links_.push_back({i, n, A.values()[std::size_t(k)]});
  }
}

// Sum over the ranks, the same bits on all.
Eigen::VectorXd EliminatedRows::summed(Eigen::VectorXd v) const {
  ranks_.global_sum(std::span<double>(v.data(), std::size_t(v.size())));
  make_identical(v, ranks_);
  return v;
}

void EliminatedRows::apply(const Vector& r, Vector& z) {
  Eigen::VectorXd own = Eigen::VectorXd::Zero(block_.size()), drawn = own;
  for (const Own& o : own_) own[o.near] = r[std::size_t(o.row)];
  const Eigen::VectorXd r_n = summed(std::move(own)), y = block_.solve(r_n);
  rest_ = r;
  for (const Own& o : own_) rest_[std::size_t(o.row)] = 0;
  for (const Link& l : links_) rest_[std::size_t(l.row)] -= l.value * y[l.near];
  B_->apply(rest_, z);
  for (const Link& l : links_) drawn[l.near] += l.value * z[std::size_t(l.row)];
  const Eigen::VectorXd z_n = block_.solve(r_n - summed(std::move(drawn)));
  for (const Own& o : own_) z[std::size_t(o.row)] = z_n[o.near];
}

}  // namespace

PreconditionerOrFailure eliminate_body_rows(const LinearSystem& A, const BodyCoupling& C,
                                            std::unique_ptr<Preconditioner> B) {
  if (C.rows.empty()) return {std::move(B), {}};
  auto made = std::make_unique<EliminatedRows>(A, C, std::move(B));
  if (!made->good()) return {nullptr, "the rows that bodies touch could not be factored"};
  return {std::move(made), {}};
}

}  // namespace seiche
