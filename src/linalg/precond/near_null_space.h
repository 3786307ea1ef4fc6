#pragma once
// Near-null-space vectors of F: motions of high-viscosity regions that cost almost no energy. Regions translate and
// rotate as a whole; slender ones bend.
#include <array>

#include "linalg/core/sparse_vector.h"
#include "linalg/precond/viscous_regions.h"

namespace seiche {

// Axis and position (in cells) of the velocity component of each row of F.
struct FacePlaces {
  const std::vector<int>& axis;
  const std::vector<std::array<double, 3>>& position;
};

struct NearNullVector {
  SparseVector z;
  int region, slab;  // slabs of one region more than two apart share no row and have no coupling
  bool whole;        // the whole region, no slab
};

// Translations and rotations of the regions of find_viscous_regions(). A slender region gives those of overlapping
// slabs along its longest axis, weighted by hat functions that sum to one. Only motions of small Rayleigh quotient z'F
// z / z'D z, D = diag(F), are kept. Collective.
std::vector<NearNullVector> find_near_null_space(const LinearSystem& F, const FacePlaces& places, int dimension);

// Product F x for sparse vectors; visits only the rows that x reaches and rows at rank boundaries.
class SparseProduct {
 public:
  // F's pattern must be symmetric.
  explicit SparseProduct(const LinearSystem& F);
  // Collective.
  SparseVector operator()(const SparseVector& x);

 private:
  const LinearSystem& F_;
  Vector x_;  // with ghosts; owned entries are zero between calls
  std::vector<char> reached_;
  std::vector<int> border_;  // rows with ghost columns
};

}  // namespace seiche
