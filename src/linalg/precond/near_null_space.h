#pragma once
// What stiff parts of liquid do at next to no cost: move and turn as a whole and, where they are slender, bend.
#include <array>

#include "linalg/core/sparse_vector.h"
#include "linalg/precond/viscous_regions.h"

namespace seiche {

// Where the velocity of a row of F is, in cells, and along which axis.
struct FacePlaces {
  const std::vector<int>& axis;
  const std::vector<std::array<double, 3>>& position;
};

struct NearNullVector {
  SparseVector z;
  int region, slab;  // motions of one region whose slabs are more than two apart do not meet
  bool whole;        // not of a slab
};

// The translations and rotations of find_viscous_regions(); of a slender one those of overlapping slabs along its
// longest axis, weighted by hats that add up to one. Those alone that F lets through. Collective.
std::vector<NearNullVector> find_near_null_space(const LinearSystem& F, const FacePlaces& places, int dimension);

// F x of vectors with few entries, from the rows that it reaches alone.
class SparseProduct {
 public:
  // F's pattern is symmetric.
  explicit SparseProduct(const LinearSystem& F);
  // Collective.
  SparseVector operator()(const SparseVector& x);

 private:
  const LinearSystem& F_;
  Vector x_;  // with ghosts; of owned rows zero between calls
  std::vector<char> reached_;
  std::vector<int> border_;  // rows with ghost columns
};

}  // namespace seiche
