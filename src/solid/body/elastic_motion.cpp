#include "solid/body/elastic_motion.h"

#include <Eigen/SVD>

namespace seiche {

template <int Dim>
Eigen::VectorXd places_in_sequence(const ElasticSolid<Dim>& solid, double t) {
  const Pins pins = pins_at(solid, t);
  return Eigen::Map<const Eigen::VectorXd>(pins.targets.data(), Eigen::Index(pins.targets.size()));
}

template <int Dim>
ElasticMotion initial_elastic_motion(const Body<Dim>& body) {
  ElasticMotion m;
  const ElasticSolid<Dim>& solid = body.elastic();
  m.state = at_rest(solid.body);
  const RigidSpec& spec = body.spec().rigid;
  for (std::size_t n = 0; n < solid.body.mesh.nodes.size(); ++n) {
    const Vec3 arm = extend<Dim>(solid.body.mesh.nodes[n]) - body.mass().center;
    m.state.v.segment<Dim>(Dim * Eigen::Index(n)) =
        truncate<Dim>(Vec3(spec.velocity + spec.angular_velocity.cross(arm)));
  }
  for (const int dof : pins_at(solid, 0).dofs) m.state.v[dof] = 0;
  if (solid.sequence) {
    constexpr double soon = 1e-6;  // of the time between two meshes
    const double span = soon / body.spec().sequence.rate;
    m.state.u = m.state.u_old = places_in_sequence(solid, 0);
    m.state.v = m.state.v_old = (places_in_sequence(solid, span) - m.state.u) / span;
  }
  m.velocity = m.state.v;
  m.kept_volume.setConstant(Eigen::Index(solid.patches.size()), std::numeric_limits<double>::quiet_NaN());
  m.cavity = m.kept_volume;
  m.extra_load.setZero(6);
  m.reaction.setZero(6);
  return m;
}

template <int Dim>
void advance(const ElasticBody<Dim>& body, ElasticScheme scheme, double dt, const StepLoad& load, const Pins& pins,
             ElasticMotion& motion) {
  const auto potential = begin_step(body, motion.state, scheme, dt, load);
  const Eigen::VectorXd u = motion.state.u + dt * motion.velocity;
  end_step(potential, dt, pins, u, motion.state);
}

template <int Dim>
std::vector<Vec<Dim>> surface_points(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u) {
  std::vector<Vec<Dim>> points;
  for (const int n : solid.surface.nodes)
    points.push_back(solid.body.mesh.nodes[std::size_t(n)] + u.segment<Dim>(Dim * Eigen::Index(n)));
  return points;
}

namespace {

// The rotation nearest to sum m x X', by the singular value decomposition.
template <int Dim>
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& sum) {
  const Eigen::JacobiSVD<Eigen::Matrix<double, Dim, Dim>> svd(sum.topLeftCorner<Dim, Dim>(),
                                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix<double, Dim, Dim> U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(Dim - 1) *= -1;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<Dim, Dim>() = U * svd.matrixV().transpose();
  return R;
}

}  // namespace

// omega = I^-1 L about the centre of mass.
template <int Dim>
BodyAverage average(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
  BodyAverage r;
  const Eigen::VectorXd masses = body.mass * Eigen::VectorXd::Ones(body.size()), momentum = body.mass * v;
  Vec3 rest = Vec3::Zero(), p = Vec3::Zero(), L = Vec3::Zero();
  double mass = 0;
  const auto X = [&](Eigen::Index n) { return extend<Dim>(body.mesh.nodes[std::size_t(n)]); };
  const auto x = [&](Eigen::Index n) { return Vec3(X(n) + extend<Dim>(Vec<Dim>(u.segment<Dim>(Dim * n)))); };
  const auto count = Eigen::Index(body.mesh.nodes.size());
  for (Eigen::Index n = 0; n < count; ++n) {
    mass += masses[Dim * n];
    rest += masses[Dim * n] * X(n);
    r.center += masses[Dim * n] * x(n);
    p += extend<Dim>(Vec<Dim>(momentum.segment<Dim>(Dim * n)));
  }
  rest /= mass, r.center /= mass, r.velocity = p / mass;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero(), inertia = Eigen::Matrix3d::Zero();
  for (Eigen::Index n = 0; n < count; ++n) {
    const Vec3 arm = x(n) - r.center;
    L += arm.cross(extend<Dim>(Vec<Dim>(momentum.segment<Dim>(Dim * n))));
    turn += masses[Dim * n] * arm * (X(n) - rest).transpose();
    inertia += masses[Dim * n] * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  }
  r.rotation = nearest_rotation<Dim>(turn);
  if constexpr (Dim == 2)
    r.angular_velocity[2] = L[2] / inertia(2, 2);
  else
    r.angular_velocity = inertia.ldlt().solve(L);
  return r;
}

#define SEICHE_INSTANTIATE(D)                                                                          \
  template Eigen::VectorXd places_in_sequence<D>(const ElasticSolid<D>&, double);                      \
  template ElasticMotion initial_elastic_motion<D>(const Body<D>&);                                    \
  template void advance<D>(const ElasticBody<D>&, ElasticScheme, double, const StepLoad&, const Pins&, \
                           ElasticMotion&);                                                            \
  template std::vector<Vec<D>> surface_points<D>(const ElasticSolid<D>&, const Eigen::VectorXd&);      \
  template BodyAverage average<D>(const ElasticBody<D>&, const Eigen::VectorXd&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
