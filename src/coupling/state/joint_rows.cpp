#include "coupling/state/joint_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/scene.h"

namespace seiche {
namespace {

constexpr double circle = 2 * std::numbers::pi;

int index_of_solid(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.solids.size(); ++k)
    if (scene.solids[k].name == name) return int(k);
  return int(scene.solids.size());  // "world"
}

int index_of_joint(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.joints.size(); ++k)
    if (scene.joints[k].name == name) return int(k);
  return -1;
}

std::shared_ptr<const Expression> made(const std::optional<Formula>& text) {
  return text ? std::make_shared<const Expression>(*text) : nullptr;
}

template <int Dim>
double size_of(const std::vector<Body<Dim>>& bodies, int k) {
  return k >= 0 && k < int(bodies.size()) ? bodies[std::size_t(k)].radius() : 0;
}

template <int Dim>
PlacedRow placed_row(const Joint& joint, int number, const JointRow& row) {
  return {number, row.value, 1, false, {{joint.first, row.first}, {joint.second, row.second}}};
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
    joint.first = gear ? index_of_joint(scene, spec.between[0]) : index_of_solid(scene, spec.between[0]);
    joint.second = gear ? index_of_joint(scene, spec.between[1]) : index_of_solid(scene, spec.between[1]);
    if (spec.drive) joint.drive = made(spec.drive->degrees ? spec.drive->degrees : spec.drive->translate);
    if (spec.motor) joint.speed = made(spec.motor->speed), joint.target = made(spec.motor->target);
    if (coordinate_of(spec.kind) == JointCoordinate::turn) joint.unit = std::numbers::pi / 180;
    if (coordinate_of(spec.kind) == JointCoordinate::length) joint.q_at_start = joint.frames.length;
    if (!gear) joint.size = std::max(size_of(bodies, joint.first), size_of(bodies, joint.second));
  }
  for (Joint& joint : list)
    if (joint.spec.kind == JointKind::gear)
      joint.size = std::max(list[std::size_t(joint.first)].size, list[std::size_t(joint.second)].size);
}

template <int Dim>
std::vector<std::array<int, 2>> JointSet<Dim>::pairs_apart() const {
  std::vector<std::array<int, 2>> pairs;
  for (const Joint& joint : list)
    if (joint.spec.kind != JointKind::gear && !joint.spec.collide && std::max(joint.first, joint.second) < solids)
      pairs.push_back({std::min(joint.first, joint.second), std::max(joint.first, joint.second)});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template <int Dim>
std::string JointSet<Dim>::names_of(const std::vector<int>& joints) const {
  std::vector<std::string> names;
  for (const int j : joints) names.push_back("'" + list[std::size_t(j)].spec.name + "'");
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

template <int Dim>
JointedBodies jointed_bodies(const Participants<Dim>& solids, double time) {
  JointedBodies bodies;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const Pose pose = solids[k].place(time, time, time).pose;
    const RigidState* rigid = solids[k].rigid();
    bodies.push_back({pose, rigid ? rigid->center : Vec3(pose.pivot + pose.displacement)});
  }
  bodies.emplace_back();
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
std::vector<JointReport> report_joints(const JointSet<Dim>& joints, const std::vector<JointState>& states) {
  std::vector<JointReport> reports;
  for (std::size_t j = 0; j < states.size(); ++j) {
    const JointState& s = states[j];
    reports.push_back({joints.list[j].spec.name, s.shown_q, s.rate, s.force, s.torque, s.power, s.gap, s.broken});
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

#define SEICHE_INSTANTIATE(D)                                                                             \
  template struct JointSet<D>;                                                                            \
  template JointedBodies jointed_bodies<D>(const Participants<D>&, double);                               \
  template std::vector<JointReport> report_joints<D>(const JointSet<D>&, const std::vector<JointState>&); \
  template int most_overloaded<D>(const JointSet<D>&, const std::vector<JointState>&);                    \
  template bool has_coordinate<D>(const JointSet<D>&, int);                                               \
  template PlacedRow coordinate_of_joint<D>(const JointSet<D>&, int, const JointedBodies&, double);       \
  template std::vector<PlacedRow> constraints_of<D>(const JointSet<D>&, const std::vector<JointState>&,   \
                                                    const JointedBodies&, const std::vector<double>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
