#pragma once
// The region that passes a face in a step: between the face and the points its corners come from. Its volume is made
// that of the flow (Owkes, Desjardins 2014).
#include <array>

#include "fluid/volume/grid_pieces.h"

namespace seiche {

// Corners of a face now and before the step, in cells. In 3D they run counterclockwise seen from +axis, in 2D along the
// other axis.
template <int Dim>
struct TracedFace {
  static constexpr int count = Dim == 3 ? 4 : 2;
  int axis = 0;
  std::array<Vec<Dim>, count> now, before;
};

// The cells between a face and where it comes from.
template <int Dim>
CellRange<Dim> range_of(const TracedFace<Dim>& face) {
  Vec<Dim> least = face.now[0], most = least;
  for (std::size_t k = 0; k < face.now.size(); ++k) {
    least = least.cwiseMin(face.now[k]).cwiseMin(face.before[k]);
    most = most.cwiseMax(face.now[k]).cwiseMax(face.before[k]);
  }
  return range_of(least, most);
}

// Simplices with signs whose sum is the region: what passes towards +axis counts positive. Their measures sum up to
// `volume` (cells). Regions of faces with a common edge share the surface between them.
template <int Dim>
class SweptRegion {
 public:
  SweptRegion(const TracedFace<Dim>& face, double volume);

  const Simplex<Dim>* begin() const { return simplices_.data(); }
  const Simplex<Dim>* end() const { return simplices_.data() + count_; }
  // Sum of the measures, in cells.
  double measure() const { return sum_; }
  // Middle of the box around its corners, in cells.
  Vec<Dim> middle() const { return 0.5 * (lowest_ + highest_); }
  // The cells that the region reaches.
  CellRange<Dim> range() const { return range_of(lowest_, highest_); }

 private:
  // A part of the region's boundary; its order is outward where sign is 1.
  struct Facet {
    std::array<Vec<Dim>, Dim> corner;
    double sign;
  };
  void add_sides(const TracedFace<Dim>& face);
  void add(const Facet& facet);
  std::array<Facet, TracedFace<Dim>::count> cap(const TracedFace<Dim>& face, const Vec<Dim>& middle) const;

  static constexpr int most = Dim == 3 ? 12 : 4;

  Vec<Dim> origin_, lowest_, highest_;
  double sum_ = 0;
  int count_ = 0;
  std::array<Simplex<Dim>, most> simplices_;
};

}  // namespace seiche
