#include "coupling/geometry/off_grid.h"

namespace seiche {

template <int Dim>
StepGeometry<Dim> place_off_grid(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                 std::vector<Placement> placed) {
  StepGeometry<Dim> g;
  g.faces = FaceGeometry<Dim>(layout);
  g.placed = std::move(placed);
  g.shares.assign(bodies.size(), std::make_shared<const FaceShares>());
  g.face_weights.resize(bodies.size());
  g.cell_fluxes.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k)
    g.pivots.push_back(g.placed[k].pose.apply(bodies[k].reference_point()));
  return g;
}

template StepGeometry<2> place_off_grid<2>(const Layout<2>&, const std::vector<Body<2>>&, std::vector<Placement>);
template StepGeometry<3> place_off_grid<3>(const Layout<3>&, const std::vector<Body<3>>&, std::vector<Placement>);

}  // namespace seiche
