#pragma once
// The solids as the grid sees them at one time: distances at nodes, what faces let through, which body closes a face.
#include <vector>

#include "fluid/face_geometry.h"
#include "fluid/sides.h"
#include "solid/body.h"

namespace seiche {

template <int Dim>
struct StepGeometry {
  NodeField<Dim> psi;                 // distance to the nearest solid, m, negative inside
  NodeField<Dim, std::int16_t> body;  // index of that solid, -1 without solids
  FaceGeometry<Dim> faces;
  std::vector<Twist> twists;  // of all bodies over the step
};

template <int Dim>
class SolidGeometry {
 public:
  SolidGeometry(const Layout<Dim>& layout, const Sides<Dim>& sides, const std::vector<Body<Dim>>& bodies);

  // Solids at time t1, moving as they do from t0 to t1 (t0 = t1: at rest).
  StepGeometry<Dim> measure(double t0, double t1) const;

  // Farthest any point of a moving body within the domain goes from t0 to t1, m.
  double largest_displacement(double t0, double t1) const;

 private:
  void measure_distances(const Body<Dim>& body, std::int16_t index, const Pose& pose, StepGeometry<Dim>& g) const;
  void close_faces(StepGeometry<Dim>& g) const;
  void set_sides(double t, StepGeometry<Dim>& g) const;

  const Layout<Dim>& layout_;
  const Sides<Dim>& sides_;
  const std::vector<Body<Dim>>& bodies_;
  StepGeometry<Dim> still_;  // of the static bodies
  bool any_moves_ = false;
  std::vector<double> radius_;  // of the moving bodies about their pivots, m
};

// Share of a face that body k closes: the face's closed part s = 1 - w split by how deep its corners lie in each body.
// Calls visit(body, share).
template <int Dim, class Visit>
void for_each_closing_body(const Layout<Dim>& layout, const StepGeometry<Dim>& g, int axis, Site face,
                           const Visit& visit);

}  // namespace seiche

#include "coupling/step_geometry_shares.h"
