#include "coupling/solids/solid_coupling.h"

#include "coupling/solids/elastic_coupling.h"
#include "coupling/solids/rigid_coupling.h"
#include "coupling/thin/thin_weight.h"
#include "solid/body/enclosed_volume.h"

namespace seiche {
namespace {

template <int Dim>
int unknowns_of(const Body<Dim>& body) {
  return body.is_rigid() ? twist_size<Dim> : body.is_elastic() ? body.elastic().body.size() : 0;
}

template <int Dim>
SolidCoupling<Dim> number_unknowns(const Setup<Dim>& s) {
  SolidCoupling<Dim> c;
  for (std::size_t k = 0; k < s.bodies.size(); ++k) {
    const int n = unknowns_of(s.bodies[k]);
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

// Of rigid bodies.
template <int Dim>
void set_targets(const Setup<Dim>& s, double dt, SolidCoupling<Dim>& c) {
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    if (!s.bodies[c.bodies[b]].is_rigid()) continue;
    const int first = c.first[b], n = c.first[b + 1] - first;
    const Eigen::MatrixXd M = c.mass.block(first, first, n, n);
    c.target.segment(first, n) =
        c.free.segment(first, n) + dt * M.ldlt().solve(c.buoyancy_correction.segment(first, n));
    c.push.segment(first, n) = M * c.target.segment(first, n);
  }
}

}  // namespace

template <int Dim>
SolidCoupling<Dim> couple_solids(const Setup<Dim>& s, const StepGeometry<Dim>& g, const PressureRows<Dim>& rows,
                                 const NullSpace& closed, const State<Dim>& state, double dt, double horizon) {
  SolidCoupling<Dim> c = number_unknowns(s);
  CouplingParts<Dim> parts{c, {}};
  couple_rigid_bodies(s, g, rows, state, dt, horizon, parts);
  couple_elastic_bodies(s, g, rows, closed, state, dt, horizon, parts);
  for (BlockColumns* J : {&c.J, &c.J_held})
    for (ColumnBlock& block : J->blocks)
      for (double& flux : block.value) flux *= s.tampering.solid_flux;
  c.mass.resize(c.size(), c.size());
  c.mass.setFromTriplets(parts.mass.begin(), parts.mass.end());
  make_identical(c.buoyancy_correction, s.ranks);
  set_targets(s, dt, c);
  return c;
}

template <int Dim>
void set_velocities(const Setup<Dim>& s, const SolidCoupling<Dim>& c, const Eigen::VectorXd& v, StepGeometry<Dim>& g,
                    State<Dim>& state) {
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    const int k = c.bodies[b], first = c.first[b];
    if (s.bodies[k].is_rigid()) {
      set_rigid_velocity(s, c, k, first, v, g, state.rigid[k]);
    } else {
      state.elastic[k].velocity = v.segment(first, c.first[b + 1] - first);
      set_node_velocity(s.layout, k, state.elastic[k].velocity, g);
      state.elastic[k].extra_load =
          total_load(s.bodies[k].elastic(), state.elastic[k].state.u,
                     Eigen::VectorXd(c.buoyancy_correction.segment(first, c.first[b + 1] - first)));
      state.elastic[k].kept_volume.setConstant(std::numeric_limits<double>::quiet_NaN());
      state.elastic[k].cavity = state.elastic[k].kept_volume;
    }
  }
  for (std::size_t n = 0; n < c.swept.size(); ++n)
    for (const WallPatch<Dim>& wall : c.swept[n].walls) {
      ElasticMotion& motion = state.elastic[std::size_t(wall.body)];
      motion.cavity[wall.patch] = double(n);
      motion.kept_volume[wall.patch] = c.swept[n].volume;
    }
}

template <int Dim>
void set_reactions(const Setup<Dim>& s, const SolidCoupling<Dim>& c, const Eigen::VectorXd& reactions,
                   State<Dim>& state) {
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    const int k = c.bodies[b], first = c.first[b];
    if (!s.bodies[k].is_elastic()) continue;
    const Eigen::VectorXd forces = reactions.segment(first, c.first[b + 1] - first);
    state.elastic[k].reaction = total_load(s.bodies[k].elastic(), state.elastic[k].state.u, forces);
  }
}

template <int Dim>
void set_held_velocities(const Setup<Dim>& s, const SolidCoupling<Dim>& c, StepGeometry<Dim>& g) {
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    if (!s.bodies[c.bodies[b]].is_elastic()) continue;
    g.cell_fluxes[c.bodies[b]] = c.cell_fluxes[b];
    set_node_velocity(s.layout, c.bodies[b], c.held.segment(c.first[b], c.first[b + 1] - c.first[b]), g);
  }
}

template <int Dim>
Eigen::VectorXd velocities_over(const Setup<Dim>& s, const State<Dim>& state, double dt) {
  std::vector<double> all;
  const auto elastic = elastic_velocities_over(s.bodies, state.elastic, state.time, dt, state.horizon);
  for (std::size_t k = 0; k < s.bodies.size(); ++k) {
    if (s.bodies[k].is_rigid()) {
      const auto v = stacked<Dim>(state.rigid[k].velocity, state.rigid[k].angular_velocity);
      all.insert(all.end(), v.begin(), v.end());
    } else if (s.bodies[k].is_elastic()) {
      all.insert(all.end(), elastic[k].begin(), elastic[k].end());
    }
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template SolidCoupling<D> couple_solids<D>(const Setup<D>&, const StepGeometry<D>&, const PressureRows<D>&,         \
                                             const NullSpace&, const State<D>&, double, double);                      \
  template void set_velocities<D>(const Setup<D>&, const SolidCoupling<D>&, const Eigen::VectorXd&, StepGeometry<D>&, \
                                  State<D>&);                                                                         \
  template void set_reactions<D>(const Setup<D>&, const SolidCoupling<D>&, const Eigen::VectorXd&, State<D>&);        \
  template void set_held_velocities<D>(const Setup<D>&, const SolidCoupling<D>&, StepGeometry<D>&);                   \
  template Eigen::VectorXd velocities_over<D>(const Setup<D>&, const State<D>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
