#include "coupling/solids/elastic_coupling.h"

#include <algorithm>
#include <map>

#include "base/scene.h"
#include "coupling/solids/exposed_surface.h"
#include "coupling/solids/face_columns.h"
#include "coupling/solids/facet_fluxes.h"
#include "coupling/solids/pressure_around.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "coupling/thin/liquid_beside.h"
#include "fluid/boundary/domain.h"
#include "linalg/core/matrix_entries.h"
#include "linalg/core/shared_columns.h"
#include "solid/elastic/potential.h"
#include "solid/elastic/surface_patches.h"

namespace seiche {
namespace {

template <int Dim>
void add_entries(Site cell, double value, int axis, const SurfaceWeights& weights, CellFluxes& entries) {
  for (const auto& [node, weight] : weights) entries.push_back({cell, Dim * node + axis, value * weight});
}

// Each face share beside cells with counts(cell), spread to the nodes that it is attached to.
template <int Dim, class Counts>
CellFluxes spread_shares(const Domain<Dim>& domain, const FaceShares& shares, const FaceWeights& face_weights,
                         const Counts& counts) {
  CellFluxes entries;
  for_each_cell_of_shares(domain, shares, counts, [&](Site cell, double sign, std::size_t n) {
    add_entries<Dim>(cell, sign * shares[n].closed, shares[n].axis, face_weights[n], entries);
  });
  return entries;
}

// Tells cells whose net flux is solved for or checked: those with a row, and those separated from walls.
template <int Dim>
auto balanced_of(const PressureRows<Dim>& rows) {
  return [&rows](Site cell) { return rows.row[cell] >= 0 || rows.is_separated(cell); };
}

template <int Dim>
void add_to_rows(const CellFluxes& fluxes, const PressureRows<Dim>& rows, BodyEntries& body) {
  for (const CellFlux& f : fluxes) {
    if (rows.row[f.cell] >= 0)
      body.entries.push_back({int(rows.row[f.cell] - rows.first), f.column, f.value});
    else
      body.separated.push_back(f);
  }
}

// Face shares of one cell.
struct CellShares {
  std::vector<std::pair<std::size_t, double>> shares;  // index and sign
};

// In a thin cavity wall, the surface point nearest to a face may lie on the wrong side. All shares of
// a cell are therefore attached to the patch that cuts its faces. Others move to the attachment of the nearest share on
// that patch. Shares attached to pinned facets between the patches stay.
template <int Dim>
CellFluxes keep_to_own_side(const Domain<Dim>& domain, const ElasticSolid<Dim>& solid, const FaceShares& shares,
                            const FaceWeights& face_weights, const PressureRows<Dim>& rows) {
  if (solid.patches.size() == 1) return {};
  CellFluxes changes;
  const std::vector<int> patch_of_node = patches_of_nodes(solid);
  std::map<Site, CellShares> cells;
  for_each_cell_of_shares(domain, shares, balanced_of(rows),
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
    constexpr double whole = 1e-3;  // weight of a face that is fully closed
    for (const auto& [n, sign] : of.shares)
      if (hangs(n)) cut[std::size_t(patch(n))] += shares[n].closed * (1 - shares[n].closed + whole);
    const int own = int(std::max_element(cut.begin(), cut.end()) - cut.begin());
    for (const auto& [n, sign] : of.shares) {
      if (!hangs(n) || patch(n) == own) continue;
      std::size_t best = n;
      for (const auto& [m, ignored] : of.shares) {
        if (!hangs(m) || patch(m) != own) continue;
        if (best == n || (center(m) - center(n)).norm() < (center(best) - center(n)).norm()) best = m;
      }
      add_entries<Dim>(cell, -sign * shares[n].closed, shares[n].axis, face_weights[n], changes);
      add_entries<Dim>(cell, sign * shares[n].closed, shares[n].axis, face_weights[best], changes);
    }
  }
  return changes;
}

// Changes that replace the entries of the face shares by those of the facets in each cell (FacetFluxes). Adds the
// missing buoyancy, so that liquid at rest loads the mesh exactly.
template <int Dim>
CellFluxes hang_on_facets(const CoupledStep<Dim>& step, const Eigen::VectorXd& u, const Vec<Dim>& gravity,
                          const BodyEntries& body, CouplingParts<Dim>& parts) {
  const Setup<Dim>& s = step.setup;
  const StepGeometry<Dim>& g = step.geometry;
  const auto k = std::size_t(body.body);
  const auto balanced = balanced_of(step.rows);
  SolidCoupling<Dim>& c = parts.coupling;
  if (!parts.open) parts.open = open_cells(s.domain, g.faces);
  const FacetFluxes<Dim> fluxes = facet_fluxes(s.domain, s.solids, g, *parts.open, body.body, u);
  CellFluxes changes = spread_shares(s.domain, *g.shares[k], *g.face_weights[k], balanced);
  for (CellFlux& f : changes) f.value = -f.value;
  for (const CellFlux& f : entries_of(s.domain, fluxes))
    if (balanced(f.cell)) changes.push_back(f);
  const Eigen::VectorXd force =
      missing_buoyancy(s.domain, s.fluids, s.solids, step.rows, step.state.phi, body.body, u, fluxes, gravity);
  c.push.segment(body.first, u.size()) += step.dt * force;
  c.buoyancy_correction.segment(body.first, u.size()) = force;
  return changes;
}

// Highest pressure (Pa, at least 0) of the last step in cells beside the faces that the body cuts or closes.
// Collective.
template <int Dim>
double highest_pressure_beside(const Domain<Dim>& domain, const FaceShares& shares, const PressureRows<Dim>& rows,
                               const CellField<Dim>& pressure) {
  double most = 0;
  for_each_cell_of_shares(domain, shares, with_row(rows),
                          [&](Site cell, double, std::size_t) { most = std::max(most, pressure[cell]); });
  return domain.ranks.global_max(most);
}

// True if liquid without a given pressure surrounded the body in the last solve, and the body has no cavities: further
// patches would lie around them.
template <int Dim>
bool is_surrounded(const ElasticSolid<Dim>& solid, const ElasticMotion& motion) {
  return solid.patches.size() == 1 && solid.patches[0].is_closed() && motion.cavity[0] >= 0;
}

// Pressure of the liquid that the body takes to the end of the step. Collective.
template <int Dim>
HeldPressure<Dim> held_pressure_of(const CoupledStep<Dim>& step, const ElasticSolid<Dim>& solid,
                                   const ElasticMotion& motion, const FaceShares& shares) {
  const Domain<Dim>& domain = step.setup.domain;
  const Eigen::VectorXd& u = motion.state.u;
  const CellField<Dim>& pressure = step.state.pressure;
  if (is_surrounded(solid, motion))
    return hold_pressure(solid.body, u, pressure_around(domain, shares, step.rows, pressure, solid.body, u));
  return hold_pressure(solid.body, u, highest_pressure_beside(domain, shares, step.rows, pressure));
}

// All corrections, by cell.
template <int Dim>
std::shared_ptr<const CellFluxes> added_fluxes(const BodyEntries& body, const PressureRows<Dim>& rows) {
  CellFluxes added = body.separated;
  for (std::size_t n = body.shown; n < body.entries.size(); ++n)
    added.push_back({rows.cells[std::size_t(body.entries[n].row)], body.entries[n].column, body.entries[n].value});
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

// Adds 1/2 w'm w - w'(momentum + dt m_heavy g), m_heavy the mass that has weight.
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

// M times the fields linear in the deformed positions, scaled to [-1, 1] over the body: forces, moments, bending and
// stretching. One a column, Dim (Dim + 1) in all.
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

// Columns of J from the facets of the surface, and loads that bend it smoothly.
template <int Dim>
void hang_surface(const CoupledStep<Dim>& step, int k, const ElasticMotion& motion, int block,
                  CouplingParts<Dim>& parts) {
  const auto& [s, g, rows, closed, state, dt, horizon] = step;
  SolidCoupling<Dim>& c = parts.coupling;
  const Body<Dim>& body = s.solids.bodies[std::size_t(k)];
  const FaceShares& shares = *g.shares[std::size_t(k)];
  const FaceWeights& face_weights = *g.face_weights[std::size_t(k)];
  const Vec<Dim> gravity = truncate<Dim>(s.fluids.gravity.of_step(state.time, dt));
  BodyEntries mine{k, c.first[std::size_t(block)]};
  add_to_rows(spread_shares(s.domain, shares, face_weights, with_row(rows)), rows, mine);
  send_air_rows_to_owner(s.domain, rows, 0, mine.entries);
  mine.shown = mine.entries.size();
  add_to_rows(body.is_thin() ? keep_to_own_side(s.domain, body.elastic(), shares, face_weights, rows)
                             : hang_on_facets(step, motion.state.u, gravity, mine, parts),
              rows, mine);
  send_air_rows_to_owner(s.domain, rows, mine.shown, mine.entries);
  parts.entries.push_back(std::move(mine));
  c.J.blocks[std::size_t(block)].loads = smooth_loads<Dim>(body.elastic().body, motion.state.u);
}

// No energy: velocities that are all prescribed store none.
class NoPotential : public VelocityPotential {
 public:
  explicit NoPotential(int size) : size_(size) {}
  double energy(const Eigen::VectorXd&) const override { return 0; }
  void add_gradient(const Eigen::VectorXd&, Eigen::VectorXd&) const override {}
  Eigen::SparseMatrix<double> hessian(const Eigen::VectorXd&, HessianProjection, IndexRange) const override {
    return {size_, size_};
  }
  double step_bound(const Eigen::VectorXd&, const Eigen::VectorXd&) const override { return 1; }

 private:
  int size_;
};

}  // namespace

ElasticScheme elastic_scheme(const TimeSpec& time) {
  return time.scheme == TimeScheme::first_order ? ElasticScheme::backward_euler : ElasticScheme::bdf2;
}

// Gravity and the scene's forces on each node.
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
  const Eigen::VectorXd g_nodes =
      truncate<Dim>(s.fluids.gravity.of_step(state.time, dt)).replicate(e.u.size() / Dim, 1);
  hold_pins(solid, e.u, state.time + horizon, horizon, first, c);
  const auto p = begin_step(solid.body, e, elastic_scheme(s.scene->time), horizon,
                            step_load(s.fluids.gravity, solid, state, dt, horizon));
  add_inertia(p, e.u, dt, horizon, first, parts);
  c.free.segment(first, e.v.size()) = e.v + dt * g_nodes;
  if (body.is_thin())
    add_liquid_beside(liquid_beside(s.domain, s.fluids, g, rows, state, dt, k), g_nodes, dt, first, parts);
  hang_surface(step, k, motion, block, parts);
  const ElasticShare<Dim> share{&solid.body, &e.u, first,
                                held_pressure_of(step, solid, motion, *g.shares[std::size_t(k)]), solid.pins.empty()};
  parts.potentials.push_back(std::make_shared<ElasticPotential<Dim>>(std::vector{share}, c.size(),
                                                                     s.perturbation.elastic_forces * dt, horizon,
                                                                     std::make_shared<RankShare>(s.domain.ranks)));
}

// The mass stores no momentum: M v = push at the prescribed v.
template <int Dim>
void couple_deforming_body(const CoupledStep<Dim>& step, int k, const ElasticMotion& motion, int block,
                           CouplingParts<Dim>& parts) {
  SolidCoupling<Dim>& c = parts.coupling;
  const ElasticSolid<Dim>& solid = step.setup.solids.bodies[std::size_t(k)].elastic();
  const int first = c.first[std::size_t(block)], size = solid.body.size();
  hold_pins(solid, motion.state.u, step.state.time + step.horizon, step.horizon, first, c);
  const Eigen::VectorXd held = c.held.segment(first, size);
  add_matrix(solid.body.mass, 1, first, parts.mass);
  c.push.segment(first, size) = solid.body.mass * held;
  c.free.segment(first, size) = held;
  hang_surface(step, k, motion, block, parts);
  parts.potentials.push_back(std::make_shared<NoPotential>(c.size()));
}

template <int Dim>
void set_elastic_columns(const CoupledStep<Dim>& step, int k, int block, CouplingParts<Dim>& parts) {
  SolidCoupling<Dim>& c = parts.coupling;
  const auto b = std::size_t(block);
  BodyEntries& mine = *std::find_if(parts.entries.begin(), parts.entries.end(),
                                    [&](const BodyEntries& entries) { return entries.body == k; });
  c.cell_fluxes[b] = added_fluxes(mine, step.rows);
  Eigen::MatrixXd loads = std::move(c.J.blocks[b].loads);
  const int width = c.first[b + 1] - mine.first;
  sort_by_rows(mine.entries);
  c.J.blocks[b] = make_block(mine.entries, c.freedom, Freedom::free, mine.first, width);
  c.J_held.blocks[b] = make_block(mine.entries, c.freedom, Freedom::fixed, mine.first, width);
  c.J.blocks[b].loads = std::move(loads);
}

#define SEICHE_INSTANTIATE(D)                                                                                       \
  template void couple_elastic_body<D>(const CoupledStep<D>&, int, const ElasticMotion&, int, CouplingParts<D>&);   \
  template void couple_deforming_body<D>(const CoupledStep<D>&, int, const ElasticMotion&, int, CouplingParts<D>&); \
  template void set_elastic_columns<D>(const CoupledStep<D>&, int, int, CouplingParts<D>&);                         \
  template StepLoad step_load<D>(const Gravity&, const ElasticSolid<D>&, const State<D>&, double, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
