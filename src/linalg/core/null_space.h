#pragma once
// Removes the constants that a singular system does not see: one per component without a Dirichlet face.
#include <vector>

#include "linalg/core/distributed_matrix.h"
#include "linalg/core/vector_ops.h"

namespace seiche {

class MeanRemover {
 public:
  // Collective. Rows whose component is -1 are left alone. An empty `component` stands for -1 everywhere.
  MeanRemover(const NullSpace& null_space, const Communicator& ranks);

  // Subtracts from v its mean over each component. Collective.
  void apply(Vector& v) const;

 private:
  Communicator ranks_;
  std::vector<int> component_;
  std::vector<double> rows_;  // of each component, over all ranks
  mutable std::vector<double> mean_;
};

}  // namespace seiche
