#include "coupling/solids/joint_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/scene.h"
#include "coupling/solids/contact_setup.h"
#include "coupling/solids/coupled_step.h"
#include "coupling/solids/joints.h"
#include "coupling/solids/kind_rigid.h"
#include "coupling/state/setup.h"
#include "solid/contact/barrier.h"

namespace seiche {
namespace {

// Inputs of the forces of one solve.
template <int Dim>
struct ForceTask {
  const JointSet<Dim>& joints;
  const CoupledStep<Dim>& step;
  const SolidCoupling<Dim>& coupling;
  const JointedBodies& bodies;                 // where the solve stands
  std::vector<PlacedRow::Rate> known, before;  // rates of prescribed solids; of all before the solve
  double time;                                 // of the solve, s
};

template <int Dim>
ForceTask<Dim> make_task(const JointSet<Dim>& joints, const CoupledStep<Dim>& step, const SolidCoupling<Dim>& c) {
  const State<Dim>& state = step.state;
  const double time = state.time - state.since_solve;
  const std::vector<PlacedRow::Rate> known = prescribed_rates(joints, state.solids, time, step.horizon);
  ForceTask<Dim> task{joints, step, c, c.joints->bodies(), known, known, time};
  const auto found = rates_of(c, task.bodies, c.joints->velocity_in_state());
  for (std::size_t k = 0; k < found.size(); ++k)
    if (!task.bodies[k].rates.empty()) task.before[k] = found[k];
  return task;
}

template <int Dim>
std::vector<std::pair<int, double>> columns_of(const PlacedRow& row, const JointedBodies& bodies,
                                               const SolidCoupling<Dim>& c) {
  std::vector<Eigen::Triplet<double>> entries;
  append_row(row, 0, bodies, c, entries);
  std::vector<std::pair<int, double>> columns;
  for (const auto& entry : entries) columns.emplace_back(entry.col(), entry.value());
  return columns;
}

// 1/(rho M^-1 rho'), the mass that a force along the row moves: kg, or kg m^2.
template <int Dim>
double moved_mass(const std::vector<std::pair<int, double>>& row, const SolidCoupling<Dim>& c) {
  double inverse = 0;
  for (const auto& [i, part] : row) inverse += part * part / c.mass.coeff(i, i);
  return inverse > 0 ? 1 / inverse : 0;
}

template <int Dim>
JointForce force_on(const ForceTask<Dim>& task, int j, JointForce::Kind kind) {
  const PlacedRow row = coordinate_of_joint(task.joints, j, task.bodies, task.step.state.joints[std::size_t(j)].q);
  const auto& [first, part] = row.parts.front();
  JointForce f;
  f.kind = kind;
  f.joint = j;
  f.on_first = part;
  f.point = task.bodies[std::size_t(first)].about;
  f.row = columns_of(row, task.bodies, task.coupling);
  f.known = row.rate(task.known);
  f.before = row.rate(task.before);
  return f;
}

// Impulse -dt (k (q + dt (a r' - b r) - rest) + c (r' + r)/2) by rates r before and r' after the solve. a = b = 1/4 is
// the midpoint rule in leapfrog steps, which keeps the spring's energy; a = 1, b = 0 for steps that do not resolve it.
template <int Dim>
CappedForce spring_force(const ForceTask<Dim>& task, const JointForce& f, const JointSpringSpec& spring) {
  const Joint& joint = task.joints.list[std::size_t(f.joint)];
  const double dt = task.step.dt, k = spring.stiffness, c = spring.damping;
  const double rest = spring.rest ? joint.unit * *spring.rest : joint.q_at_start;
  const double mass = moved_mass(f.row, task.coupling);
  const bool leapfrog = task.step.state.since_solve > 0;
  const double unresolved = leapfrog || mass == 0 ? 0 : std::clamp(dt * std::sqrt(k / mass) - 1, 0.0, 1.0);
  const double after = 0.25 + 0.75 * unresolved, before = 0.25 * (1 - unresolved);
  CappedForce force;
  force.slope = dt * dt * k * after + 0.5 * dt * c;
  const double q = task.step.state.joints[std::size_t(f.joint)].q;
  if (force.slope > 0)
    force.rest = (dt * k * (rest - q) + (dt * dt * k * before - 0.5 * dt * c) * f.before) / force.slope;
  return force;
}

// Implicit: dt (k (target' - q - H r) + c (dtarget/dt - r)), with the target at the end of the interval.
template <int Dim>
CappedForce motor_force(const ForceTask<Dim>& task, const JointForce& f, const JointMotorSpec& motor) {
  const Joint& joint = task.joints.list[std::size_t(f.joint)];
  const double dt = task.step.dt, H = task.step.horizon, end = task.time + H;
  CappedForce force;
  if (motor.most()) force.most = dt * *motor.most();
  if (joint.speed) {
    constexpr double creep = 1e-4;  // share of the speed by which the motor lags at its cap
    const double size = joint.size > 0 ? joint.size : 1, slow = creep * task.step.setup.domain.layout.h() / size;
    force.rest = (*joint.speed)(Vec3::Zero(), end);
    force.slope = force.most / std::max(creep * std::abs(force.rest), slow);
    return force;
  }
  const auto target = [&](double t) { return joint.q_at_start + joint.unit * (*joint.target)(Vec3::Zero(), t); };
  const double k = motor.stiffness, c = motor.damping, q = task.step.state.joints[std::size_t(f.joint)].q;
  force.slope = dt * (k * H + c);
  const double rate = (target(end) - target(task.time)) / H;
  if (force.slope > 0) force.rest = dt * (k * (target(end) - q) + c * rate) / force.slope;
  return force;
}

// Coulomb's friction with the load of the last solve.
template <int Dim>
CappedForce friction_force(const ForceTask<Dim>& task, const JointForce& f, const JointSpec& spec) {
  const double creep = 1e-3 * task.step.setup.domain.layout.h();  // m/s
  const bool turns = coordinate_of(spec.kind) == JointCoordinate::turn;
  const double arm = turns ? spec.radius.value_or(0) : 1;
  CappedForce force;
  force.most = task.step.dt * spec.friction * arm * task.step.state.joints[std::size_t(f.joint)].force.norm();
  force.slope = force.most / (creep / (arm > 0 ? arm : 1));
  return force;
}

template <int Dim>
std::vector<JointForce> forces_of(const ForceTask<Dim>& task) {
  using Kind = JointForce::Kind;
  std::vector<JointForce> forces;
  for (int j = 0; j < int(task.joints.list.size()); ++j) {
    const JointSpec& spec = task.joints.list[std::size_t(j)].spec;
    if (task.step.state.joints[std::size_t(j)].broken || !has_coordinate(task.joints, j)) continue;
    const auto add = [&](Kind kind, const auto& make) {
      JointForce f = force_on(task, j, kind);
      f.force = make(f);
      if (!std::isfinite(f.force.rest) || !std::isfinite(f.force.slope))
        throw Error(ExitCode::cannot_continue,
                    fmt::format("joint '{}': its motor is not finite at t = {:.6g} s; correct its formula", spec.name,
                                task.time + task.step.horizon));
      if (f.force.slope > 0) forces.push_back(std::move(f));
    };
    if (spec.spring) add(Kind::spring, [&](const JointForce& f) { return spring_force(task, f, *spec.spring); });
    if (spec.motor) add(Kind::motor, [&](const JointForce& f) { return motor_force(task, f, *spec.motor); });
    if (spec.friction > 0) add(Kind::friction, [&](const JointForce& f) { return friction_force(task, f, spec); });
  }
  return forces;
}

// Limits of the joint's coordinate as lengths: an angle counts along the size of its body.
template <int Dim>
void append_limits(const ForceTask<Dim>& task, int j, double reach, std::vector<JointLimit>& limits) {
  const Joint& joint = task.joints.list[std::size_t(j)];
  const bool rope = joint.spec.kind == JointKind::rope;
  if (!rope && !joint.spec.limits) return;
  const JointForce f = force_on(task, j, JointForce::Kind::spring);
  const double q = task.step.state.joints[std::size_t(j)].q;
  const bool turns = coordinate_of(joint.spec.kind) == JointCoordinate::turn;
  const double scale = turns && joint.size > 0 ? joint.size : 1;
  const auto add = [&](double side, double limit) {
    constexpr double least = 1e-2;  // of the reach: a step that was cut short may end a little beyond
    limits.push_back({f.row, f.known, std::max(scale * side * (limit - q), least * reach), scale, j, side});
  };
  if (rope) return add(1, joint.spec.length ? *joint.spec.length : joint.frames.length);
  add(-1, joint.unit * (*joint.spec.limits)[0]);
  add(1, joint.unit * (*joint.spec.limits)[1]);
}

template <int Dim>
LimitBarrier barrier_of(const ForceTask<Dim>& task, const ContactOptions& options) {
  double heaviest = 0;
  for (std::size_t k = 0; k < task.step.state.solids.size(); ++k)
    if (task.step.state.solids[k].unknowns() > 0)
      heaviest = std::max(heaviest, task.step.state.solids[k].body().mass().mass);
  return {options.reach, contact::stiffness_for(heaviest * options.acceleration, options.reach), task.step.dt,
          task.step.horizon};
}

// slope rho rho' to the mass, slope (rest - known) rho to push.
template <int Dim>
void add_linear(const JointForce& f, SolidCoupling<Dim>& c) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [i, part] : f.row) {
    c.push[i] += f.force.slope * (f.force.rest - f.known) * part;
    for (const auto& [j, other] : f.row) entries.emplace_back(i, j, f.force.slope * part * other);
  }
  SparseMatrix K(c.size(), c.size());
  K.setFromTriplets(entries.begin(), entries.end());
  c.mass += K;
}

}  // namespace

template <int Dim>
void add_joint_forces(const JointSet<Dim>& joints, const CoupledStep<Dim>& step, CouplingParts<Dim>& parts) {
  const Setup<Dim>& s = step.setup;
  SolidCoupling<Dim>& c = parts.coupling;
  const ForceTask<Dim> task = make_task(joints, step, c);
  std::vector<JointForce> forces = forces_of(task), capped;
  const ContactOptions options =
      contact_options(s.domain, s.scene->domain, s.scene->time, s.fluids.gravity, s.perturbation);
  std::vector<JointLimit> limits;
  for (int j = 0; j < int(joints.list.size()); ++j)
    if (!step.state.joints[std::size_t(j)].broken) append_limits(task, j, options.reach, limits);
  for (const JointForce& f : forces)
    if (f.force.is_linear())
      add_linear(f, c);
    else
      capped.push_back(f);
  if (!capped.empty() || !limits.empty()) {
    auto potential = std::make_shared<JointPotential>(std::move(capped), std::move(limits), barrier_of(task, options));
    c.joints->potential = potential;
    parts.potentials.push_back(std::move(potential));
  }
  c.joints->forces = std::move(forces);
}

template void add_joint_forces<2>(const JointSet<2>&, const CoupledStep<2>&, CouplingParts<2>&);
template void add_joint_forces<3>(const JointSet<3>&, const CoupledStep<3>&, CouplingParts<3>&);

}  // namespace seiche
