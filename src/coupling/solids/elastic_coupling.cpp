#include "coupling/solids/elastic_coupling.h"

#include <algorithm>
#include <map>

#include "coupling/solids/face_columns.h"
#include "coupling/solids/facet_fluxes.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "coupling/thin/liquid_beside.h"
#include "fluid/boundary/domain.h"
#include "linalg/core/matrix_entries.h"
#include "solid/elastic/potential.h"
#include "solid/elastic/surface_patches.h"

namespace seiche {
namespace {

template <int Dim>
void add_entries(int row, double value, int axis, const SurfaceWeights& weights, std::vector<FluxEntry>& entries) {
  for (const auto& [node, weight] : weights) entries.push_back({row, Dim * node + axis, value * weight});
}

// Shares spread to the nodes that they hang on.
template <int Dim>
std::vector<FluxEntry> spread_shares(const Domain<Dim>& domain, const FaceShares& shares,
                                     const FaceWeights& face_weights, const PressureRows<Dim>& rows) {
  std::vector<FluxEntry> entries;
  for_each_cell_of_shares(domain, shares, rows, [&](Site cell, double sign, std::size_t n) {
    add_entries<Dim>(int(rows.row[cell] - rows.first), sign * shares[n].closed, shares[n].axis, face_weights[n],
                     entries);
  });
  return entries;
}

// The shares of one cell.
struct CellShares {
  std::vector<std::pair<std::size_t, double>> shares;  // and signs
};

// In a wall of a cavity a cell or two thick the nearest point to a face may be on the other side. All shares of a cell
// are to hang on the side that cuts its faces: the others move to where its nearest share hangs. What hangs on pinned
// facets between the sides stays.
template <int Dim>
void keep_to_own_side(const Domain<Dim>& domain, const ElasticSolid<Dim>& solid, const FaceShares& shares,
                      const FaceWeights& face_weights, const PressureRows<Dim>& rows, std::vector<FluxEntry>& entries) {
  if (solid.patches.size() == 1) return;
  const std::vector<int> patch_of_node = patches_of_nodes(solid);
  std::map<Site, CellShares> cells;
  for_each_cell_of_shares(domain, shares, rows,
                          [&](Site cell, double sign, std::size_t n) { cells[cell].shares.emplace_back(n, sign); });
  const auto patch = [&](std::size_t n) {
    int of = -1;
    for (const auto& [node, weight] : face_weights[n]) of = std::max(of, patch_of_node[std::size_t(node)]);
    return of;
  };
  const auto hangs = [&](std::size_t n) { return !face_weights[n].empty() && patch(n) >= 0; };
  const auto center = [&](std::size_t n) {
    return domain.layout.position(domain.layout.index(shares[n].face), face_offset<Dim>(shares[n].axis));
  };
  for (const auto& [cell, of] : cells) {
    std::vector<double> cut(solid.patches.size());
    constexpr double whole = 1e-3;  // what a face that is closed altogether counts for
    for (const auto& [n, sign] : of.shares)
      if (hangs(n)) cut[std::size_t(patch(n))] += shares[n].closed * (1 - shares[n].closed + whole);
    const int own = int(std::max_element(cut.begin(), cut.end()) - cut.begin());
    const int row = int(rows.row[cell] - rows.first);
    for (const auto& [n, sign] : of.shares) {
      if (!hangs(n) || patch(n) == own) continue;
      std::size_t best = n;
      for (const auto& [m, ignored] : of.shares) {
        if (!hangs(m) || patch(m) != own) continue;
        if (best == n || (center(m) - center(n)).norm() < (center(best) - center(n)).norm()) best = m;
      }
      add_entries<Dim>(row, -sign * shares[n].closed, shares[n].axis, face_weights[n], entries);
      add_entries<Dim>(row, sign * shares[n].closed, shares[n].axis, face_weights[best], entries);
    }
  }
}

// Pins divide a surface of the body that walls in liquid together with what the pins stand on.
template <int Dim>
bool is_divided(const ElasticSolid<Dim>& solid) {
  return std::any_of(solid.patches.begin(), solid.patches.end(), [](const auto& patch) { return !patch.is_closed(); });
}

// Pressure acts on the facets in each cell: what the shares show is taken back. Liquid at rest is to act as it does on
// the mesh.
template <int Dim>
void hang_on_facets(const CoupledStep<Dim>& step, const Eigen::VectorXd& u, const Vec<Dim>& gravity, BodyEntries& body,
                    CouplingParts<Dim>& parts) {
  const Setup<Dim>& s = step.setup;
  const StepGeometry<Dim>& g = step.geometry;
  const PressureRows<Dim>& rows = step.rows;
  SolidCoupling<Dim>& c = parts.coupling;
  if (!parts.open) parts.open = open_cells(s.domain, g.faces);
  const FacetFluxes<Dim> fluxes = facet_fluxes(s.domain, s.solids, g, *parts.open, body.body, u);
  for (FluxEntry e :
       spread_shares(s.domain, *g.shares[std::size_t(body.body)], *g.face_weights[std::size_t(body.body)], rows)) {
    e.value = -e.value;
    body.entries.push_back(e);
  }
  const std::vector<FluxEntry> own = entries_of(s.domain, rows, fluxes);
  body.entries.insert(body.entries.end(), own.begin(), own.end());
  const Eigen::VectorXd force =
      missing_buoyancy(s.domain, s.fluids, s.solids, rows, step.state.phi, body.body, u, fluxes, gravity);
  c.push.segment(body.first, u.size()) += step.dt * force;
  c.buoyancy_correction.segment(body.first, u.size()) = force;
}

// The highest pressure of the last step in cells whose faces body k cuts or closes, Pa. Collective.
template <int Dim>
double highest_pressure_beside(const Domain<Dim>& domain, const FaceShares& shares, const PressureRows<Dim>& rows,
                               const CellField<Dim>& pressure) {
  double most = 0;
  for_each_cell_of_shares(domain, shares, rows,
                          [&](Site cell, double, std::size_t) { most = std::max(most, pressure[cell]); });
  return domain.ranks.global_max(most);
}

// Those behind the first `known`, by cells.
template <int Dim>
std::shared_ptr<const CellFluxes> added_fluxes(const std::vector<FluxEntry>& entries, std::size_t known,
                                               const PressureRows<Dim>& rows) {
  CellFluxes added;
  for (std::size_t n = known; n < entries.size(); ++n)
    added.push_back({rows.cells[std::size_t(entries[n].row)], entries[n].column, entries[n].value});
  return std::make_shared<const CellFluxes>(std::move(added));
}

template <int Dim>
void hold_pins(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, double end, double horizon, int first,
               SolidCoupling<Dim>& c) {
  const Pins pins = pins_at(solid, end);
  for (std::size_t n = 0; n < pins.dofs.size(); ++n) {
    c.freedom[std::size_t(first + pins.dofs[n])] = Freedom::fixed;
    c.held[first + pins.dofs[n]] = (pins.targets[n] - u[pins.dofs[n]]) / horizon;
  }
}

void add_matrix(const SparseMatrix& Q, double factor, int first, std::vector<Eigen::Triplet<double>>& entries) {
  for (int k = 0; k < Q.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(Q, k); it; ++it)
      entries.emplace_back(first + int(it.row()), first + k, factor * it.value());
}

// With v = v_a + H w/gamma, v_a = (u - u0)/gamma, the incremental potential (dt/H) Phi(u + H w) without its elastic
// energy is 1/2 w'Q w - w'push:
//   Q = dt H (M/gamma^2 + C/gamma),  push = dt (f - M (v_a - v*)/gamma - C v_a).
template <int Dim>
void add_inertia(const IncrementalPotential<Dim>& p, const Eigen::VectorXd& u, double dt, double horizon, int first,
                 CouplingParts<Dim>& parts) {
  const Eigen::VectorXd va = (u - p.base) / p.gamma;
  Eigen::VectorXd push = p.force - p.body->mass * (va - p.target) / p.gamma;
  add_matrix(p.body->mass, dt * horizon / (p.gamma * p.gamma), first, parts.mass);
  if (p.damping.size() > 0) {
    push -= p.damping * va;
    add_matrix(p.damping, dt * horizon / p.gamma, first, parts.mass);
  }
  parts.coupling.push.segment(first, push.size()) = dt * push;
}

// 1/2 w'm w - w'(momentum + dt m g)
template <int Dim>
void add_liquid_beside(const LiquidBeside& beside, const Eigen::VectorXd& gravity, double dt, int first,
                       CouplingParts<Dim>& parts) {
  SolidCoupling<Dim>& c = parts.coupling;
  const Eigen::VectorXd &m = beside.mass, weight = beside.heavy.cwiseProduct(gravity);
  for (int i = 0; i < int(m.size()); ++i)
    if (m[i] > 0) parts.mass.emplace_back(first + i, first + i, m[i]);
  c.mass_beside.segment(first, m.size()) = m;
  c.momentum_beside.segment(first, m.size()) = beside.momentum;
  c.push.segment(first, m.size()) += beside.momentum + dt * weight;
  c.buoyancy_correction.segment(first, m.size()) = weight;
}

// M times what is linear in the deformed positions, from -1 to 1 over the body: forces, moments, what bends and
// stretches.
template <int Dim>
Eigen::MatrixXd smooth_loads(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) {
  Eigen::Matrix<double, Dim, Eigen::Dynamic> x(Dim, u.size() / Dim);
  for (Eigen::Index n = 0; n < x.cols(); ++n)
    x.col(n) = body.mesh.nodes[std::size_t(n)] + u.template segment<Dim>(Dim * n);
  const Vec<Dim> low = x.rowwise().minCoeff(), high = x.rowwise().maxCoeff();
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(u.size(), Dim * (Dim + 1));
  for (Eigen::Index n = 0; n < x.cols(); ++n)
    for (int axis = 0; axis < Dim; ++axis) {
      f(Dim * n + axis, axis) = 1;
      for (int a = 0; a < Dim; ++a)
        f(Dim * n + axis, Dim * (a + 1) + axis) = (2 * x(a, n) - low[a] - high[a]) / (high[a] - low[a]);
    }
  return body.mass * f;
}

}  // namespace

// Gravity on each node, and the scene's own forces.
template <int Dim>
StepLoad step_load(const Gravity& varying, const ElasticSolid<Dim>& solid, const State<Dim>& state, double dt,
                   double horizon) {
  const double start = state.time, end = state.time + horizon;
  const Vec3 gravity = varying.of_step(start, dt);
  const Eigen::VectorXd before = applied_force_at(solid, start), own = applied_force_at(solid, end);
  Eigen::VectorXd force = solid.body.mass * truncate<Dim>(gravity).replicate(solid.body.size() / Dim, 1);
  if (own.size() > 0) force += own;
  return {force, varying.at(start) == gravity && varying.at(end) == gravity && before == own};
}

template <int Dim>
void couple_elastic_body(const CoupledStep<Dim>& step, int k, const ElasticMotion& motion, int block,
                         CouplingParts<Dim>& parts) {
  const auto& [s, g, rows, closed, state, dt, horizon] = step;
  SolidCoupling<Dim>& c = parts.coupling;
  const Body<Dim>& body = s.solids.bodies[std::size_t(k)];
  const ElasticSolid<Dim>& solid = body.elastic();
  const ElasticState& e = motion.state;
  const int first = c.first[std::size_t(block)];
  const FaceShares& shares = *g.shares[std::size_t(k)];
  const FaceWeights& face_weights = *g.face_weights[std::size_t(k)];
  const Vec<Dim> gravity = truncate<Dim>(s.fluids.gravity.of_step(state.time, dt));
  const Eigen::VectorXd g_nodes = gravity.replicate(e.u.size() / Dim, 1);
  hold_pins(solid, e.u, state.time + horizon, horizon, first, c);
  const auto p = begin_step(solid.body, e, elastic_scheme(s.scene.time), horizon,
                            step_load(s.fluids.gravity, solid, state, dt, horizon));
  add_inertia(p, e.u, dt, horizon, first, parts);
  c.free.segment(first, e.v.size()) = e.v + dt * g_nodes;
  if (body.is_thin()) add_liquid_beside(liquid_beside(s, g, rows, state, dt, k), g_nodes, dt, first, parts);
  BodyEntries mine{k, first, spread_shares(s, shares, face_weights, rows)};
  send_air_rows_to_owner(s, rows, 0, mine.entries);
  mine.shown = mine.entries.size();
  if (body.is_thin() || is_divided(solid))
    keep_to_own_side(s, solid, shares, face_weights, rows, mine.entries);
  else
    hang_on_facets(step, e.u, gravity, mine, parts);
  send_air_rows_to_owner(s, rows, mine.shown, mine.entries);
  parts.entries.push_back(std::move(mine));
  c.J.blocks[std::size_t(block)].loads = smooth_loads<Dim>(solid.body, e.u);
  const double most = highest_pressure_beside(s, shares, rows, state.pressure);
  const ElasticShare<Dim> share{&solid.body, &e.u, first, hold_pressure(solid.body, e.u, most)};
  parts.potentials.push_back(std::make_shared<ElasticPotential<Dim>>(std::vector{share}, c.size(),
                                                                     s.perturbation.elastic_forces * dt, horizon));
}

template <int Dim>
void set_elastic_columns(const CoupledStep<Dim>& step, int k, int block, CouplingParts<Dim>& parts) {
  SolidCoupling<Dim>& c = parts.coupling;
  const auto b = std::size_t(block);
  BodyEntries& mine = *std::find_if(parts.entries.begin(), parts.entries.end(),
                                    [&](const BodyEntries& entries) { return entries.body == k; });
  c.cell_fluxes[b] = added_fluxes(mine.entries, mine.shown, step.rows);
  Eigen::MatrixXd loads = std::move(c.J.blocks[b].loads);
  const int width = c.first[b + 1] - mine.first;
  sort_by_rows(mine.entries);
  c.J.blocks[b] = make_block(mine.entries, c.freedom, Freedom::free, mine.first, width);
  c.J_held.blocks[b] = make_block(mine.entries, c.freedom, Freedom::fixed, mine.first, width);
  c.J.blocks[b].loads = std::move(loads);
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template void couple_elastic_body<D>(const CoupledStep<D>&, int, const ElasticMotion&, int, CouplingParts<D>&); \
  template void set_elastic_columns<D>(const CoupledStep<D>&, int, int, CouplingParts<D>&);                       \
  template StepLoad step_load<D>(const Gravity&, const ElasticSolid<D>&, const State<D>&, double, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
