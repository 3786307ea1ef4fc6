#include "coupling/solids/known_loads.h"

namespace seiche {
namespace {

using Six = Eigen::Matrix<double, 6, 1>;

Six impulse_of(const SolidLoad& load, double dt) {
  Six i;
  i << dt * load.force, dt * load.torque;
  return i;
}

// Maps force and torque about a solid's reference point to loads on its unknowns; rows of fixed ones are 0.
template <int Dim>
Eigen::MatrixXd onto_unknowns(const Participant<Dim>& solid, const Vec3& reference, const SolidCoupling<Dim>& c,
                              int first) {
  const Vec3 arm = solid.rigid() ? Vec3(reference - solid.rigid()->center) : Vec3(0, 0, 0);
  Eigen::MatrixXd P(solid.unknowns(), 6);
  for (int j = 0; j < 3; ++j) {
    const Vec3 e = Vec3::Unit(j);
    P.col(j) = solid.generalised({e, arm.cross(e)});
    P.col(3 + j) = solid.generalised({Vec3(0, 0, 0), e});
  }
  for (int i = 0; i < P.rows(); ++i)
    if (c.is_held(first + i)) P.row(i).setZero();
  return P;
}

}  // namespace

template <int Dim>
void push_by(const KnownLoads& loads, const Participants<Dim>& solids, const StepGeometry<Dim>& g, double dt,
             SolidCoupling<Dim>& c) {
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    const auto k = std::size_t(c.bodies[b]);
    if (g.deforms(int(k))) continue;
    const int first = c.first[b];
    const Eigen::MatrixXd P =
        onto_unknowns(solids[k], g.placed[k].pose.apply(solids[k].body().reference_point()), c, first);
    auto push = c.push.segment(first, P.rows());
    if (!loads.stress.empty()) push += P * impulse_of(loads.stress[k], dt);
    if (loads.carrying.empty()) continue;
    const Eigen::MatrixXd M = c.mass.block(first, first, P.rows(), P.rows());
    push += M * (M + P * loads.carried[k] * P.transpose()).ldlt().solve(P * impulse_of(loads.carrying[k], dt));
  }
}

#define SEICHE_INSTANTIATE(D)                                                                         \
  template void push_by<D>(const KnownLoads&, const Participants<D>&, const StepGeometry<D>&, double, \
                           SolidCoupling<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
