#include "coupling/solve/viscous_coupling.h"

#include "base/error.h"
#include "coupling/state/fluids.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/liquid_viscosity.h"
#include "fluid/boundary/domain.h"
#include "fluid/rheology/rheology.h"
#include "fluid/viscosity/no_slip_flux.h"
#include "grid/loops.h"

namespace seiche {
namespace {

template <int Dim>
ViscousSolid<Dim> viscous_solid(const StepGeometry<Dim>& g, const Participant<Dim>& participant) {
  ViscousSolid<Dim> solid;
  solid.no_slip = participant.body().spec().slip == Slip::no_slip;
  participant.describe_viscous(g, solid);
  return solid;
}

template <int Dim>
std::vector<ViscousSolid<Dim>> make_solids(const StepGeometry<Dim>& g, const Participants<Dim>& participants,
                                           const SolidCoupling<Dim>& coupling) {
  std::vector<ViscousSolid<Dim>> solids;
  for (std::size_t k = 0; k < participants.size(); ++k) solids.push_back(viscous_solid(g, participants[k]));
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b)
    solids[std::size_t(coupling.bodies[b])].first_unknown = coupling.first[b];
  return solids;
}

BlockColumns scaled(BlockColumns J, double by) {
  for (ColumnBlock& block : J.blocks)
    for (double& x : block.value) x *= by;
  return J;
}

// The split route is noisy beside free no-slip solids. Beside an elastic one it caused jets of 10 m/s where the coupled
// solve has 0.02 (validation/fsi1). A sphere's speed jumped by 3 % from step to step
// (validation/falling_sphere_re11p6).
template <int Dim>
bool sticks_to_what_it_moves(const Solids<Dim>& solids) {
  return std::any_of(solids.bodies.begin(), solids.bodies.end(),
                     [](const Body<Dim>& b) { return b.is_free() && b.spec().slip == Slip::no_slip; });
}

}  // namespace

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

template <int Dim>
ViscosityField<Dim> measure_viscosity(const Domain<Dim>& domain, const Fluids& fluids,
                                      const OperatorPerturbation& perturbation, const State<Dim>& state,
                                      const TimeLevel<Dim>& flow) {
  ViscosityField<Dim> mu{CellField<Dim>(domain.layout), 0, false};
  const std::string fault =
      first_text(domain.ranks, set_liquid_viscosity(domain, fluids, flow.u, flow.valid, state.time, mu.value));
  if (!fault.empty()) throw Error(ExitCode::cannot_continue, fault);
  for_each_site(domain.layout, domain.layout.padded(), [&](Site c) { mu.value[c] *= perturbation.viscosity; });
  const LiquidSpec& liquid = fluids.liquid;
  mu.uniform = fluids.constant_viscosity().has_value();
  const double largest =
      local_max(domain.layout, domain.layout.cells(), 0, [&](Site c) { return state.phi[c] < 0 ? mu.value[c] : 0; });
  mu.largest = domain.ranks.global_max(largest);
  if (!liquid.rheology.model.empty()) {
    mu.edge.emplace(domain.layout);
    set_edge_viscosity(domain.layout, fluids.rheology, flow.u, flow.valid, *mu.edge);
  }
  state.exterior->add_viscosity(domain, fluids, state.phi, mu);
  return mu;
}

template <int Dim>
ViscousRoute choose_route(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                          const BlockColumns& J, ViscousSolve asked, const ViscosityField<Dim>& mu, double dt) {
  constexpr double reaches_a_cell = 0.5;
  if (asked != ViscousSolve::automatic)
    return asked == ViscousSolve::split ? ViscousRoute::split : ViscousRoute::coupled;
  if (sticks_to_what_it_moves(solids) || J.any_deforms()) return ViscousRoute::coupled;
  const double reach = mu.largest * dt / (fluids.density() * domain.layout.h() * domain.layout.h());
  return reach < reaches_a_cell ? ViscousRoute::split : ViscousRoute::coupled;
}

template <int Dim>
ViscousStep<Dim>::ViscousStep(const Domain<Dim>& domain, const Solids<Dim>& all, const ProjectionInput<Dim>& in,
                              const PressureRows<Dim>& rows, const StepGeometry<Dim>& g, const State<Dim>& state,
                              const SolidCoupling<Dim>& coupling, const ViscosityField<Dim>& mu,
                              const FaceField<Dim>& u_star)
    : domain_(domain),
      all_(all),
      geometry_(g),
      coupling_(coupling),
      rows_(rows),
      solids_(make_solids(g, state.solids, coupling)),
      full_(domain.layout, -domain.band()),
      input_{.layout = domain.layout,
             .halo = domain.halo,
             .ranks = domain.ranks,
             .sides = domain.sides,
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
      J_(scaled(coupling.J, domain.layout.geometry().face_area())),
      J_held_(scaled(coupling.J_held, domain.layout.geometry().face_area())) {
  separate_held();
}

template <int Dim>
void ViscousStep<Dim>::add_wall_flux(const FaceField<Dim>& flow, const std::vector<RigidField>& motion,
                                     PagedFaceField<Dim>& closed_flux) {
  const Layout<Dim>& layout = domain_.layout;
  FaceField<Dim> added(layout);
  add_no_slip_flux(input_, *system_.samples, motion, flow, added);
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(layout, layout.grown(1), [&](Site f, const IVec<Dim>&) {
      if (added.at(a, f) != 0) closed_flux.add(a, f, added.at(a, f));
    });
  const auto net = net_over_rows(
      layout, domain_.ranks, rows_, [](Site) { return 0.0; }, [&](int a, Site f) { return added.at(a, f); });
  for (std::size_t n = 0; n < net.size(); ++n) system_.q[n] -= net[n] * layout.geometry().face_area();
}

// Velocities v_h of fixed unknowns are known: f <- f - G v_h. Their columns move from G to G_held.
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

// Torques are about the points that solids.csv reports.
template <int Dim>
std::vector<SolidLoad> ViscousStep<Dim>::loads(const FaceField<Dim>& u, const Eigen::VectorXd& v) const {
  std::vector<Vec3> about;
  for (std::size_t k = 0; k < all_.bodies.size(); ++k)
    about.push_back(geometry_.placed[k].pose.apply(all_.bodies[k].reference_point()));
  return viscous_forces(input_, system_, u, v, about);
}

template <int Dim>
ViscousPower ViscousStep<Dim>::power(const ViscousMotion<Dim>& strained, const ViscousMotion<Dim>& z,
                                     const ViscousMotion<Dim>& before) const {
  return viscous_power(input_, system_, strained, z, before);
}

template <int Dim>
void ViscousStep<Dim>::keep_samples_only() {
  auto samples = std::move(system_.samples);
  system_ = {};
  system_.samples = std::move(samples);
  J_ = G_held_ = J_held_ = {};
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template EdgeField<D> mean_at_edges<D>(const Layout<D>&, const CellField<D>&);                                \
  template ViscosityField<D> measure_viscosity<D>(const Domain<D>&, const Fluids&, const OperatorPerturbation&, \
                                                  const State<D>&, const TimeLevel<D>&);                        \
  template ViscousRoute choose_route<D>(const Domain<D>&, const Fluids&, const Solids<D>&, const BlockColumns&, \
                                        ViscousSolve, const ViscosityField<D>&, double);                        \
  template class ViscousStep<D>;
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
