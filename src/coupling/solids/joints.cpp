#include "coupling/solids/joints.h"

#include <fmt/format.h>

#include "base/error.h"
#include "coupling/solids/coupled_step.h"
#include "coupling/solids/joint_bow.h"
#include "coupling/solids/joint_leaving.h"
#include "coupling/solids/kind_rigid.h"

namespace seiche {
namespace {

template <int Dim>
class JointInteraction : public Interaction<Dim> {
 public:
  explicit JointInteraction(const JointSet<Dim>& joints) : joints_(joints) {}

  // C where the solids are. The rates of the last solve are a first guess.
  void couple(const CoupledStep<Dim>& step, CouplingParts<Dim>& parts) const override {
    SolidCoupling<Dim>& c = parts.coupling;
    const State<Dim>& state = step.state;
    const double time = state.time - state.since_solve;
    c.joints = std::make_shared<JointMotion<Dim>>(joints_, step, c);
    const std::vector<PlacedRow>& rows = c.joints->rows();
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < rows.size(); ++i) append_row(rows[i], int(i), c.joints->bodies(), c, entries);
    c.J.constraints.resize(Eigen::Index(rows.size()), c.size());
    c.J.constraints.setFromTriplets(entries.begin(), entries.end());
    set_given(step, time, *c.joints);
    guess_rates(state, *c.joints);
    set_wet(step, c);
    auto bow = std::make_shared<JointBow<Dim>>(joints_, step, c, *c.joints);
    if (!bow->empty()) c.joints->bow = std::move(bow);
  }

  void add_forces(const CoupledStep<Dim>& step, CouplingParts<Dim>& parts) const override {
    add_joint_forces(joints_, step, parts);
    if (const auto& bow = parts.coupling.joints->bow) parts.coupling.push += bow->given();
  }

  // Impulses -C'mu act on the bodies.
  void take(const SolidCoupling<Dim>& c, State<Dim>& state) const override {
    const JointMotion<Dim>& motion = *c.joints;
    const Eigen::VectorXd v = motion.velocity_in_state();
    const JointedBodies& bodies = motion.bodies();
    const auto rates = rates_of(c, bodies, v);
    for (int j = 0; j < int(joints_.list.size()); ++j) {
      JointState& joint = state.joints[std::size_t(j)];
      joint.force = joint.torque = Vec3::Zero();
      joint.power = joint.gap = 0;
      joint.bend.resize(0);
      joint.point = point_of_joint(joints_, j, bodies);
      if (has_coordinate(joints_, j)) joint.rate = coordinate_of_joint(joints_, j, bodies, joint.q).rate(rates);
    }
    for (std::size_t i = 0; i < motion.rows().size(); ++i) add_reaction(motion, i, bodies, state);
    for (const JointForce& f : motion.forces) add_force(f, v, motion.dt(), state.joints[std::size_t(f.joint)]);
    if (motion.potential)
      for (const JointLimit& limit : motion.potential->limits())
        add_limit(limit, motion.potential->impulse(limit, v) / motion.dt(), bodies, state);
    take_bow(motion, state);
    for (std::size_t i = 0; i < motion.rows().size(); ++i) {
      JointState& joint = state.joints[std::size_t(motion.rows()[i].joint)];
      joint.gap = std::max(joint.gap, std::abs(motion.left[Eigen::Index(i)]) * motion.rows()[i].size);
    }
  }

  std::string settle(const Domain<Dim>& domain, State<Dim>& state, double time) const override {
    refuse_leaving(joints_, domain, state);
    const std::string open = close_joints(joints_, domain.ranks, time, false, state);
    return open.empty() ? open : "joints " + open + " cannot close: what holds or drives their solids contradicts them";
  }

  void show(const Domain<Dim>& domain, State<Dim>& state) const override {
    (void)close_joints(joints_, domain.ranks, state.time, true, state);
  }

  // Springs as they are at the state's time.
  void measure(const State<Dim>& state, StepStats& stats) const override {
    for (std::size_t j = 0; j < state.joints.size(); ++j) {
      const Joint& joint = joints_.list[j];
      if (!joint.spec.spring || state.joints[j].broken) continue;
      const double rest = joint.spec.spring->rest ? joint.unit * *joint.spec.spring->rest : joint.q_at_start;
      stats.elastic_energy += 0.5 * joint.spec.spring->stiffness * std::pow(state.joints[j].shown_q - rest, 2);
    }
  }

  double driven_work(const State<Dim>& state, double dt) const override {
    double sum = 0;
    for (const JointState& joint : state.joints) sum += dt * joint.power;
    return sum;
  }

 private:
  void guess_rates(const State<Dim>& state, JointMotion<Dim>& motion) const {
    std::vector<Eigen::Index> next(state.joints.size(), 0);
    for (std::size_t i = 0; i < motion.rows().size(); ++i) {
      const auto j = std::size_t(motion.rows()[i].joint);
      const Eigen::VectorXd& bend = state.joints[j].bend;
      if (next[j] < bend.size()) motion.rate[Eigen::Index(i)] = bend[next[j]++];
    }
  }

  // Collective.
  static void set_wet(const CoupledStep<Dim>& step, SolidCoupling<Dim>& c) {
    std::vector<double> entries(step.state.solids.size());
    for (std::size_t b = 0; b < c.bodies.size(); ++b)
      entries[std::size_t(c.bodies[b])] = double(c.J.blocks[b].row.size());
    step.setup.domain.ranks.global_sum(entries);
    for (const double n : entries) c.joints->wet.push_back(char(n > 0));
  }

  static void take_bow(const JointMotion<Dim>& motion, State<Dim>& state) {
    for (int j = 0; j < int(state.joints.size()); ++j) {
      JointState& joint = state.joints[std::size_t(j)];
      joint.interval = motion.horizon();
      if (motion.bow) {
        motion.bow->take(j, joint);
      } else {
        for (Eigen::VectorXd* own : {&joint.bow, &joint.bow_rows, &joint.bow_load}) own->resize(0);
      }
    }
  }

  // Sets the mean rate of each row's drive, less the part of prescribed solids.
  void set_given(const CoupledStep<Dim>& step, double time, JointMotion<Dim>& motion) const {
    std::vector<PlacedRow::Rate> rates = prescribed_rates(joints_, step.state.solids, time, step.horizon);
    for (std::size_t i = 0; i < motion.rows().size(); ++i) {
      const PlacedRow& row = motion.rows()[i];
      motion.given[Eigen::Index(i)] = -row.rate(rates);
      if (row.drives)
        motion.given[Eigen::Index(i)] += mean_drive(joints_.list[std::size_t(row.joint)], time, step.horizon);
    }
  }

  static double mean_drive(const Joint& joint, double time, double span) {
    const double rate =
        joint.unit * ((*joint.drive)(Vec3::Zero(), time + span) - (*joint.drive)(Vec3::Zero(), time)) / span;
    if (!std::isfinite(rate))
      throw Error(ExitCode::cannot_continue, fmt::format("joint '{}': its drive is not finite between t = {:.6g} and "
                                                         "{:.6g} s; correct its formula",
                                                         joint.spec.name, time, time + span));
    return rate;
  }

  // Force and torque of row i on the first body about the joint's point, and its power.
  void add_reaction(const JointMotion<Dim>& motion, std::size_t i, const JointedBodies& bodies,
                    State<Dim>& state) const {
    const PlacedRow& row = motion.rows()[i];
    JointState& joint = state.joints[std::size_t(row.joint)];
    const auto k = Eigen::Index(i);
    const double load = -motion.impulse[k] / motion.dt();
    const auto& [solid, part] = row.parts.front();
    add_load(part, load, bodies[std::size_t(solid)].about, joint);
    joint.power += load * motion.given[k];
    joint.bend.conservativeResize(joint.bend.size() + 1);
    joint.bend[joint.bend.size() - 1] = motion.rate[k];
  }

  // A motor's work counts. Springs keep theirs as elastic energy, and dampers and friction take theirs.
  static void add_force(const JointForce& f, const Eigen::VectorXd& v, double dt, JointState& joint) {
    const double rate = f.rate(v), load = f.force.impulse(rate) / dt;
    add_load(f.on_first, load, f.point, joint);
    if (f.kind == JointForce::Kind::motor) joint.power += 0.5 * load * (f.before + rate);
  }

  void add_limit(const JointLimit& limit, double load, const JointedBodies& bodies, State<Dim>& state) const {
    JointState& joint = state.joints[std::size_t(limit.joint)];
    const PlacedRow row = coordinate_of_joint(joints_, limit.joint, bodies, joint.q);
    add_load(row.parts.front().second, load, bodies[std::size_t(row.parts.front().first)].about, joint);
  }

  static void add_load(const PlacedRow::Rate& part, double load, const Vec3& about, JointState& joint) {
    const Vec3 force = load * part.head<3>();
    joint.force += force;
    joint.torque += load * part.tail<3>() + (about - joint.point).cross(force);
  }

  const JointSet<Dim>& joints_;
};

}  // namespace

template <int Dim>
std::unique_ptr<const Interaction<Dim>> make_joint_interaction(const JointSet<Dim>& joints) {
  return std::make_unique<JointInteraction<Dim>>(joints);
}

template std::unique_ptr<const Interaction<2>> make_joint_interaction<2>(const JointSet<2>&);
template std::unique_ptr<const Interaction<3>> make_joint_interaction<3>(const JointSet<3>&);

}  // namespace seiche
