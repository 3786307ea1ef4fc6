#include "coupling/state/joint_messages.h"

#include <algorithm>
#include <map>

namespace seiche {
namespace {

// Solids of a joint; -1 for all that forces do not move.
template <int Dim>
std::array<int, 2> linked_by(const Joint& joint, const Participants<Dim>& solids) {
  std::array<int, 2> ends = joint.solids;
  for (int& k : ends)
    if (k >= 0 && solids[std::size_t(k)].unknowns() == 0) k = -1;
  return ends;
}

// Joints of the shortest chain between the solids of joint `closing`, without it; empty: none. By breadth first.
template <int Dim>
std::vector<int> chain_around(const JointSet<Dim>& joints, const State<Dim>& state, int closing) {
  const auto [from, to] = linked_by(joints.list[std::size_t(closing)], state.solids);
  std::map<int, std::array<int, 2>> reached{{from, {-1, -1}}};  // by solid: the joint and the solid before it
  std::vector<int> front{from};
  while (!front.empty() && !reached.contains(to)) {
    std::vector<int> next;
    for (int j = 0; j < int(joints.list.size()); ++j) {
      const Joint& joint = joints.list[std::size_t(j)];
      if (j == closing || joint.spec.kind == JointKind::gear || state.joints[std::size_t(j)].broken) continue;
      const std::array<int, 2> ends = linked_by(joint, state.solids);
      for (const int side : {0, 1}) {
        const int here = ends[std::size_t(side)], there = ends[std::size_t(1 - side)];
        if (std::find(front.begin(), front.end(), here) == front.end()) continue;
        if (reached.try_emplace(there, std::array{j, here}).second) next.push_back(there);
      }
    }
    front = std::move(next);
  }
  std::vector<int> chain;
  for (int at = to; reached.contains(to) && at != from; at = reached.at(at)[1]) chain.push_back(reached.at(at)[0]);
  return chain;
}

}  // namespace

template <int Dim>
std::string names_of_loops(const JointSet<Dim>& joints, const State<Dim>& state, const std::vector<int>& open) {
  std::vector<int> all = open;
  for (const int j : open) {
    const Joint& joint = joints.list[std::size_t(j)];
    const bool gear = joint.spec.kind == JointKind::gear;
    const std::vector<int> others = gear ? std::vector<int>{joint.first, joint.second} : chain_around(joints, state, j);
    all.insert(all.end(), others.begin(), others.end());
  }
  std::sort(all.begin(), all.end());
  return joints.names_of(all);
}

template std::string names_of_loops<2>(const JointSet<2>&, const State<2>&, const std::vector<int>&);
template std::string names_of_loops<3>(const JointSet<3>&, const State<3>&, const std::vector<int>&);

}  // namespace seiche
