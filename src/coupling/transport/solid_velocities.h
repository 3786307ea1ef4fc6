#pragma once
// Velocities of solids where they cut the grid.
#include <optional>
#include <unordered_map>

#include "coupling/geometry/step_geometry.h"

namespace seiche {

// Velocities of the solids at faces, m/s, for their placements. Deforming solids have one only on faces that they
// close, near their surface. Keeps references.
template <int Dim>
class SolidVelocities {
 public:
  SolidVelocities(const Layout<Dim>& layout, const StepGeometry<Dim>& g, const std::vector<Placement>& placed)
      : g_(g), placed_(placed), layout_(layout), shares_(placed.size()) {
    for (std::size_t k = 0; k < placed.size(); ++k) {
      if (!g.deforms(int(k))) continue;
      for (std::size_t n = 0; n < g.shares[k]->size(); ++n)
        shares_[k][std::size_t((*g.shares[k])[n].axis)][(*g.shares[k])[n].face] = n;
    }
  }
  std::optional<Vec<Dim>> at(int body, int axis, Site face) const {
    if (!g_.deforms(body)) {
      const Vec3 x = extend<Dim>(layout_.position(layout_.index(face), face_offset<Dim>(axis)));
      return truncate<Dim>(placed_[std::size_t(body)].twist.at(x));
    }
    const auto& faces = shares_[std::size_t(body)][std::size_t(axis)];
    const auto found = faces.find(face);
    if (found == faces.end()) return {};
    const SurfaceWeights& weights = (*g_.face_weights[std::size_t(body)])[found->second];
    if (weights.empty()) return {};
    Vec<Dim> v;
    for (int b = 0; b < Dim; ++b) v[b] = velocity_at<Dim>(weights, b, placed_[std::size_t(body)].velocity);
    return v;
  }

 private:
  const StepGeometry<Dim>& g_;
  const std::vector<Placement>& placed_;
  const Layout<Dim>& layout_;
  std::vector<std::array<std::unordered_map<Site, std::size_t>, Dim>> shares_;
};

}  // namespace seiche
