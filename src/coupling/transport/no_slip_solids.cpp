#include "coupling/transport/no_slip_solids.h"

#include <algorithm>

#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/state/fluids.h"
#include "coupling/transport/beside_solids.h"
#include "fluid/transport/advection.h"
#include "fluid/viscosity/viscous_samples.h"
#include "grid/interpolation.h"

namespace seiche {

template <int Dim>
NoSlipSolids<Dim>::NoSlipSolids(const Setup<Dim>& s, const State<Dim>& state, const StepGeometry<Dim>& g, double way)
    : layout_(s.domain.layout), geometry_(g), way_(way) {
  const bool slips = s.fluids.constant_viscosity() == 0 || (s.fluids.has_gas() && s.fluids.gas_viscosity() == 0);
  if (slips || s.scene->time.scheme == TimeScheme::first_order) return;
  for (std::size_t k = 0; k < s.solids.bodies.size(); ++k) {
    const Body<Dim>& body = s.solids.bodies[k];
    sticks_.push_back(body.spec().slip == Slip::no_slip && !body.is_thin() && !g.deforms(int(k)));
  }
  if (!any()) return;
  for (const Placement& placed : place_moving_bodies(state)) motion_.push_back(placed.twist);
  for (const Twist& twist : motion_) {
    const double rate = twist.angular.norm();
    turn_.push_back(rate > 0 ? Eigen::AngleAxisd(rate * way, Eigen::Vector3d(twist.angular / rate)).toRotationMatrix()
                             : Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  }
  for (std::size_t k = 0; k < motion_.size(); ++k)
    if (!s.solids.bodies[k].is_free()) motion_[k] = g.placed[k].twist;
}

template <int Dim>
bool NoSlipSolids<Dim>::any() const {
  return std::find(sticks_.begin(), sticks_.end(), 1) != sticks_.end();
}

template <int Dim>
std::pair<int, double> NoSlipSolids<Dim>::nearest(int axis, Site f) const {
  const auto [psi, k] = nearest_solid(layout_, geometry_.psi, geometry_.body, axis, f);
  return {k >= 0 && sticks_[std::size_t(k)] ? k : -1, psi};
}

template <int Dim>
int NoSlipSolids<Dim>::around(int axis, Site f) const {
  if (geometry_.psi[f] > 2 * layout_.h()) return -1;
  const auto [k, psi] = nearest(axis, f);
  return psi <= 0 ? k : -1;
}

// x_then = p_then + R'(x - p), p the pivot, R the turn since then.
template <int Dim>
Vec<Dim> NoSlipSolids<Dim>::before(int k, const Vec<Dim>& x) const {
  const auto n = std::size_t(k);
  const Vec3 pivot = geometry_.pivots[n];
  return truncate<Dim>(pivot - way_ * motion_[n].at(pivot) + turn_[n].transpose() * (extend<Dim>(x) - pivot));
}

template <int Dim>
double NoSlipSolids<Dim>::moved_flow(const FaceField<Dim>& u, int k, int axis, const IVec<Dim>& i) const {
  const Vec<Dim> x = layout_.position(i, face_offset<Dim>(axis)), then = before(k, x);
  if ((then - x).norm() < 1e-9 * layout_.h()) return u.at(axis, layout_.site(i));
  return (turn_[std::size_t(k)] * extend<Dim>(sample_velocity(layout_, u, then)))[axis];
}

// The distance of x then is that now of the point that moved along with the solid from there.
template <int Dim>
std::optional<FaceInSolid<Dim>> NoSlipSolids<Dim>::find(int axis, Site f, const IVec<Dim>& i, double deepest) const {
  const double moved = layout_.halo(), psi_at_corner = geometry_.psi[f] / layout_.h();
  if (psi_at_corner > moved || psi_at_corner < -deepest - moved) return {};
  if (geometry_.faces.kind_at(axis, f) == FaceKind::prescribed) return {};
  const int k = geometry_.body[f];
  if (k < 0 || !sticks_[std::size_t(k)]) return {};
  const Vec<Dim> center = layout_.position(i, face_offset<Dim>(axis));
  const Vec3 pivot = geometry_.pivots[std::size_t(k)],
             from = extend<Dim>(center) - pivot + way_ * motion_[std::size_t(k)].at(pivot);
  const Vec<Dim> there =
      index_coordinates<Dim>(layout_, truncate<Dim>(pivot + turn_[std::size_t(k)] * from), Vec<Dim>::Zero());
  const auto distance = [&](const Vec<Dim>& at) { return interpolate_cubic<Dim>(layout_, geometry_.psi.data(), at); };
  const double psi = distance(there);
  if (psi > 0 || psi <= -deepest * layout_.h()) return {};
  Vec<Dim> gradient;
  for (int b = 0; b < Dim; ++b) {
    const Vec<Dim> step = 0.5 * Vec<Dim>::Unit(b);
    gradient[b] = distance(there + step) - distance(there - step);
  }
  gradient = truncate<Dim>(turn_[std::size_t(k)].transpose() * extend<Dim>(gradient));
  if (gradient.norm() == 0) return {};
  return FaceInSolid<Dim>{k, -psi / layout_.h(), gradient.normalized(), center};
}

template class NoSlipSolids<2>;
template class NoSlipSolids<3>;

}  // namespace seiche
