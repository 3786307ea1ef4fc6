#include "coupling/solve/flow_at_walls.h"

#include <algorithm>
#include <cmath>

#include "coupling/transport/restore.h"
#include "grid/loops.h"

namespace seiche {
namespace {

constexpr int most_solves = 8;               // an error of the flow returns as a tenth of it
constexpr double sudden = 1, settled = 0.1;  // shares of the velocities in the end; from rest they change by 1
constexpr double still = 1e-6;               // cells in a step: at rest velocities are noise

template <int Dim>
bool sticks(const Body<Dim>& body) {
  return body.spec().slip == Slip::no_slip;
}

template <int Dim>
FlowAtWalls<Dim> flow_at_walls(const Setup<Dim>& s, const State<Dim>& state, const Participants<Dim>& solids,
                               const StepGeometry<Dim>& geometry) {
  return {state.exterior->joined_level(s.domain, s.fluids, state), motions_at_walls(solids, geometry)};
}

}  // namespace

template <int Dim>
std::vector<RigidField> motions_at_walls(const Participants<Dim>& solids, const StepGeometry<Dim>& geometry) {
  std::vector<RigidField> motions;
  for (std::size_t k = 0; k < solids.size(); ++k) motions.push_back(solids[k].viscous_motion(geometry));
  return motions;
}

template <int Dim>
FlowAtWallsIteration<Dim>::FlowAtWallsIteration(const Setup<Dim>& setup, const State<Dim>& before,
                                                const Participants<Dim>& solids, const StepGeometry<Dim>& geometry)
    : setup_(setup), geometry_(geometry) {
  const auto& bodies = setup.solids.bodies;
  if (setup.fluids.is_viscous() && std::any_of(bodies.begin(), bodies.end(), sticks<Dim>))
    last_ = flow_at_walls(setup, before, solids, geometry);
}

// True beside a face that a no-slip solid cuts: the one nearest to the face's first corner.
template <int Dim>
bool FlowAtWallsIteration<Dim>::is_beside_cut_wall(int axis, Site f) const {
  const int k = geometry_.body[f];
  if (k < 0 || !sticks(setup_.solids.bodies[std::size_t(k)])) return false;
  for (int b = 0; b < Dim; ++b)
    for (const Site g : {f - setup_.domain.layout.stride(b), f + setup_.domain.layout.stride(b)})
      if (const double open = geometry_.faces.open.at(axis, g); open > 0 && open < 1) return true;
  return false;
}

// sum |u' - u'_last| > share * sum |u'|, u' relative to the solid
template <int Dim>
std::optional<FlowAtWalls<Dim>> FlowAtWallsIteration<Dim>::due_after(const State<Dim>& solved) {
  if (!last_.flow || solves_ >= most_solves) return {};
  const Layout<Dim>& layout = setup_.domain.layout;
  const FlowAtWalls<Dim> now = flow_at_walls(setup_, solved, solved.solids, geometry_);
  const double share = solves_ > 0 ? settled : sudden, noise = still * layout.h() / solved.dt_now;
  double excess = 0;
  for (int a = 0; a < Dim; ++a)
    excess += local_sum(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (!is_solved(now.flow->valid.at(a, f)) || !is_beside_cut_wall(a, f)) return 0.0;
      const Vec3 x = extend<Dim>(layout.position(i, face_offset<Dim>(a)));
      const auto relative = [&](const FlowAtWalls<Dim>& at) {
        return at.flow->u.at(a, f) - at.motion[std::size_t(geometry_.body[f])].at(x)[a];
      };
      const double u = relative(now);
      return std::abs(u - relative(last_)) - share * std::max(noise, std::abs(u));
    });
  last_ = now;
  if (setup_.domain.ranks.global_sum(excess) <= 0) return {};
  ++solves_;
  return now;
}

template std::vector<RigidField> motions_at_walls<2>(const Participants<2>&, const StepGeometry<2>&);
template std::vector<RigidField> motions_at_walls<3>(const Participants<3>&, const StepGeometry<3>&);
template class FlowAtWallsIteration<2>;
template class FlowAtWallsIteration<3>;

}  // namespace seiche
