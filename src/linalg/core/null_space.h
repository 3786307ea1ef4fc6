#pragma once
// Projection onto vectors of zero mean: removes the null space of a singular system, one constant per component without
// a Dirichlet face.
#include <vector>

#include "linalg/core/distributed_matrix.h"
#include "linalg/core/vector_ops.h"

namespace seiche {

class MeanRemover {
 public:
  // Rows whose component is -1 are left unchanged; an empty `component` means -1 everywhere. Collective.
  MeanRemover(const NullSpace& null_space, const Communicator& ranks);

  // Subtracts the mean of v over each component. Collective.
  void apply(Vector& v) const;

 private:
  Communicator ranks_;
  std::vector<int> component_;
  std::vector<double> rows_;  // number of rows of each component, over all ranks
  mutable std::vector<double> mean_;
};

}  // namespace seiche
