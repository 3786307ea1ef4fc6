#pragma once
// The region that passes a face in a step: between the face and the points its corners come from. Its volume is made
// that of the flow (Owkes, Desjardins 2014).
#include <array>
#include <vector>

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

// Simplices with signs whose sum is the region: what passes towards +axis counts positive. Their measures sum up to
// `volume` (cells). Regions of faces with a common edge share the surface between them.
template <int Dim>
class SweptRegion {
 public:
  SweptRegion(const TracedFace<Dim>& face, double volume);

  const std::vector<Simplex<Dim>>& simplices() const { return simplices_; }

 private:
  // A part of the region's boundary; its order is outward where sign is 1.
  struct Facet {
    std::array<Vec<Dim>, Dim> corner;
    double sign;
  };
  void add_sides(const TracedFace<Dim>& face);
  void add(const Facet& facet);
  std::vector<Facet> cap(const TracedFace<Dim>& face, const Vec<Dim>& middle) const;

  Vec<Dim> origin_;
  double sum_ = 0;
  std::vector<Simplex<Dim>> simplices_;
};

}  // namespace seiche
