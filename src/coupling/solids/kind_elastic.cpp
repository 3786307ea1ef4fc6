#include "coupling/solids/kind_elastic.h"

#include <fmt/format.h>

#include <unordered_map>

#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/solids/elastic_coupling.h"
#include "coupling/solids/solid_kinds.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/thin/liquid_beside.h"
#include "solid/elastic/output.h"

namespace seiche {
namespace {

// Flags of the surface's points: pinned.
template <int Dim>
std::vector<char> pinned_points(const ElasticSolid<Dim>& solid) {
  std::vector<char> node(solid.body.mesh.nodes.size(), 0), point;
  for (const int dof : pins_at(solid, 0).dofs) node[std::size_t(dof / Dim)] = 1;
  for (const int n : solid.surface.nodes) point.push_back(node[std::size_t(n)]);
  return point;
}

// Function for the weights of the unknowns in the surface's velocity near a face; none where the body has no share.
template <int Dim>
auto surface_weights(const StepGeometry<Dim>& g, int body) {
  auto place = std::make_shared<std::array<std::unordered_map<Site, std::size_t>, Dim>>();
  const FaceShares& shares = *g.shares[std::size_t(body)];
  for (std::size_t n = 0; n < shares.size(); ++n) (*place)[std::size_t(shares[n].axis)][shares[n].face] = n;
  const auto face_weights = g.face_weights[std::size_t(body)];
  return [place, face_weights](int axis, Site face, std::vector<std::pair<int, double>>& weights) {
    weights.clear();
    const auto found = (*place)[std::size_t(axis)].find(face);
    if (found == (*place)[std::size_t(axis)].end()) return;
    for (const auto& [node, weight] : (*face_weights)[found->second])
      if (weight != 0) weights.emplace_back(Dim * node + axis, weight);
  };
}

// Adds a load about the origin to force and torque about a point.
void add_load(const Eigen::VectorXd& load, const Vec3& about, Vec3& force, Vec3& torque) {
  const Vec3 f = load.head(3), t = load.tail(3);
  force += f;
  torque += t - about.cross(f);
}

}  // namespace

template <int Dim>
Placement ElasticParticipant<Dim>::place(double, double, double) const {
  Placement p;
  p.displacement = motion_.state.u;
  p.velocity = Eigen::VectorXd::Zero(p.displacement.size());
  return p;
}

// Bound (m/s) on the speed of pinned nodes from t to t + dt: sqrt(Dim) times the largest component.
template <int Dim>
double ElasticParticipant<Dim>::fastest_prescribed_part(double t, double dt) const {
  const Pins from = pins_at(elements(), t), to = pins_at(elements(), t + dt);
  double fastest = 0;
  for (std::size_t n = 0; n < to.targets.size(); ++n)
    fastest = std::max(fastest, std::abs(to.targets[n] - from.targets[n]) / dt);
  return std::sqrt(double(Dim)) * fastest;
}

// The velocities of the last solve, except that pinned nodes move to their prescribed places at t + dt.
template <int Dim>
Eigen::VectorXd ElasticParticipant<Dim>::velocity_over(double t, double dt, double horizon) const {
  Eigen::VectorXd w = motion_.velocity;
  if (dt == horizon) return w;
  const Pins pins = pins_at(elements(), t + dt);
  for (std::size_t n = 0; n < pins.dofs.size(); ++n)
    w[pins.dofs[n]] = (pins.targets[n] - motion_.state.u[pins.dofs[n]]) / dt;
  return w;
}

template <int Dim>
void ElasticParticipant<Dim>::couple(const CoupledStep<Dim>& step, int block, CouplingParts<Dim>& parts) const {
  couple_elastic_body(step, this->index(), motion_, block, parts);
}

template <int Dim>
void ElasticParticipant<Dim>::finish_columns(const CoupledStep<Dim>& step, int block, CouplingParts<Dim>& parts) const {
  set_elastic_columns(step, this->index(), block, parts);
}

template <int Dim>
void ElasticParticipant<Dim>::take(const SolidCoupling<Dim>& c, int block, const Eigen::VectorXd& v, double) {
  motion_.velocity = v;
  motion_.extra_load =
      total_load(elements(), motion_.state.u,
                 Eigen::VectorXd(c.buoyancy_correction.segment(c.first[std::size_t(block)], v.size())));
  motion_.kept_volume.setConstant(std::numeric_limits<double>::quiet_NaN());
  motion_.cavity = motion_.kept_volume;
}

template <int Dim>
void ElasticParticipant<Dim>::take_reactions(const Eigen::VectorXd& forces) {
  motion_.reaction = total_load(elements(), motion_.state.u, forces);
  pin_forces_ = forces;
}

template <int Dim>
void ElasticParticipant<Dim>::advance(const Stride<Dim>& stride) {
  const Setup<Dim>& s = stride.setup;
  const State<Dim>& before = stride.before;
  motion_.velocity = stride.velocity;
  seiche::advance(elements().body, elastic_scheme(s.scene->time), stride.dt,
                  step_load(s.fluids.gravity, elements(), before, before.dt_now, before.horizon),
                  pins_at(elements(), before.time + stride.dt), motion_);
}

template <int Dim>
double ElasticParticipant<Dim>::possible_share(const Eigen::VectorXd& way) const {
  return inversion_bound<Dim>(elements().body, motion_.state.u, way);
}

// Halves dt until Psi(dt v) <= 1e-3 v'Mv/2.
template <int Dim>
double ElasticParticipant<Dim>::limit_of_start(double dt) const {
  constexpr double share = 1e-3;
  constexpr int most_halves = 60;
  const ElasticBody<Dim>& body = elements().body;
  const Eigen::VectorXd& v = motion_.state.v;
  const double most = share * kinetic_energy(body, v);
  for (int n = 0; n < most_halves && !(elastic_energy(body, Eigen::VectorXd(dt * v)) <= most); ++n) dt /= 2;
  return dt;
}

template <int Dim>
void ElasticParticipant<Dim>::describe_contact(ContactBody& contact) const {
  contact.control = BodyControl::deformable;
  contact.mass = body().mass().mass;
  contact.nodes = elements().surface.nodes;
  contact.node_count = int(elements().body.mesh.nodes.size());
  contact.pinned = pinned_points(elements());
}

template <int Dim>
ContactMotion ElasticParticipant<Dim>::contact_motion(double, double) const {
  return {{}, {}, motion_.state.u, motion_.velocity};
}

template <int Dim>
bool ElasticParticipant<Dim>::may_seal() const {
  return std::any_of(elements().patches.begin(), elements().patches.end(),
                     [](const SurfacePatch<Dim>& p) { return !p.is_closed(); });
}

template <int Dim>
void ElasticParticipant<Dim>::describe_viscous(const StepGeometry<Dim>& g, ViscousSolid<Dim>& solid) const {
  solid.frame = viscous_motion(g);
  solid.surface = surface_weights(g, this->index());
}

template <int Dim>
RigidField ElasticParticipant<Dim>::viscous_motion(const StepGeometry<Dim>&) const {
  const BodyAverage mean = average(elements().body, motion_.state.u, motion_.velocity);
  return {mean.velocity, mean.angular_velocity, mean.center};
}

// The state of the last solve, found together with the liquid's: u + H w and the scheme's velocity there. motion_.state
// is one step older.
template <int Dim>
ElasticState ElasticParticipant<Dim>::as_solved(const Gravity& gravity, const TimeSpec& time,
                                                const State<Dim>& state) const {
  if (state.horizon == 0) return motion_.state;
  ElasticMotion m = motion_;
  seiche::advance(elements().body, elastic_scheme(time), state.horizon,
                  step_load(gravity, elements(), state, state.dt_now, state.horizon),
                  pins_at(elements(), state.time + state.horizon), m);
  return m.state;
}

// E = 1/2 v'Mv + Psi(u) and -g'M x as solved; the momentum is that of w.
template <int Dim>
void ElasticParticipant<Dim>::measure(const Gravity& gravity, const TimeSpec& time, const State<Dim>& state,
                                      StepStats& stats) const {
  const ElasticBody<Dim>& elastic = elements().body;
  const double mass = body().mass().mass;
  const ElasticState solved = as_solved(gravity, time, state);
  const BodyAverage now = average(elastic, solved.u, motion_.velocity);
  stats.kinetic_energy += kinetic_energy(elastic, solved.v);
  stats.elastic_energy += elastic_energy(elastic, solved.u);
  stats.potential_energy -= mass * gravity.at(state.time).dot(now.center);
  stats.momentum += mass * now.velocity;
}

// Position, orientation and velocities of the mean motion. With backward Euler the velocity is that of the last solve,
// which fits the liquid's: it belongs to the end of the way ahead.
template <int Dim>
void ElasticParticipant<Dim>::describe(const TimeSpec& time, const State<Dim>&, SolidState& out) const {
  const bool ahead = elastic_scheme(time) == ElasticScheme::backward_euler;
  const BodyAverage now = average(elements().body, motion_.state.u, ahead ? motion_.velocity : motion_.state.v);
  const Eigen::Quaterniond q(now.rotation);
  out.position = now.center;
  out.orientation = {q.w(), q.x(), q.y(), q.z()};
  out.velocity = now.velocity;
  out.angular_velocity = now.angular_velocity;
}

template <int Dim>
void ElasticParticipant<Dim>::add_loads(SolidState& out) const {
  add_load(motion_.extra_load, out.position, out.force, out.torque);
  add_load(motion_.reaction, out.position, out.pin_force, out.pin_torque);
}

// Forces belong to the ends of the way, the velocities to all of it: W = span v.(f(t) + f(t + span))/2.
template <int Dim>
double ElasticParticipant<Dim>::driven_work(const Participant<Dim>& before, double t, double span) const {
  const auto along = [&](const Eigen::VectorXd& f) { return f.size() == 0 ? 0 : f.dot(motion_.velocity); };
  const auto& earlier = static_cast<const ElasticParticipant&>(before);
  const Eigen::VectorXd from = applied_force_at(elements(), t), to = applied_force_at(elements(), t + span);
  return 0.5 * span * (along(earlier.pin_forces_) + along(pin_forces_) + along(from) + along(to));
}

// With the lumped mass; f: tractions and body forces.
template <int Dim>
double ElasticParticipant<Dim>::pull(double t) const {
  const Eigen::VectorXd f = applied_force_at(elements(), t);
  const Eigen::VectorXd& m = elements().body.lumped_mass;
  double sum = 0;
  for (int n = 0; n < f.size(); ++n) sum += f[n] * f[n] / m[n];
  return sum;
}

template <int Dim>
void ElasticParticipant<Dim>::place_points(const Placement& placed, std::vector<Vec3>& points) const {
  const std::vector<Vec<Dim>> surface = surface_points(elements(), placed.displacement);
  std::transform(surface.begin(), surface.end(), points.begin(), extend<Dim>);
}

template <int Dim>
VolumeFrame ElasticParticipant<Dim>::volume() const {
  return volume_frame(elements().body, elements().surface, motion_.state.u, motion_.velocity);
}

template <int Dim>
std::string ElasticParticipant<Dim>::describe_mesh() const {
  return seiche::describe_mesh(body().spec().name, elements().body.mesh);
}

template <int Dim>
void ElasticParticipant<Dim>::visit(StateVisitor& visitor) {
  const std::string prefix = fmt::format("elastic.{}.", this->index());
  visitor.number(prefix + "dt_old", motion_.state.dt_old);
  visitor.vector(prefix + "u", motion_.state.u);
  visitor.vector(prefix + "v", motion_.state.v);
  visitor.vector(prefix + "u_old", motion_.state.u_old);
  visitor.vector(prefix + "v_old", motion_.state.v_old);
  visitor.vector(prefix + "velocity", motion_.velocity);
  visitor.vector(prefix + "cavity", motion_.cavity);
  visitor.vector(prefix + "kept_volume", motion_.kept_volume);
  visitor.vector(prefix + "extra_load", motion_.extra_load);
  visitor.vector(prefix + "reaction", motion_.reaction);
  if (visitor.has(prefix + "pin_forces")) visitor.vector(prefix + "pin_forces", pin_forces_);
}

template <int Dim>
ElasticMotions elastic_motions(const Participants<Dim>& solids) {
  ElasticMotions motions;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const auto* elastic = dynamic_cast<const ElasticParticipant<Dim>*>(&solids[k]);
    motions.push_back(elastic && solids[k].body().is_free() ? &elastic->motion() : nullptr);
  }
  return motions;
}

template class ElasticParticipant<2>;
template class ElasticParticipant<3>;
template ElasticMotions elastic_motions<2>(const Participants<2>&);
template ElasticMotions elastic_motions<3>(const Participants<3>&);

SolidKindRow elastic_solid() {
  return {SolidKind::elastic,
          "deformed by them",
          {},
          make_participant<ElasticParticipant<2>>,
          make_participant<ElasticParticipant<3>>};
}

}  // namespace seiche
