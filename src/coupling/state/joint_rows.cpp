#include "coupling/state/joint_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/scene.h"
#include "coupling/state/state.h"

namespace seiche {
namespace {

constexpr double circle = 2 * std::numbers::pi;

int index_of_solid(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.solids.size(); ++k)
    if (scene.solids[k].name == name) return int(k);
  return -1;  // "world"
}

int index_of_joint(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.joints.size(); ++k)
    if (scene.joints[k].name == name) return int(k);
  return -1;
}

std::shared_ptr<const Expression> made(const std::optional<Formula>& text) {
  return text ? std::make_shared<const Expression>(*text) : nullptr;
}

// Distance of the farthest point of a solid from its centre of mass, m; 0 for the world and solids that do not move
// freely.
template <int Dim>
double size_of(const std::vector<Body<Dim>>& bodies, int k) {
  if (k < 0) return 0;
  const Body<Dim>& body = bodies[std::size_t(k)];
  if (!body.deforms()) return body.radius();
  double size = 0;
  for (const Vec<Dim>& x : body.elastic().body.mesh.nodes)
    size = std::max(size, (extend<Dim>(x) - body.mass().center).norm());
  return size;
}

template <int Dim>
PlacedRow placed_row(const Joint& joint, int number, const JointRow& row) {
  return {number, row.value, 1, false, RowParts({joint.first, row.first}, {joint.second, row.second})};
}

// The place of one side of a joint; adds the patch that it holds.
template <int Dim>
int place_of(const JointSpec& spec, int side, int solid, const std::vector<Body<Dim>>& bodies, double cell_size,
             std::vector<HeldPatch<Dim>>& patches) {
  if (solid < 0) return int(bodies.size());
  const Body<Dim>& body = bodies[std::size_t(solid)];
  if (!body.deforms()) return solid;
  const ShapeSpec& region = side == 1 && spec.second_region ? *spec.second_region : *spec.region;
  patches.push_back({solid, make_patch(body.elastic(), region, {cell_size}, spec.name, body.spec().name)});
  return int(bodies.size() + patches.size());
}

// q' - q'_start - ratio (q'' - q''_start) of two joints.
template <int Dim>
PlacedRow gear_row(const JointSet<Dim>& joints, int number, const JointedBodies& bodies,
                   const std::vector<double>& near) {
  const Joint& gear = joints.list[std::size_t(number)];
  const auto coordinate = [&](int j) { return coordinate_of_joint(joints, j, bodies, near[std::size_t(j)]); };
  PlacedRow row = coordinate(gear.first);
  const PlacedRow other = coordinate(gear.second);
  const double ratio = gear.spec.ratio;
  row.value -= joints.list[std::size_t(gear.first)].q_at_start;
  row.value -= ratio * (other.value - joints.list[std::size_t(gear.second)].q_at_start);
  for (const auto& [solid, rate] : other.parts) row.parts.emplace_back(solid, -ratio * rate);
  row.joint = number;
  return row;
}

// True if the length of a distance is fixed: without anything that acts along it.
bool is_rod(const JointSpec& spec) {
  return !spec.drive && !spec.spring && !spec.motor && !spec.limits;
}

}  // namespace

template <int Dim>
JointSet<Dim>::JointSet(const Scene& scene, const std::vector<Body<Dim>>& bodies) : solids(int(bodies.size())) {
  for (const JointSpec& spec : scene.joints) {
    Joint& joint = list.emplace_back();
    joint.spec = spec;
    joint.frames = joint_frames(spec, Dim);
    const bool gear = spec.kind == JointKind::gear;
    if (gear)
      joint.first = index_of_joint(scene, spec.between[0]), joint.second = index_of_joint(scene, spec.between[1]);
    for (const int side : {0, 1}) {
      if (gear) break;
      joint.solids[std::size_t(side)] = index_of_solid(scene, spec.between[std::size_t(side)]);
      (side == 0 ? joint.first : joint.second) =
          place_of(spec, side, joint.solids[std::size_t(side)], bodies, scene.domain.cell_size, patches);
    }
    if (spec.drive) joint.drive = made(spec.drive->degrees ? spec.drive->degrees : spec.drive->translate);
    if (spec.motor) joint.speed = made(spec.motor->speed), joint.target = made(spec.motor->target);
    if (coordinate_of(spec.kind) == JointCoordinate::turn) joint.unit = std::numbers::pi / 180;
    if (coordinate_of(spec.kind) == JointCoordinate::length) joint.q_at_start = joint.frames.length;
    if (!gear) joint.size = std::max(size_of(bodies, joint.solids[0]), size_of(bodies, joint.solids[1]));
  }
  for (Joint& joint : list)
    if (joint.spec.kind == JointKind::gear)
      joint.size = std::max(list[std::size_t(joint.first)].size, list[std::size_t(joint.second)].size);
}

template <int Dim>
std::vector<std::array<int, 2>> JointSet<Dim>::pairs_apart() const {
  std::vector<std::array<int, 2>> pairs;
  for (const Joint& joint : list)
    if (!joint.spec.collide && std::min(joint.solids[0], joint.solids[1]) >= 0)
      pairs.push_back({std::min(joint.solids[0], joint.solids[1]), std::max(joint.solids[0], joint.solids[1])});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

namespace {

// True if the joint leaves its first solid no motion against the second.
bool holds_still(const Joint& joint) {
  const bool one_way = joint.spec.kind == JointKind::slider || joint.spec.kind == JointKind::hinge;
  return joint.spec.kind == JointKind::weld || (one_way && joint.drive && joint.drive->is_constant());
}

}  // namespace

template <int Dim>
std::vector<char> held_still(const JointSet<Dim>& joints, const std::vector<Body<Dim>>& bodies) {
  std::vector<char> held(bodies.size(), 0);
  const auto stands = [&](int k) { return k < 0 || held[std::size_t(k)] || !bodies[std::size_t(k)].moves(); };
  for (bool found = true; found;) {
    found = false;
    for (const Joint& joint : joints.list)
      for (const int side : {0, 1}) {
        const int k = joint.solids[std::size_t(side)];
        if (joint.spec.kind == JointKind::gear || stands(k) || !stands(joint.solids[std::size_t(1 - side)])) continue;
        if (!bodies[std::size_t(k)].is_free() || bodies[std::size_t(k)].deforms() || !holds_still(joint)) continue;
        held[std::size_t(k)] = 1;
        found = true;
      }
  }
  return held;
}

template <int Dim>
std::string JointSet<Dim>::names_of(const std::vector<int>& joints) const {
  std::vector<std::string> names;
  for (const int j : joints) names.push_back("'" + list[std::size_t(j)].spec.name + "'");
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

template <int Dim>
PlacedBody placed_patch(const HeldPatch<Dim>& held, const Eigen::VectorXd& u) {
  PlacedPatch<Dim> placed = place_patch(held.patch, u);
  PlacedBody body{placed.body};
  body.solid = held.solid;
  body.rates = std::move(placed.rates);
  return body;
}

template <int Dim>
JointedBodies jointed_bodies(const JointSet<Dim>& joints, const Participants<Dim>& solids, double time) {
  JointedBodies bodies(solids.size() + 1);
  for (std::size_t k = 0; k < solids.size(); ++k) {
    PlacedBody& body = bodies[k];
    body.pose = solids[k].place(time, time, time).pose;
    body.about = body.pose.pivot + body.pose.displacement;
    body.solid = int(k);
    const RigidState* rigid = solids[k].rigid();
    if (!rigid) continue;
    body.about = rigid->center;
    body.rates.reserve(std::size_t(solids[k].unknowns()));
    for (int i = 0; i < solids[k].unknowns(); ++i)
      body.rates.emplace_back(i, PlacedBody::Rate::Unit(Dim == 2 && i == 2 ? 5 : i));
  }
  for (const HeldPatch<Dim>& held : joints.patches)
    bodies.push_back(placed_patch(held, solids[std::size_t(held.solid)].place(time, time, time).displacement));
  return bodies;
}

double PlacedRow::rate(const std::vector<Rate>& velocities) const {
  double sum = 0;
  for (const auto& [solid, part] : parts) sum += part.dot(velocities[std::size_t(solid)]);
  return sum;
}

template <int Dim>
bool has_coordinate(const JointSet<Dim>& joints, int joint) {
  return coordinate_of(joints.list[std::size_t(joint)].spec.kind) != JointCoordinate::none;
}

template <int Dim>
PlacedRow coordinate_of_joint(const JointSet<Dim>& joints, int number, const JointedBodies& bodies, double near) {
  const Joint& joint = joints.list[std::size_t(number)];
  JointRow row = joint_coordinate(joint.spec.kind, joint.frames, bodies[std::size_t(joint.first)],
                                  bodies[std::size_t(joint.second)]);
  if (coordinate_of(joint.spec.kind) == JointCoordinate::turn)
    row.value += circle * std::round((near - row.value) / circle);
  return placed_row<Dim>(joint, number, row);
}

template <int Dim>
std::vector<PlacedRow> constraints_of(const JointSet<Dim>& joints, const std::vector<JointState>& states,
                                      const JointedBodies& bodies, const std::vector<double>& near, double time) {
  std::vector<PlacedRow> rows;
  rows.reserve(6 * joints.list.size());
  for (int j = 0; j < int(joints.list.size()); ++j) {
    const Joint& joint = joints.list[std::size_t(j)];
    if (states[std::size_t(j)].broken) continue;
    const std::size_t first = rows.size();
    if (joint.spec.kind == JointKind::gear) {
      rows.push_back(gear_row(joints, j, bodies, near));
    } else if (joint.spec.kind != JointKind::distance || is_rod(joint.spec)) {
      for (const JointRow& row : joint_constraints(joint.spec.kind, Dim, joint.frames, bodies[std::size_t(joint.first)],
                                                   bodies[std::size_t(joint.second)]))
        rows.push_back(placed_row<Dim>(joint, j, row));
    }
    if (joint.drive) {
      rows.push_back(coordinate_of_joint(joints, j, bodies, near[std::size_t(j)]));
      rows.back().drives = true;
      rows.back().value -= joint.q_at_start + joint.unit * (*joint.drive)(Vec3::Zero(), time);
    }
    for (std::size_t r = first; r < rows.size(); ++r) {
      const bool turns = rows[r].parts.front().second.template head<3>().isZero(0);
      rows[r].size = turns ? joint.size : 1;
    }
  }
  return rows;
}

template <int Dim>
Vec3 point_of_joint(const JointSet<Dim>& joints, int number, const JointedBodies& bodies) {
  const Joint& joint = joints.list[std::size_t(number)];
  if (joint.spec.kind == JointKind::gear) return point_of_joint(joints, joint.first, bodies);
  return bodies[std::size_t(joint.second)].pose.apply(joint.frames.second.anchor);
}

template <int Dim>
std::vector<JointReport> report_joints(const JointSet<Dim>& joints, const State<Dim>& state) {
  std::vector<JointReport> reports;
  const std::vector<JointState>& states = state.joints;
  if (states.empty()) return reports;
  const JointedBodies bodies = jointed_bodies(joints, state.solids, state.time);
  for (std::size_t j = 0; j < states.size(); ++j) {
    const JointState& s = states[j];
    reports.push_back({joints.list[j].spec.name, s.shown_q, s.rate, s.force, s.torque,
                       point_of_joint(joints, int(j), bodies), s.power, s.gap, s.broken});
  }
  return reports;
}

double largest_gap(const std::vector<JointState>& states) {
  double largest = 0;
  for (const JointState& joint : states) largest = std::max(largest, joint.gap);
  return largest;
}

std::string note_on_break(const JointReport& joint, std::int64_t step, double time) {
  return fmt::format("step {} at time {:.6g} s: joint '{}' breaks under {:.4g} N and {:.4g} N m", step, time,
                     joint.name, joint.force.norm(), joint.torque.norm());
}

template <int Dim>
int most_overloaded(const JointSet<Dim>& joints, const std::vector<JointState>& states) {
  int found = -1;
  double most = 1;
  for (std::size_t j = 0; j < states.size(); ++j) {
    const std::optional<JointBreakSpec>& bears = joints.list[j].spec.breaks_at;
    if (!bears || states[j].broken) continue;
    const double load = std::max(bears->force ? states[j].force.norm() / *bears->force : 0,
                                 bears->torque ? states[j].torque.norm() / *bears->torque : 0);
    if (load > most) found = int(j), most = load;
  }
  return found;
}

#define SEICHE_INSTANTIATE(D)                                                                           \
  template struct JointSet<D>;                                                                          \
  template JointedBodies jointed_bodies<D>(const JointSet<D>&, const Participants<D>&, double);         \
  template std::vector<char> held_still<D>(const JointSet<D>&, const std::vector<Body<D>>&);            \
  template PlacedBody placed_patch<D>(const HeldPatch<D>&, const Eigen::VectorXd&);                     \
  template Vec3 point_of_joint<D>(const JointSet<D>&, int, const JointedBodies&);                       \
  template std::vector<JointReport> report_joints<D>(const JointSet<D>&, const State<D>&);              \
  template int most_overloaded<D>(const JointSet<D>&, const std::vector<JointState>&);                  \
  template bool has_coordinate<D>(const JointSet<D>&, int);                                             \
  template PlacedRow coordinate_of_joint<D>(const JointSet<D>&, int, const JointedBodies&, double);     \
  template std::vector<PlacedRow> constraints_of<D>(const JointSet<D>&, const std::vector<JointState>&, \
                                                    const JointedBodies&, const std::vector<double>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
