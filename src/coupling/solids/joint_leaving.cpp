#include "coupling/solids/joint_leaving.h"

#include <fmt/format.h>

#include <optional>

#include "base/error.h"

namespace seiche {
namespace {

template <int Dim>
bool has_left(const Geometry<Dim>& g, const Participant<Dim>& solid) {
  const RigidState* r = solid.rigid();
  if (!r) return false;
  const double reach = solid.body().radius();
  for (int a = 0; a < Dim; ++a) {
    const double low = r->center[a] - g.lower[a], high = low - g.cells[a] * g.h;
    if (!g.periodic[a] && (low < -reach || high > reach)) return true;
  }
  return false;
}

struct LeavingJoint {
  const Joint& joint;
  std::string gone, holder;  // solids, or "world"
};

// The first joint, not broken, between a solid beyond the domain and something within.
template <int Dim>
std::optional<LeavingJoint> find_leaving(const JointSet<Dim>& joints, const Domain<Dim>& domain,
                                         const State<Dim>& state) {
  const auto left = [&](int k) { return k >= 0 && has_left(domain.layout.geometry(), state.solids[std::size_t(k)]); };
  for (std::size_t j = 0; j < joints.list.size(); ++j) {
    const Joint& joint = joints.list[j];
    if (joint.spec.kind == JointKind::gear || state.joints[j].broken) continue;
    const bool first = left(joint.solids[0]), second = left(joint.solids[1]);
    if (first != second)
      return LeavingJoint{joint, joint.spec.between[first ? 0 : 1], joint.spec.between[first ? 1 : 0]};
  }
  return {};
}

}  // namespace

template <int Dim>
void refuse_leaving(const JointSet<Dim>& joints, const Domain<Dim>& domain, const State<Dim>& state) {
  if (const auto found = find_leaving(joints, domain, state))
    throw Error(ExitCode::cannot_continue,
                fmt::format("solid '{}' has left the domain at t = {:.6g} s, but joint '{}' holds it to '{}'; enlarge "
                            "the domain, or let the joint break there (breaks_at)",
                            found->gone, state.time, found->joint.spec.name, found->holder));
}

template <int Dim>
void refuse_outside_at_start(const JointSet<Dim>& joints, const Domain<Dim>& domain, const State<Dim>& state) {
  if (const auto found = find_leaving(joints, domain, state))
    throw Error(ExitCode::bad_input,
                fmt::format("{}: joint '{}' holds solid '{}', which lies outside of the domain, to '{}'; move the "
                            "solid into the domain, or enlarge the domain",
                            found->joint.spec.where, found->joint.spec.name, found->gone, found->holder));
}

template void refuse_leaving<2>(const JointSet<2>&, const Domain<2>&, const State<2>&);
template void refuse_leaving<3>(const JointSet<3>&, const Domain<3>&, const State<3>&);
template void refuse_outside_at_start<2>(const JointSet<2>&, const Domain<2>&, const State<2>&);
template void refuse_outside_at_start<3>(const JointSet<3>&, const Domain<3>&, const State<3>&);

}  // namespace seiche
