#pragma once
// The joints of a scene: their constraints and coordinates in given places of the solids.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expression.h"
#include "coupling/state/joint_state.h"
#include "coupling/state/participant.h"
#include "solid/joint/patch.h"

namespace seiche {

struct Scene;

struct Joint {
  JointSpec spec;
  JointFrames frames;
  int first = -1, second = -1;                                            // places in JointedBodies; of a gear: joints
  std::array<int, 2> solids{-1, -1};                                      // -1: the world
  std::shared_ptr<const Expression> drive = {}, speed = {}, target = {};  // of t; null: none
  double unit = 1;        // of drive, target, limits and rest in the scene: rad, or m
  double q_at_start = 0;  // rad or m
  double size = 0;        // of its larger body, m: turns of it count as lengths
};

// The patch of an elastic solid that a joint holds.
template <int Dim>
struct HeldPatch {
  int solid;
  JointPatch<Dim> patch;
};

template <int Dim>
struct JointSet {
  std::vector<Joint> list;
  int solids = 0;                       // number of the scene's solids
  std::vector<HeldPatch<Dim>> patches;  // in JointedBodies after the solids and the world

  JointSet() = default;
  // Throws Error(bad_input): a region does not fit its solid.
  JointSet(const Scene& scene, const std::vector<Body<Dim>>& bodies);
  // Solids of pairs that must not touch each other, since a joint holds them. Each ascending.
  std::vector<std::array<int, 2>> pairs_apart() const;
  // Names of the joints that have a gap above the tolerance, for messages.
  std::string names_of(const std::vector<int>& joints) const;
};

// 1 for the rigid solids that joints hold where they are: welds, and drives that stay 0, to what stands still.
template <int Dim>
std::vector<char> held_still(const JointSet<Dim>& joints, const std::vector<Body<Dim>>& bodies);

// A body of joints: a solid, the world or a patch, and its velocity (v, w) per unit of each unknown of the solid.
struct PlacedBody : JointedBody {
  using Rate = Eigen::Matrix<double, 6, 1>;
  int solid = -1;  // -1: the world
  std::vector<std::pair<int, Rate>> rates = {};
};

// All solids, the world, the patches.
using JointedBodies = std::vector<PlacedBody>;
template <int Dim>
JointedBodies jointed_bodies(const JointSet<Dim>& joints, const Participants<Dim>& solids, double time);
// A patch at displacements u of its solid.
template <int Dim>
PlacedBody placed_patch(const HeldPatch<Dim>& held, const Eigen::VectorXd& u);

// The places that a row acts on and its parts there: two, or four of a gear.
class RowParts {
 public:
  using Part = std::pair<int, PlacedBody::Rate>;
  RowParts() = default;
  RowParts(const Part& first, const Part& second) : parts_{first, second}, count_(2) {}
  void emplace_back(int place, const PlacedBody::Rate& rate) { parts_.at(count_++) = {place, rate}; }
  std::size_t size() const { return count_; }
  const Part& front() const { return parts_[0]; }
  Part& operator[](std::size_t n) { return parts_[n]; }
  const Part& operator[](std::size_t n) const { return parts_[n]; }
  Part* begin() { return parts_.data(); }
  Part* end() { return begin() + count_; }
  const Part* begin() const { return parts_.data(); }
  const Part* end() const { return begin() + count_; }

 private:
  std::array<Part, 4> parts_{};
  std::size_t count_ = 0;
};

// A row of JointRow over the places of JointedBodies that it acts on.
struct PlacedRow {
  using Rate = PlacedBody::Rate;
  int joint = 0;
  double value = 0, size = 1;  // m or rad; a gap is |value| * size, m
  bool drives = false;         // true: the coordinate of a drive
  RowParts parts;
  // Rate by the velocities (v, w) of the bodies.
  double rate(const std::vector<Rate>& velocities) const;
};

// Constraints of all joints that are not broken. `near`: each joint's coordinate within half a turn.
template <int Dim>
std::vector<PlacedRow> constraints_of(const JointSet<Dim>& joints, const std::vector<JointState>& states,
                                      const JointedBodies& bodies, const std::vector<double>& near, double time);

// The coordinate of a joint, with whole turns so that it lies within half a turn of `near`.
template <int Dim>
PlacedRow coordinate_of_joint(const JointSet<Dim>& joints, int joint, const JointedBodies& bodies, double near);
// Place of a joint, m; a gear has that of its first joint.
template <int Dim>
Vec3 point_of_joint(const JointSet<Dim>& joints, int joint, const JointedBodies& bodies);

// Rows of joints.csv, with the solids where they are shown.
template <int Dim>
std::vector<JointReport> report_joints(const JointSet<Dim>& joints, const State<Dim>& state);
double largest_gap(const std::vector<JointState>& states);  // m
// Line for the log on a joint that breaks.
std::string note_on_break(const JointReport& joint, std::int64_t step, double time);

// The joint whose load exceeds what it bears by the largest factor; -1: none.
template <int Dim>
int most_overloaded(const JointSet<Dim>& joints, const std::vector<JointState>& states);

template <int Dim>
bool has_coordinate(const JointSet<Dim>& joints, int joint);

}  // namespace seiche
