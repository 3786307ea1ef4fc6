#pragma once
// Warnings of sources with a rate that bring nothing.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
class DrySources {
 public:
  // Appends lines on the sources that brought nothing in the step that led to a state, for want of liquid in their
  // shapes: one a source and spell. psi: distance to the solids at nodes, m. Collective.
  void warn(const Setup<Dim>& setup, const State<Dim>& state, const NodeField<Dim>& psi,
            std::vector<std::string>& warnings);

 private:
  std::vector<char> told_;
};

}  // namespace seiche
