#include "coupling/state/participant.h"

#include "base/domain_spec.h"
#include "geometry/shapes/shapes.h"

namespace seiche {

template <int Dim>
Placement Participant<Dim>::prescribed_part(Placement placed) const {
  placed.twist = {};
  placed.velocity.setZero();
  return placed;
}

template <int Dim>
void Participant<Dim>::describe_contact(ContactBody& contact) const {
  contact.control = BodyControl::prescribed;
}

template <int Dim>
ContactMotion Participant<Dim>::contact_motion(double t, double horizon) const {
  return {place(t, t, t).pose, place(t, t, t + horizon).pose, {}};
}

template <int Dim>
void Participant<Dim>::describe_viscous(const StepGeometry<Dim>& g, ViscousSolid<Dim>& solid) const {
  solid.frame = viscous_motion(g);
}

template <int Dim>
RigidField Participant<Dim>::viscous_motion(const StepGeometry<Dim>& g) const {
  const Twist& v = g.placed[std::size_t(index_)].twist;
  return {v.linear, v.angular, v.about};
}

template <int Dim>
SurfaceMesh Participant<Dim>::surface_at_rest(const DomainSpec& d) const {
  if (unknowns() > 0) return body_->contact_surface();
  Vec<Dim> lower = Vec<Dim>::Constant(1e300), upper = -lower;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    Vec3 x = d.lower;
    for (int a = 0; a < Dim; ++a) x[a] = (corner >> a) & 1 ? d.upper[a] : d.lower[a];
    const Vec<Dim> rest = truncate<Dim>(place(0, 0, 0).pose.to_rest(x));
    lower = lower.cwiseMin(rest);
    upper = upper.cwiseMax(rest);
  }
  return shape_surface<Dim>(body_->spec().shape, {d.cell_size, nullptr}, lower, upper);
}

template <int Dim>
void Participant<Dim>::place_points(const Placement& placed, std::vector<Vec3>& points) const {
  for (Vec3& x : points) x = placed.pose.apply(x);
}

template class Participant<2>;
template class Participant<3>;

}  // namespace seiche
