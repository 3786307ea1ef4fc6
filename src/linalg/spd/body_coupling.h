#pragma once
// A + c J G'G J', G'G a sparse approximation of H^-1: what preconditioners of A + c J H^-1 J' are made from where
// bodies have many degrees of freedom (deformable ones).
#include "linalg/core/block_columns.h"
#include "linalg/core/linear_system.h"
#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// Of the blocks that deform; the others are left out. Collective.
DistributedMatrix add_body_coupling(const LinearSystem& A, const BlockColumns& J, const SparseMatrix& H, double c);

// Whether stiffness or contact has come or gone at some entry of the diagonal of H: by a factor of 4.
bool has_changed_much(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& before);

}  // namespace seiche
