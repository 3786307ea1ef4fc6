#pragma once
// Preconditioners of S = A + c J H^-1 J' before deflation.
#include <memory>
#include <string>

#include "linalg/precond/preconditioners.h"
#include "linalg/spd/coupled_system.h"

namespace seiche {

struct Hierarchy {
  std::unique_ptr<DistributedMatrix> matrix;  // the matrix it was made from, if not A
  std::unique_ptr<LinearSystem> system;
  Eigen::VectorXd diagonal;  // of H when it was made; empty without deformable bodies
  PreconditionerOrFailure made;
};

enum class Coefficients { smooth, jumping };  // jumping: by orders of magnitude, as between liquid and gas

// By one of preconditioner_names(), not "auto". Covers A and the deformable blocks of J. Collective.
Hierarchy make_hierarchy(const std::string& name, const CoupledSystem& S, Coefficients coefficients);

}  // namespace seiche
