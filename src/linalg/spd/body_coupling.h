#pragma once
// A + c J G'G J' with a sparse G'G ~ H^-1: the matrix from which preconditioners of A + c J H^-1 J' are made if bodies
// have many degrees of freedom (deformable ones).
#include "linalg/core/block_columns.h"
#include "linalg/core/body_matrix.h"
#include "linalg/core/linear_system.h"
#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// c J G'G J' of the deformable blocks of J, on the rows that they touch, over all ranks.
struct BodyCoupling {
  std::vector<Row> rows;  // ascending
  SparseMatrix matrix;
};

// Place of a row in an ascending list, -1 if it is not there.
int index_of(const std::vector<Row>& rows, Row row);

// An entry of a matrix with global rows.
struct CouplingEntry {
  Row row;
  std::int64_t column;
  double value;
};

// The entries of all ranks, in the order of the ranks. Collective.
std::vector<CouplingEntry> of_all_ranks(const std::vector<CouplingEntry>& mine, const Communicator& ranks);

// Identity rows of A are left out. Collective.
BodyCoupling body_coupling(const LinearSystem& A, const BlockColumns& J, const BodyMatrix& H, double c);

// A + C. Collective.
DistributedMatrix add_body_coupling(const LinearSystem& A, const BodyCoupling& C);

// A + diag(sums over the rows of |C|): keeps the stencil of A, and equals A + C on constants if C has one sign.
DistributedMatrix add_lumped_coupling(const LinearSystem& A, const BodyCoupling& C);

// Largest ratio of the diagonals of c J H^-1 J' and A over all rows, with H by its `diagonal` and the deformable blocks
// of J. Collective.
double coupling_strength(const LinearSystem& A, const BlockColumns& J, const Eigen::VectorXd& diagonal, double c);

// True if some diagonal entry of H has changed by more than a factor of 4: stiffness or contact has come or gone.
bool has_changed_much(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& before);

}  // namespace seiche
