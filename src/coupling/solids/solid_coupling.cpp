#include "coupling/solids/solid_coupling.h"

#include "coupling/solids/potential_sum.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {
namespace {

template <int Dim>
SolidCoupling<Dim> number_unknowns(const Participants<Dim>& solids) {
  SolidCoupling<Dim> c;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const int n = solids[k].unknowns();
    if (n == 0) continue;
    c.bodies.push_back(int(k));
    c.first.push_back(c.first.back() + n);
  }
  c.J.blocks.resize(c.bodies.size());
  for (std::size_t b = 0; b < c.bodies.size(); ++b) c.J_held.blocks.emplace_back().width = c.first[b + 1] - c.first[b];
  c.cell_fluxes.resize(c.bodies.size());
  c.freedom.assign(std::size_t(c.size()), Freedom::free);
  for (Eigen::VectorXd* v :
       {&c.push, &c.free, &c.target, &c.buoyancy_correction, &c.mass_beside, &c.momentum_beside, &c.held})
    v->setZero(c.size());
  return c;
}

// Calls visit(participant, block) for each participant with unknowns.
template <class Solids, int Dim, class Visit>
void for_each_block(Solids& solids, const SolidCoupling<Dim>& c, const Visit& visit) {
  for (std::size_t b = 0; b < c.bodies.size(); ++b) visit(solids[std::size_t(c.bodies[b])], int(b));
}

template <int Dim>
Eigen::VectorXd segment_of(const SolidCoupling<Dim>& c, const Eigen::VectorXd& all, int block) {
  const int first = c.first[std::size_t(block)];
  return all.segment(first, c.first[std::size_t(block) + 1] - first);
}

// Gathers inertia, columns of J and fixed unknowns of all participants and interactions. Collective.
template <int Dim>
void gather(const CoupledStep<Dim>& step, CouplingParts<Dim>& parts) {
  SolidCoupling<Dim>& c = parts.coupling;
  const Participants<Dim>& solids = step.state.solids;
  std::vector<std::size_t> first_sum;
  for_each_block(solids, c, [&](const Participant<Dim>& p, int b) {
    first_sum.push_back(parts.sums.size());
    p.couple(step, b, parts);
  });
  if (!parts.sums.empty()) step.setup.domain.ranks.global_sum(parts.sums);
  for_each_block(solids, c, [&](const Participant<Dim>& p, int b) {
    p.take_sums(step, b, parts.sums.data() + first_sum[std::size_t(b)], parts);
  });
  if (parts.missing.size() > 0) {
    step.setup.domain.ranks.global_sum(std::span(parts.missing.data(), std::size_t(parts.missing.size())));
    c.buoyancy_correction += parts.missing;
  }
  for (const auto& interaction : step.setup.solids.interactions) interaction->couple(step, parts);
  for_each_block(solids, c, [&](const Participant<Dim>& p, int b) { p.finish_columns(step, b, parts); });
}

}  // namespace

template <int Dim>
SolidCoupling<Dim> couple_solids(const Setup<Dim>& s, const StepGeometry<Dim>& g, const PressureRows<Dim>& rows,
                                 const NullSpace& closed, const State<Dim>& state, double dt, double horizon) {
  SolidCoupling<Dim> c = number_unknowns(state.solids);
  CouplingParts<Dim> parts{c};
  gather({s, g, rows, closed, state, dt, horizon}, parts);
  for (BlockColumns* J : {&c.J, &c.J_held})
    for (ColumnBlock& block : J->blocks)
      for (double& flux : block.value) flux *= s.perturbation.solid_flux;
  c.mass.resize(c.size(), c.size());
  c.mass.setFromTriplets(parts.mass.begin(), parts.mass.end());
  make_identical(c.buoyancy_correction, s.domain.ranks);
  for_each_block(state.solids, c, [&](const Participant<Dim>& p, int b) { p.set_target(dt, b, c); });
  for (const auto& interaction : s.solids.interactions)
    interaction->add_forces({s, g, rows, closed, state, dt, horizon}, parts);
  c.potential = sum_of(std::move(parts.potentials));
  return c;
}

template <int Dim>
void set_velocities(const Domain<Dim>& domain, const Solids<Dim>& solids, const SolidCoupling<Dim>& c,
                    const Eigen::VectorXd& v, double horizon, StepGeometry<Dim>& g, State<Dim>& state) {
  for_each_block(state.solids, c, [&](Participant<Dim>& p, int b) {
    p.take(c, b, segment_of(c, v, b), horizon);
    Placement moving = g.placed[std::size_t(p.index())];
    p.set_velocity(moving);
    set_motion(domain.layout, p.index(), moving, g);
  });
  for (const auto& interaction : solids.interactions) interaction->take(c, state);
}

template <int Dim>
void set_reactions(const SolidCoupling<Dim>& c, const Eigen::VectorXd& reactions, State<Dim>& state) {
  for_each_block(state.solids, c, [&](Participant<Dim>& p, int b) { p.take_reactions(segment_of(c, reactions, b)); });
}

template <int Dim>
void set_held_velocities(const Domain<Dim>& domain, const SolidCoupling<Dim>& c, StepGeometry<Dim>& g) {
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    const int k = c.bodies[b];
    if (!g.deforms(k)) continue;
    g.cell_fluxes[std::size_t(k)] = c.cell_fluxes[b];
    set_node_velocity(domain.layout, k, segment_of(c, c.held, int(b)), g);
  }
}

template <int Dim>
Eigen::VectorXd velocities_in(const SolidCoupling<Dim>& c, const State<Dim>& state) {
  Eigen::VectorXd v(c.size());
  for_each_block(state.solids, c, [&](const Participant<Dim>& p, int b) {
    v.segment(c.first[std::size_t(b)], p.unknowns()) = p.velocity();
  });
  return v;
}

template <int Dim>
std::vector<Eigen::VectorXd> each_velocity_over(const Solids<Dim>& solids, const State<Dim>& state, double dt) {
  std::vector<Eigen::VectorXd> each;
  for (std::size_t k = 0; k < state.solids.size(); ++k)
    each.push_back(state.solids[k].velocity_over(state.time, dt, state.horizon));
  for (const auto& interaction : solids.interactions) interaction->keep_over(state, dt, each);
  return each;
}

template <int Dim>
Eigen::VectorXd velocities_over(const Solids<Dim>& solids, const State<Dim>& state, double dt) {
  std::vector<double> all;
  for (const Eigen::VectorXd& v : each_velocity_over(solids, state, dt)) all.insert(all.end(), v.begin(), v.end());
  return Eigen::Map<const Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
}

#define SEICHE_INSTANTIATE(D)                                                                                          \
  template SolidCoupling<D> couple_solids<D>(const Setup<D>&, const StepGeometry<D>&, const PressureRows<D>&,          \
                                             const NullSpace&, const State<D>&, double, double);                       \
  template void set_velocities<D>(const Domain<D>&, const Solids<D>&, const SolidCoupling<D>&, const Eigen::VectorXd&, \
                                  double, StepGeometry<D>&, State<D>&);                                                \
  template void set_reactions<D>(const SolidCoupling<D>&, const Eigen::VectorXd&, State<D>&);                          \
  template void set_held_velocities<D>(const Domain<D>&, const SolidCoupling<D>&, StepGeometry<D>&);                   \
  template Eigen::VectorXd velocities_in<D>(const SolidCoupling<D>&, const State<D>&);                                 \
  template std::vector<Eigen::VectorXd> each_velocity_over<D>(const Solids<D>&, const State<D>&, double);              \
  template Eigen::VectorXd velocities_over<D>(const Solids<D>&, const State<D>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
