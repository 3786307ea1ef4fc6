// Probes: pressure and velocity at a point, surface height above it, front along x, displacement of an elastic solid,
// loads of a joint or of solids, liquid in a box or through a flat one.
#include "base/probe_spec.h"
#include "coupling/report/measures.h"
#include "coupling/report/pressure_beside_solids.h"
#include "coupling/report/region_probes.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "fluid/transport/advection.h"
#include "grid/ghosts.h"
#include "grid/interpolation.h"
#include "grid/loops.h"
#include "levelset/extrapolate.h"

namespace seiche {
namespace {

// The cell that holds x (points on the domain's upper sides belong to the last cells).
template <int Dim>
IVec<Dim> cell_of(const Layout<Dim>& layout, const Vec<Dim>& x) {
  IVec<Dim> i;
  for (int a = 0; a < Dim; ++a) {
    const double g = (x[a] - layout.geometry().lower[a]) / layout.h();
    i[a] = std::clamp(int(std::floor(g)), 0, layout.geometry().cells[a] - 1);
  }
  return i;
}

// True on the one rank whose owned cells hold x.
template <int Dim>
bool holds(const Layout<Dim>& layout, const Vec<Dim>& x) {
  return layout.cells().contains(cell_of(layout, x));
}

template <int Dim>
double level_set_at(const Domain<Dim>& domain, const State<Dim>& state, const Vec<Dim>& x) {
  return interpolate_linear<Dim>(domain.layout, state.phi.data(),
                                 index_coordinates<Dim>(domain.layout, x, cell_offset<Dim>()));
}

// True if x lies in a solid, deeper than half a cell. Points on the surface of a solid belong to the fluid beside it.
template <int Dim>
bool in_solid(const Layout<Dim>& layout, const StepGeometry<Dim>& g, const Vec<Dim>& x) {
  const Vec<Dim> at = index_coordinates<Dim>(layout, x, node_offset<Dim>());
  return interpolate_linear<Dim>(layout, g.psi.data(), at) < -0.5 * layout.h();
}

// True, on all ranks, if x lies in a fluid that flows.
template <int Dim>
bool is_wet(const Domain<Dim>& domain, const State<Dim>& state, const StepGeometry<Dim>& g, const Vec<Dim>& x) {
  return domain.ranks.any(holds(domain.layout, x) && !in_solid(domain.layout, g, x) &&
                          (state.exterior->flows() || level_set_at(domain, state, x) < 0));
}

// True, on all ranks, if there is a pressure at x: never before the first solve.
template <int Dim>
bool has_pressure(const Domain<Dim>& domain, const State<Dim>& state, const StepGeometry<Dim>& g, const Vec<Dim>& x) {
  if (state.step == 0) return false;
  return domain.ranks.any(holds(domain.layout, x) && !in_solid(domain.layout, g, x) &&
                          (level_set_at(domain, state, x) < 0 ||
                           state.exterior->has_pressure(domain.layout.site(cell_of(domain.layout, x)))));
}

// Pressure of the liquid or of what is beyond its surface, extrapolated linearly from its cells. Collective.
template <int Dim>
FieldValues<double> continued_pressure(const Domain<Dim>& domain, const State<Dim>& state, bool liquid) {
  FieldValues<double> p(state.pressure.data(), state.pressure.data() + domain.layout.size());
  FieldValues<char> known(p.size(), 0);
  for_each_site(domain.layout, domain.layout.cells(),
                [&](Site c) { known[c] = (state.phi[c] < 0) == liquid && p[c] != 0; });
  extrapolate(domain.layout, domain.halo, domain.layout.cells(), {2, 2}, p, known);
  extend_beyond_sides<Dim>(domain.layout, p.data(), cell_offset<Dim>(), all_sides<Dim>(Extension::linear));
  return p;
}

// Pressure of the fluid at x: a probe on a wall reads the value at the wall, one on a solid that of the solid's side.
template <int Dim>
double pressure_at(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& state,
                   const StepGeometry<Dim>& geometry, const Vec<Dim>& x, ProbeFields<Dim>& fields) {
  const bool in_liquid = domain.ranks.any(holds(domain.layout, x) && level_set_at(domain, state, x) < 0);
  if (const auto beside = pressure_beside_solids(domain, solids, state, geometry, x, in_liquid)) return *beside;
  std::optional<FieldValues<double>>& p = fields.pressure[in_liquid ? 1 : 0];
  if (!p) p = continued_pressure(domain, state, in_liquid);
  const Vec<Dim> g = index_coordinates<Dim>(domain.layout, x, cell_offset<Dim>());
  return domain.ranks.global_sum(holds(domain.layout, x) ? interpolate_linear<Dim>(domain.layout, p->data(), g) : 0.0);
}

// Farthest liquid along `axis` on the line through x: the last zero of phi, or the side of the domain if liquid reaches
// it. Empty: no liquid.
template <int Dim>
std::optional<double> farthest_liquid(const Domain<Dim>& domain, const State<Dim>& state, Vec<Dim> x, int axis,
                                      int direction) {
  const Geometry<Dim>& grid = domain.layout.geometry();
  const Box<Dim>& own = domain.layout.cells();
  double best = -std::numeric_limits<double>::infinity();
  for (int i = own.empty() ? 0 : own.lower[axis]; i < (own.empty() ? 0 : own.upper[axis]); ++i) {
    x[axis] = grid.lower[axis] + grid.h * (i + 0.5);
    if (!holds(domain.layout, x)) continue;
    const double here = level_set_at(domain, state, x);
    Vec<Dim> ahead = x;
    ahead[axis] += direction * grid.h;
    const bool last = direction > 0 ? i == grid.cells[axis] - 1 : i == 0;
    const double next = last ? here : level_set_at(domain, state, ahead);
    if (here >= 0) continue;
    const double reach = last ? 0.5 : next >= 0 ? here / (here - next) : 1;
    best = std::max(best, direction * (x[axis] + direction * reach * grid.h));
  }
  best = domain.ranks.global_max(best);
  if (!std::isfinite(best)) return {};
  return direction * best;
}

// Axis and sense opposite to gravity at t = 0; +y without gravity.
template <int Dim>
std::pair<int, int> upwards(const Fluids& fluids) {
  int axis = 1;
  const Vec<Dim> g = truncate<Dim>(fluids.gravity.at(0));
  if (g.norm() > 0) g.cwiseAbs().maxCoeff(&axis);
  return {axis, g[axis] > 0 ? -1 : 1};
}

// Largest x of liquid in the layer of cells on the floor; in the whole domain if gravity acts along x. Empty: no
// liquid.
template <int Dim>
std::optional<double> front(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  const Geometry<Dim>& grid = domain.layout.geometry();
  const auto [axis, sense] = upwards<Dim>(fluids);
  const int floor = sense > 0 ? 0 : grid.cells[axis] - 1;
  double best = -std::numeric_limits<double>::infinity();
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    if (state.phi[c] >= 0 || (axis != 0 && i[axis] != floor)) return;
    const double next = state.phi[c + domain.layout.stride(0)];
    const bool last = i[0] == grid.cells[0] - 1;
    const double reach = last ? 0.5 : next >= 0 ? state.phi[c] / (state.phi[c] - next) : 1;
    best = std::max(best, grid.lower[0] + grid.h * (i[0] + 0.5 + reach));
  });
  best = domain.ranks.global_max(best);
  if (!std::isfinite(best)) return {};
  return best;
}

template <int Dim>
std::size_t index_of(const Solids<Dim>& solids, const std::string& solid) {
  const auto named = [&](const Body<Dim>& b) { return b.spec().name == solid; };
  return std::size_t(std::find_if(solids.bodies.begin(), solids.bodies.end(), named) - solids.bodies.begin());
}

template <int Dim>
Vec3 displacement_of(const Solids<Dim>& solids, const MaterialPoint& point, const State<Dim>& state,
                     const ProbeSpec& probe) {
  const std::size_t k = index_of(solids, probe.solid);
  return extend<Dim>(interpolate<Dim>(solids.bodies[k].elastic().body.mesh, point,
                                      state.solids[k].place(state.time, state.time, state.time).displacement));
}

// Shown coordinate; loads and power are means of the last step.
template <int Dim>
void measure_joint(const Solids<Dim>& solids, const State<Dim>& state, const ProbeSpec& probe, ProbeSample& out) {
  const std::vector<JointReport> reports = report_joints(solids.joints, state);
  const JointReport& joint = *std::ranges::find(reports, probe.joint, &JointReport::name);
  out.vector = probe.quantity == JointQuantity::torque ? joint.torque : joint.force;
  out.value = probe.quantity == JointQuantity::power ? joint.power : joint.q;
}

}  // namespace

template <int Dim>
std::map<std::string, MaterialPoint> find_followed_points(const std::vector<ProbeSpec>& probes,
                                                          const Solids<Dim>& solids) {
  std::map<std::string, MaterialPoint> points;
  for (const ProbeSpec& probe : probes)
    if (probe.kind == ProbeKind::displacement)
      points[probe.name] = point_of_probe<Dim>(solids.bodies[index_of(solids, probe.solid)].elastic().body.mesh, probe);
  return points;
}

namespace {

// The flow on all faces. Collective.
template <int Dim>
const FaceField<Dim>& flow_of(const Setup<Dim>& s, const State<Dim>& state, ProbeFields<Dim>& fields) {
  if (!fields.flow) fields.flow = state.exterior->joined_level(s.domain, s.fluids, state);
  return fields.flow->u;
}

// Velocity at x, equal on all ranks; zero if nothing flows there. Collective.
template <int Dim>
Vec3 velocity_at(const Domain<Dim>& domain, const FaceField<Dim>& u, const Vec<Dim>& x, bool flows) {
  Vec3 v = Vec3::Zero();
  if (flows && holds(domain.layout, x)) v = extend<Dim>(sample_velocity<Dim>(domain.layout, u, x));
  domain.ranks.global_sum(std::span<double>(v.data(), 3));
  return v;
}

// Scalars of a point or a region; empty if there is nothing to measure. Collective.
template <int Dim>
std::optional<double> measure_scalar(const Setup<Dim>& s, const State<Dim>& state, const StepGeometry<Dim>& geometry,
                                     const ProbeSpec& probe, ProbeFields<Dim>& fields) {
  const Vec<Dim> x = truncate<Dim>(probe.position);
  const auto [up, sense] = upwards<Dim>(s.fluids);
  switch (probe.kind) {
    case ProbeKind::pressure:
      if (!has_pressure(s.domain, state, geometry, x)) return {};
      return pressure_at(s.domain, s.solids, state, geometry, x, fields);
    case ProbeKind::surface_height:
      return farthest_liquid(s.domain, state, x, up, sense);
    case ProbeKind::front:
      return front(s.domain, s.fluids, state);
    case ProbeKind::flux:
      return flux_through_box(s, state, geometry, flow_of(s, state, fields), probe);
    case ProbeKind::volume:
      return volume_in_box(s, state, geometry, probe);
    default:
      return {};
  }
}

}  // namespace

template <int Dim>
ProbeSample measure_probe(const Setup<Dim>& s, const State<Dim>& state, const StepGeometry<Dim>& geometry,
                          const std::vector<SolidState>& solids, const ProbeSpec& probe, ProbeFields<Dim>& fields) {
  ProbeSample out;
  out.name = probe.name;
  out.is_vector = probe.is_vector();
  if (probe.kind == ProbeKind::velocity) {
    const Vec<Dim> x = truncate<Dim>(probe.position);
    out.defined = is_wet(s.domain, state, geometry, x);
    out.vector = velocity_at(s.domain, flow_of(s, state, fields), x, out.defined);
  } else if (probe.kind == ProbeKind::displacement) {
    out.vector = displacement_of(s.solids, s.followed.at(probe.name), state, probe);
  } else if (probe.kind == ProbeKind::joint) {
    measure_joint(s.solids, state, probe, out);
  } else if (probe.sums_loads()) {
    out.vector = sum_of_loads(solids, probe);
  } else {
    const std::optional<double> found = measure_scalar(s, state, geometry, probe, fields);
    out.defined = found.has_value();
    out.value = found.value_or(0);
  }
  return out;
}

template std::map<std::string, MaterialPoint> find_followed_points<2>(const std::vector<ProbeSpec>&, const Solids<2>&);
template std::map<std::string, MaterialPoint> find_followed_points<3>(const std::vector<ProbeSpec>&, const Solids<3>&);
template ProbeSample measure_probe<2>(const Setup<2>&, const State<2>&, const StepGeometry<2>&,
                                      const std::vector<SolidState>&, const ProbeSpec&, ProbeFields<2>&);
template ProbeSample measure_probe<3>(const Setup<3>&, const State<3>&, const StepGeometry<3>&,
                                      const std::vector<SolidState>&, const ProbeSpec&, ProbeFields<3>&);

}  // namespace seiche
