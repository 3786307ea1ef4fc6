#include "coupling/solids/joint_leaving.h"

#include <fmt/format.h>

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

}  // namespace

template <int Dim>
void refuse_leaving(const JointSet<Dim>& joints, const Domain<Dim>& domain, const State<Dim>& state) {
  const auto left = [&](int k) { return k >= 0 && has_left(domain.layout.geometry(), state.solids[std::size_t(k)]); };
  for (std::size_t j = 0; j < joints.list.size(); ++j) {
    const Joint& joint = joints.list[j];
    if (joint.spec.kind == JointKind::gear || state.joints[j].broken) continue;
    const bool first = left(joint.solids[0]), second = left(joint.solids[1]);
    if (first == second) continue;
    const std::string& gone = joint.spec.between[first ? 0 : 1];
    throw Error(ExitCode::cannot_continue,
                fmt::format("solid '{}' has left the domain at t = {:.6g} s, but joint '{}' holds it to '{}'; enlarge "
                            "the domain, or let the joint break there (breaks_at)",
                            gone, state.time, joint.spec.name, joint.spec.between[first ? 1 : 0]));
  }
}

template void refuse_leaving<2>(const JointSet<2>&, const Domain<2>&, const State<2>&);
template void refuse_leaving<3>(const JointSet<3>&, const Domain<3>&, const State<3>&);

}  // namespace seiche
