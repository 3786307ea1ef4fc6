// Places of jointed bodies in which their joints are closed.
#include <algorithm>

#include "coupling/solids/joints.h"
#include "coupling/solids/kind_elastic.h"
#include "coupling/solids/kind_rigid.h"
#include "coupling/solids/rigid_coupling.h"
#include "coupling/state/joint_messages.h"
#include "linalg/core/body_matrix.h"
#include "solid/rigid/motion.h"

namespace seiche {
namespace {

constexpr double all_closed = 1e-11;  // of the size of a joint's body: below the tolerance of the solve
constexpr int most_turns = 30;

// The bodies that move, their masses, and which of their motions are free. Of elastic solids the nodes move, each with
// its lumped mass.
template <int Dim>
class JointedMasses {
 public:
  JointedMasses(const JointSet<Dim>& joints, const Participants<Dim>& solids) : first_(solids.size(), -1) {
    for (std::size_t k = 0; k < solids.size(); ++k) {
      if (!solids[k].rigid() && !holds_patch_of(joints, int(k))) continue;
      first_[k] = size();
      bodies_.push_back(int(k));
      if (const RigidState* r = solids[k].rigid())
        add_rigid(solids[k].body(), *r);
      else
        add_nodes(solids[k].body().elastic().body.lumped_mass);
    }
  }

  const std::vector<int>& bodies() const { return bodies_; }
  int first(int solid) const { return first_[std::size_t(solid)]; }
  int size() const { return int(held_.size()); }

  // Factors C M^-1 C' of the rows.
  void factor(const std::vector<PlacedRow>& rows, const JointedBodies& bodies, const Communicator& ranks) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const auto& [k, part] : rows[i].parts) add_part(int(i), bodies[std::size_t(k)], part, entries);
    SparseMatrix C(Eigen::Index(rows.size()), size()), M(size(), size());
    C.setFromTriplets(entries.begin(), entries.end());
    M.setFromTriplets(mass_.begin(), mass_.end());
    inertia_ = std::make_unique<BodyMatrix>(ranks);
    if (!inertia_->set(M, C)) inertia_ = nullptr;
  }

  // Least displacements by which the values of the rows that were factored change by `change`.
  Eigen::VectorXd displacements(const Eigen::VectorXd& change) const {
    return inertia_ ? inertia_->prescribed(change) : Eigen::VectorXd::Zero(size());
  }

 private:
  static Vec3 as_numbers(const std::array<bool, 3>& flags) {
    return {double(flags[0]), double(flags[1]), double(flags[2])};
  }

  static bool holds_patch_of(const JointSet<Dim>& joints, int solid) {
    return std::any_of(joints.patches.begin(), joints.patches.end(), [&](const auto& p) { return p.solid == solid; });
  }

  void add_nodes(const Eigen::VectorXd& mass) {
    for (Eigen::Index i = 0; i < mass.size(); ++i) mass_.emplace_back(size(), size(), mass[i]), held_.push_back(0);
  }

  void add_rigid(const Body<Dim>& body, const RigidState& r) {
    const int first = size();
    const RigidSpec& spec = body.spec().rigid;
    const auto held = stacked<Dim>(as_numbers(spec.fixed_position), as_numbers(spec.fixed_rotation));
    for (int i = 0; i < twist_size<Dim>; ++i) held_.push_back(held[i] != 0);
    const double mass = body.mass().mass;
    const Eigen::Matrix3d inertia = world_inertia(body, r);
    for (int i = 0; i < Dim; ++i) mass_.emplace_back(first + i, first + i, mass);
    if constexpr (Dim == 2) mass_.emplace_back(first + 2, first + 2, inertia(2, 2));
    for (int i = 0; i < 3 && Dim == 3; ++i)
      for (int j = 0; j < 3; ++j) mass_.emplace_back(first + 3 + i, first + 3 + j, inertia(i, j));
  }

  void add_part(int row, const PlacedBody& body, const PlacedRow::Rate& part,
                std::vector<Eigen::Triplet<double>>& entries) const {
    for (const auto& [i, rate] : body.rates) {
      const int unknown = first(body.solid) + i;
      const double own = part.dot(rate);
      if (own != 0 && !held_[std::size_t(unknown)]) entries.emplace_back(row, unknown, own);
    }
  }

  std::vector<int> bodies_, first_;  // first displacement of each solid; -1: it has none
  std::vector<char> held_;
  std::vector<Eigen::Triplet<double>> mass_;
  std::unique_ptr<BodyMatrix> inertia_;
};

// Bodies in trial places.
template <int Dim>
void displace(const JointedMasses<Dim>& masses, const Eigen::VectorXd& way, Participants<Dim>& solids) {
  for (const int k : masses.bodies()) {
    if (ElasticMotion* elastic = elastic_motion(solids[std::size_t(k)])) {
      elastic->state.u += way.segment(masses.first(k), elastic->state.u.size());
      continue;
    }
    RigidParticipant<Dim>& rigid = *rigid_participant(solids[std::size_t(k)]);
    const Twist part = unstacked<Dim>(way, masses.first(k), Vec3::Zero());
    rigid.set_state(displaced(rigid.state(), part.linear, part.angular));
  }
}

template <int Dim>
std::vector<double> coordinates(const JointSet<Dim>& joints, const JointedBodies& bodies, std::vector<double> near) {
  for (int j = 0; j < int(near.size()); ++j)
    if (has_coordinate(joints, j))
      near[std::size_t(j)] = coordinate_of_joint(joints, j, bodies, near[std::size_t(j)]).value;
  return near;
}

Eigen::VectorXd values_of(const std::vector<PlacedRow>& rows) {
  Eigen::VectorXd values(Eigen::Index(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) values[Eigen::Index(i)] = rows[i].value;
  return values;
}

template <int Dim>
std::vector<int> open_joints(const JointSet<Dim>& joints, const std::vector<PlacedRow>& rows, double tolerance) {
  std::vector<int> open;
  for (const PlacedRow& row : rows) {
    const double size = joints.list[std::size_t(row.joint)].size;
    if (std::abs(row.value) * row.size > tolerance * (size > 0 ? size : 1)) open.push_back(row.joint);
  }
  return open;
}

// Shown places of rigid bodies as shifts from the straight way. Elastic solids end their steps where they are solved
// for.
template <int Dim>
void set_shown(const Participants<Dim>& on_way, const std::vector<int>& bodies, Participants<Dim>& solids) {
  for (const int k : bodies) {
    if (!solids[std::size_t(k)].rigid()) continue;
    RigidState shown = *solids[std::size_t(k)].rigid();
    const RigidState& moving = *on_way[std::size_t(k)].rigid();
    shown.shown_shift = shown.center - moving.center;
    shown.shown_turn = log_rotation(shown.rotation * moving.rotation.transpose());
    rigid_participant(solids[std::size_t(k)])->set_state(shown);
  }
}

}  // namespace

// Gauss-Newton on c(x) = 0: x <- x - M^-1 C'W^+ c. A factor serves as long as gaps fall fast.
template <int Dim>
std::string close_joints(const JointSet<Dim>& joints, const Communicator& ranks, double time, bool shown,
                         State<Dim>& state) {
  constexpr double good_enough = 1e-9, fast = 0.05;
  Participants<Dim> solids = state.solids;
  JointedMasses<Dim> masses(joints, solids);
  std::vector<double> near;
  for (const JointState& joint : state.joints) near.push_back(joint.shown_q);
  std::vector<PlacedRow> rows;
  bool moved = false;
  double before = 0;
  for (int turn = 0; turn < most_turns; ++turn) {
    const JointedBodies bodies = jointed_bodies(joints, solids, time);
    near = coordinates(joints, bodies, near);
    rows = constraints_of(joints, state.joints, bodies, near, time);
    if (open_joints(joints, rows, all_closed).empty()) break;
    const Eigen::VectorXd gaps = values_of(rows);
    const double worst = gaps.lpNorm<Eigen::Infinity>();
    if (!(worst < fast * before)) masses.factor(rows, bodies, ranks);
    before = worst;
    displace(masses, masses.displacements(-gaps), solids);
    moved = true;
  }
  for (std::size_t j = 0; j < near.size(); ++j) (shown ? state.joints[j].shown_q : state.joints[j].q) = near[j];
  const std::vector<int> open = open_joints(joints, rows, good_enough);
  if (!moved) return {};
  if (shown) set_shown(state.solids, masses.bodies(), solids);
  state.solids = std::move(solids);
  return open.empty() ? std::string() : names_of_loops(joints, state, open);
}

template std::string close_joints<2>(const JointSet<2>&, const Communicator&, double, bool, State<2>&);
template std::string close_joints<3>(const JointSet<3>&, const Communicator&, double, bool, State<3>&);

}  // namespace seiche
