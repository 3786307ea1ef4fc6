#pragma once
// A + c J G'G J' with a sparse G'G ~ H^-1: the matrix from which preconditioners of A + c J H^-1 J' are made if bodies
// have many degrees of freedom (deformable ones).
#include "linalg/core/block_columns.h"
#include "linalg/core/linear_system.h"
#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// Adds the coupling of the deformable blocks of J; others are left out. Collective.
DistributedMatrix add_body_coupling(const LinearSystem& A, const BlockColumns& J, const SparseMatrix& H, double c);

// True if some diagonal entry of H has changed by more than a factor of 4: stiffness or contact has come or gone.
bool has_changed_much(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& before);

}  // namespace seiche
