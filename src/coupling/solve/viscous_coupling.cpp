#include "coupling/solve/viscous_coupling.h"

#include <unordered_map>

#include "base/error.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/liquid_viscosity.h"
#include "coupling/transport/two_fluids.h"
#include "fluid/rheology/rheology.h"
#include "fluid/viscosity/no_slip_flux.h"
#include "grid/loops.h"
#include "solid/body/elastic_motion.h"

namespace seiche {
namespace {

// Weights of an elastic body's unknowns in the velocity of its surface near a face.
template <int Dim>
auto surface_weights(const StepGeometry<Dim>& g, int body) {
  auto place = std::make_shared<std::array<std::unordered_map<Site, std::size_t>, Dim>>();
  const FaceShares& shares = *g.shares[std::size_t(body)];
  for (std::size_t n = 0; n < shares.size(); ++n) (*place)[std::size_t(shares[n].axis)][shares[n].face] = n;
  const auto attached = g.attached[std::size_t(body)];
  return [place, attached](int axis, Site face, std::vector<std::pair<int, double>>& weights) {
    weights.clear();
    const auto found = (*place)[std::size_t(axis)].find(face);
    if (found == (*place)[std::size_t(axis)].end()) return;
    for (const auto& [node, weight] : (*attached)[found->second])
      if (weight != 0) weights.emplace_back(Dim * node + axis, weight);
  };
}

template <int Dim>
ViscousSolid<Dim> viscous_solid(const Setup<Dim>& s, const StepGeometry<Dim>& g, const State<Dim>& state, int k) {
  const Body<Dim>& body = s.bodies[std::size_t(k)];
  ViscousSolid<Dim> solid;
  solid.no_slip = body.spec().slip == Slip::no_slip;
  if (body.is_rigid()) {
    solid.rigid = true;
    solid.frame.center = state.rigid[std::size_t(k)].center;
  } else if (body.is_elastic()) {
    const ElasticMotion& m = state.elastic[std::size_t(k)];
    const BodyAverage mean = average(body.elastic().body, m.state.u, m.velocity);
    solid.frame = {mean.velocity, mean.angular_velocity, mean.center};
    solid.surface = surface_weights(g, k);
  } else {
    const Twist& v = g.placed[std::size_t(k)].twist;
    solid.frame = {v.linear, v.angular, v.about};
  }
  return solid;
}

template <int Dim>
std::vector<ViscousSolid<Dim>> make_solids(const Setup<Dim>& s, const StepGeometry<Dim>& g, const State<Dim>& state,
                                           const SolidCoupling<Dim>& coupling) {
  std::vector<ViscousSolid<Dim>> solids;
  for (std::size_t k = 0; k < s.bodies.size(); ++k) solids.push_back(viscous_solid(s, g, state, int(k)));
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b)
    solids[std::size_t(coupling.bodies[b])].first_unknown = coupling.first[b];
  return solids;
}

BlockColumns scaled(BlockColumns J, double by) {
  for (ColumnBlock& block : J.blocks)
    for (double& x : block.value) x *= by;
  return J;
}

// The mean of the cells around an edge, one cell around the owned ones.
template <int Dim>
EdgeField<Dim> mean_at_edges(const Layout<Dim>& layout, const CellField<Dim>& mu) {
  EdgeField<Dim> edge(layout);
  for_each_site(layout, layout.grown(1), [&](Site c) {
    for (int p = 0; p < planes<Dim>; ++p) {
      const auto [a, b] = plane_axes<Dim>(p);
      const Site da = layout.stride(a), db = layout.stride(b);
      edge[p][std::size_t(c)] = 0.25 * (mu[c] + mu[c - da] + mu[c - db] + mu[c - da - db]);
    }
  });
  return edge;
}

// `largest` is meant for the liquid's density: gas counts by its kinematic viscosity.
template <int Dim>
void take_in_gas(const Setup<Dim>& s, const CellField<Dim>& phi, ViscosityField<Dim>& mu) {
  const double gas = s.scene.gas.viscosity;
  mu.largest = std::max(mu.largest, gas * s.density() / s.gas_density());
  mu.uniform = mu.uniform && mu.value[s.layout.site(s.layout.cells().lower)] == gas;
  if (mu.uniform) return;
  if (!mu.edge) mu.edge = mean_at_edges(s.layout, mu.value);
  mix_gas_viscosity(s, phi, mu.value, *mu.edge);
}

// Beside solids that liquid sticks to and moves the split is noisy: it fed jets of 10 m/s beside an elastic one where
// the coupled solve has 0.02 (validation/fsi1), and a sphere's speed jumped by 3 % from step to step
// (validation/falling_sphere_re11p6).
template <int Dim>
bool sticks_to_what_it_moves(const Setup<Dim>& s) {
  return std::any_of(s.bodies.begin(), s.bodies.end(), [](const Body<Dim>& b) {
    return b.kind().is_free() && b.spec().slip == Slip::no_slip;
  });
}

}  // namespace

template <int Dim>
ViscosityField<Dim> measure_viscosity(const Setup<Dim>& s, const CellField<Dim>& phi, const Level<Dim>& flow,
                                      double t) {
  ViscosityField<Dim> mu{CellField<Dim>(s.layout), 0, false};
  const std::string fault = first_text(s.ranks, set_liquid_viscosity(s, flow.u, flow.valid, t, mu.value));
  if (!fault.empty()) throw Error(ExitCode::cannot_continue, fault);
  for_each_site(s.layout, s.layout.padded(), [&](Site c) { mu.value[c] *= s.tampering.viscosity; });
  const LiquidSpec& liquid = s.scene.liquid;
  mu.uniform = liquid.rheology.model.empty() && Expression(liquid.viscosity).is_constant();
  const double largest = local_max(s.layout, s.layout.cells(), 0, [&](Site c) { return phi[c] < 0 ? mu.value[c] : 0; });
  mu.largest = s.ranks.global_max(largest);
  if (!liquid.rheology.model.empty()) {
    mu.edge.emplace(s.layout);
    set_edge_viscosity(s.layout, rheology_of(s), flow.u, flow.valid, *mu.edge);
  }
  if (s.has_gas()) take_in_gas(s, phi, mu);
  return mu;
}

template <int Dim>
ViscousRoute choose_route(const Setup<Dim>& s, const ViscosityField<Dim>& mu, double dt) {
  constexpr double reaches_a_cell = 0.5;
  const ViscousSolve asked = s.scene.solver.viscosity;
  if (asked != ViscousSolve::automatic)
    return asked == ViscousSolve::split ? ViscousRoute::split : ViscousRoute::coupled;
  if (sticks_to_what_it_moves(s)) return ViscousRoute::coupled;
  const double reach = mu.largest * dt / (s.density() * s.layout.h() * s.layout.h());
  return reach < reaches_a_cell ? ViscousRoute::split : ViscousRoute::coupled;
}

template <int Dim>
ViscousStep<Dim>::ViscousStep(const Setup<Dim>& s, const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                              const StepGeometry<Dim>& g, const State<Dim>& state, const SolidCoupling<Dim>& coupling,
                              const ViscosityField<Dim>& mu, const FaceField<Dim>& u_star)
    : setup_(s),
      geometry_(g),
      coupling_(coupling),
      rows_(rows),
      solids_(make_solids(s, g, state, coupling)),
      full_(s.layout, -s.band()),
      input_{.layout = s.layout,
             .halo = s.halo,
             .ranks = s.ranks,
             .sides = s.sides,
             .phi = in.has_gas() ? full_ : in.phi,
             .faces = in.faces,
             .psi = g.psi,
             .body = g.body,
             .solids = solids_,
             .unknowns = coupling.size(),
             .viscosity = mu.value,
             .uniform_viscosity = mu.uniform,
             .density = in.density,
             .dt = in.dt,
             .time = state.time,
             .u_star = u_star,
             .projection = in,
             .rows = rows,
             .edge_viscosity = mu.edge ? &*mu.edge : nullptr},
      system_(assemble_viscosity(input_)),
      J_(scaled(coupling.J, s.layout.geometry().face_area())),
      J_held_(scaled(coupling.J_held, s.layout.geometry().face_area())) {
  separate_held();
  for (std::size_t k = 0; k < s.bodies.size(); ++k) {
    const RigidState& r = state.rigid[k];
    motion_.push_back(s.bodies[k].is_rigid() ? RigidField{r.velocity, r.angular_velocity, r.center} : solids_[k].frame);
  }
}

template <int Dim>
void ViscousStep<Dim>::add_wall_flux(const FaceField<Dim>& flow, FaceField<Dim>& closed_flux) {
  const Layout<Dim>& layout = setup_.layout;
  FaceField<Dim> added(layout);
  add_no_slip_flux(input_, *system_.samples, motion_, flow, added);
  for (int a = 0; a < Dim; ++a)
    for_each_site(layout, layout.grown(1), [&](Site f) { closed_flux.at(a, f) += added.at(a, f); });
  const auto net = net_over_rows(
      layout, setup_.ranks, rows_, [](Site) { return 0.0; }, [&](int a, Site f) { return added.at(a, f); });
  for (std::size_t n = 0; n < net.size(); ++n) system_.q[n] -= net[n] * layout.geometry().face_area();
}

// Held velocities v_h are known: f <- f - G v_h. Their columns move from G to G_held.
template <int Dim>
void ViscousStep<Dim>::separate_held() {
  int first = 0;
  for (ColumnBlock& block : system_.G.blocks) {
    ColumnBlock free, held;
    free.width = held.width = block.width;
    free.loads = block.loads;
    block.for_each([&](int row, int column, double value) {
      const auto i = std::size_t(first + column);
      const bool is_held = coupling_.freedom[i] == Freedom::fixed;
      if (is_held) system_.f[std::size_t(row)] -= value * coupling_.held[Eigen::Index(i)];
      (is_held ? held : free).add(row, column, value);
    });
    first += block.width;
    block = std::move(free);
    G_held_.blocks.push_back(std::move(held));
  }
}

template <int Dim>
Vector ViscousStep<Dim>::gather(const FaceField<Dim>& u) const {
  Vector rows;
  for (const auto& [axis, face] : system_.rows.faces) rows.push_back(u.at(axis, face));
  return rows;
}

template <int Dim>
void ViscousStep<Dim>::scatter(const Vector& rows, FaceField<Dim>& u) const {
  for (std::size_t n = 0; n < rows.size(); ++n)
    u.at(system_.rows.faces[n].first, system_.rows.faces[n].second) = rows[n];
}

// About the points that solids.csv reports.
template <int Dim>
std::vector<ViscousLoad> ViscousStep<Dim>::loads(const FaceField<Dim>& u, const Eigen::VectorXd& v) const {
  std::vector<Vec3> about;
  for (std::size_t k = 0; k < setup_.bodies.size(); ++k)
    about.push_back(geometry_.placed[k].pose.apply(setup_.bodies[k].reference_point()));
  return viscous_forces(input_, system_, u, v, about);
}

template <int Dim>
double ViscousStep<Dim>::dissipation(const FaceField<Dim>& u, const Eigen::VectorXd& v) const {
  return viscous_dissipation(input_, system_, u, v);
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template ViscosityField<D> measure_viscosity<D>(const Setup<D>&, const CellField<D>&, const Level<D>&, double); \
  template ViscousRoute choose_route<D>(const Setup<D>&, const ViscosityField<D>&, double);                       \
  template class ViscousStep<D>;
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
