// Flux that moving bodies push through the parts of faces that they close.
#include "coupling/geometry/step_geometry.h"

namespace seiche {

// closed_flux += s_k (v_new - v_old)(face centre) . e_axis
template <int Dim>
void set_twist(const Layout<Dim>& layout, int body, const Twist& twist, StepGeometry<Dim>& g) {
  Twist& present = g.placed[body].twist;
  if (present.at_rest() && twist.at_rest()) return;
  for (const FaceShare& s : *g.shares[body]) {
    const Vec3 x = extend<Dim>(layout.position(layout.index(s.face), face_offset<Dim>(s.axis)));
    g.faces.closed_flux.add(s.axis, s.face, s.closed * (twist.at(x)[s.axis] - present.at(x)[s.axis]));
  }
  present = twist;
}

template <int Dim>
double velocity_at(const SurfaceWeights& weights, int axis, const Eigen::VectorXd& node_velocity) {
  double v = 0;
  for (const auto& [node, weight] : weights) v += weight * node_velocity[Dim * node + axis];
  return v;
}

template <int Dim>
void set_node_velocity(const Layout<Dim>&, int body, const Eigen::VectorXd& velocity, StepGeometry<Dim>& g) {
  Eigen::VectorXd& present = g.placed[body].velocity;
  const FaceShares& shares = *g.shares[body];
  for (std::size_t n = 0; n < shares.size(); ++n) {
    const int axis = shares[n].axis;
    const SurfaceWeights& weights = (*g.face_weights[body])[n];
    const double change = velocity_at<Dim>(weights, axis, velocity) - velocity_at<Dim>(weights, axis, present);
    g.faces.closed_flux.add(axis, shares[n].face, shares[n].closed * change);
  }
  if (g.cell_fluxes[body])
    for (const CellFlux& c : *g.cell_fluxes[body])
      g.faces.cell_flux.add(c.cell, c.value * (velocity[c.column] - present[c.column]));
  present = velocity;
}

template <int Dim>
void set_motion(const Layout<Dim>& layout, int body, const Placement& motion, StepGeometry<Dim>& g) {
  set_twist(layout, body, motion.twist, g);
  if (g.deforms(body)) set_node_velocity(layout, body, motion.velocity, g);
}

template double velocity_at<2>(const SurfaceWeights&, int, const Eigen::VectorXd&);
template double velocity_at<3>(const SurfaceWeights&, int, const Eigen::VectorXd&);
template void set_node_velocity<2>(const Layout<2>&, int, const Eigen::VectorXd&, StepGeometry<2>&);
template void set_node_velocity<3>(const Layout<3>&, int, const Eigen::VectorXd&, StepGeometry<3>&);
template void set_motion<2>(const Layout<2>&, int, const Placement&, StepGeometry<2>&);
template void set_motion<3>(const Layout<3>&, int, const Placement&, StepGeometry<3>&);
template void set_twist<2>(const Layout<2>&, int, const Twist&, StepGeometry<2>&);
template void set_twist<3>(const Layout<3>&, int, const Twist&, StepGeometry<3>&);

}  // namespace seiche
