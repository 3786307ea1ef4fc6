#include "solid/elastic/minimize.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

// Arguments shared by the parts of minimize().
template <int Dim>
struct Descent {
  const IncrementalPotential<Dim>& potential;
  const Pins& pins;
  ElasticWorkspace& workspace;
  MinimizeReport& report;
  double size;  // of the body, m
};

template <int Dim>
double extent(const ElasticMesh<Dim>& mesh) {
  Vec<Dim> low = mesh.nodes[0], high = mesh.nodes[0];
  for (const auto& X : mesh.nodes) {
    low = low.cwiseMin(X);
    high = high.cwiseMax(X);
  }
  return (high - low).maxCoeff();
}

// Replaces the rows and columns of pinned dofs by those of the identity. Returns H * moves.
Eigen::VectorXd hold(SparseMatrix& H, const std::vector<int>& dofs, const Eigen::VectorXd& moves) {
  const Eigen::VectorXd pull = H * moves;
  std::vector<char> held(H.cols(), 0);
  for (int i : dofs) held[i] = 1;
  for (int c = 0; c < H.outerSize(); ++c) {
    for (SparseMatrix::InnerIterator entry(H, c); entry; ++entry) {
      if (held[c] || held[entry.row()]) entry.valueRef() = entry.row() == c;
    }
  }
  return pull;
}

// The Newton step: H d = -g at free degrees of freedom, d = the missing displacement at pins. The exact stiffness is
// tried first: it converges quadratically also for bending of bodies that are far stiffer along than across. False if
// no stiffness can be factored.
template <int Dim>
bool newton_step(const Descent<Dim>& s, const Eigen::VectorXd& u, const Eigen::VectorXd& g, Eigen::VectorXd& d) {
  Eigen::VectorXd missing = Eigen::VectorXd::Zero(u.size());
  for (size_t i = 0; i < s.pins.dofs.size(); ++i) missing[s.pins.dofs[i]] = s.pins.targets[i] - u[s.pins.dofs[i]];
  for (const HessianProjection curvature : {HessianProjection::exact, HessianProjection::convex}) {
    SparseMatrix H = potential_hessian(s.potential, u, curvature);
    Eigen::VectorXd rhs = -g - hold(H, s.pins.dofs, missing);
    for (int i : s.pins.dofs) rhs[i] = missing[i];
    if (!s.workspace.cholesky.factor(H)) continue;
    d = s.workspace.cholesky.solve(rhs);
    if (!d.allFinite()) continue;
    s.report.projected += curvature == HessianProjection::convex;
    return true;
  }
  return false;
}

// Moves the pins to their targets; the other nodes follow by linear prediction, and det F stays above 0. The energy may
// rise, since pins do work.
template <int Dim>
bool drive_pins(const Descent<Dim>& s, int max_iterations, Eigen::VectorXd& u) {
  const auto arrived = [&] {
    for (size_t i = 0; i < s.pins.dofs.size(); ++i) {
      if (u[s.pins.dofs[i]] != s.pins.targets[i]) return false;
    }
    return true;
  };
  Eigen::VectorXd d;
  for (int i = 0; !arrived(); ++i) {
    if (i == max_iterations || !newton_step(s, u, potential_gradient(s.potential, u), d)) return false;
    const double share = inversion_bound(*s.potential.body, u, d);
    if (!(share > 1e-6)) return false;  // the pins turn the body inside out
    u += share * d;
    for (size_t k = 0; share == 1 && k < s.pins.dofs.size(); ++k) u[s.pins.dofs[k]] = s.pins.targets[k];
  }
  return true;
}

double free_norm(Eigen::VectorXd g, const std::vector<int>& held) {
  for (int i : held) g[i] = 0;
  return g.norm();
}

// Armijo's rule, starting at the inversion bound. If the energy change is below round-off, the gradient norm decides.
template <int Dim>
double line_search(const Descent<Dim>& s, const Eigen::VectorXd& u, const Eigen::VectorXd& g,
                   const Eigen::VectorXd& d) {
  const double value = potential_value(s.potential, u), slope = g.dot(d), norm = free_norm(g, s.pins.dofs);
  double share = inversion_bound(*s.potential.body, u, d);
  for (int i = 0; i < 50; ++i, share /= 2) {
    const Eigen::VectorXd next = u + share * d;
    const double change = potential_value(s.potential, next) - value;
    if (change <= 1e-4 * share * slope) return share;
    const bool drowned = std::abs(share * slope) < 1e-10 * std::abs(value);
    if (!drowned) continue;
    return free_norm(potential_gradient(s.potential, next), s.pins.dofs) < norm ? share : 0;
  }
  return 0;
}

template <int Dim>
void descend(const Descent<Dim>& s, const MinimizeOptions& options, Eigen::VectorXd& u) {
  Eigen::VectorXd d;
  for (; s.report.iterations < options.max_iterations; ++s.report.iterations) {
    const Eigen::VectorXd g = potential_gradient(s.potential, u);
    if (!newton_step(s, u, g, d)) {
      s.report.failure = "the stiffness matrix is singular; pin the body";
      return;
    }
    s.report.last_step = d.template lpNorm<Eigen::Infinity>() / s.size;
    const bool last = s.report.last_step <= options.step_tolerance;
    const double share = line_search(s, u, g, d);
    u += share * d;
    if (last) {
      s.report.converged = true;
      return;
    }
    if (share == 0) {
      s.report.failure = "no step lowers the energy";
      return;
    }
  }
  s.report.failure = "too many Newton steps";
}

// Load step: `share` of the way from `start` to the pins' targets.
Pins between(const Pins& pins, const Eigen::VectorXd& start, double share) {
  Pins r = pins;
  for (size_t i = 0; i < r.dofs.size(); ++i) r.targets[i] = (1 - share) * start[r.dofs[i]] + share * pins.targets[i];
  return r;
}

}  // namespace

template <int Dim>
double potential_value(const IncrementalPotential<Dim>& p, const Eigen::VectorXd& u) {
  double value = elastic_energy(*p.body, u) - p.force.dot(u);
  if (p.gamma == 0) return value;
  const Eigen::VectorXd v = (u - p.base) / p.gamma, w = v - p.target;
  value += w.dot(p.body->mass * w) / 2;
  if (p.damping.nonZeros() > 0) value += p.gamma * v.dot(p.damping * v) / 2;
  return value;
}

template <int Dim>
Eigen::VectorXd potential_gradient(const IncrementalPotential<Dim>& p, const Eigen::VectorXd& u) {
  Eigen::VectorXd g = elastic_gradient(*p.body, u) - p.force;
  if (p.gamma == 0) return g;
  const Eigen::VectorXd v = (u - p.base) / p.gamma;
  g += p.body->mass * (v - p.target) / p.gamma;
  if (p.damping.nonZeros() > 0) g += p.damping * v;
  return g;
}

template <int Dim>
SparseMatrix potential_hessian(const IncrementalPotential<Dim>& p, const Eigen::VectorXd& u,
                               HessianProjection curvature) {
  SparseMatrix H = p.body->pattern;
  add_stiffness(*p.body, u, curvature, H);
  const auto add = [&H](const SparseMatrix& A, double scale) {  // all have one sparsity pattern
    for (Eigen::Index i = 0; i < H.nonZeros(); ++i) H.valuePtr()[i] += scale * A.valuePtr()[i];
  };
  if (p.gamma == 0) return H;
  add(p.body->mass, 1 / (p.gamma * p.gamma));
  if (p.damping.nonZeros() > 0) add(p.damping, 1 / p.gamma);
  return H;
}

template <int Dim>
Pins pin_nodes(const std::vector<int>& nodes) {
  Pins pins;
  for (int n : nodes) {
    for (int a = 0; a < Dim; ++a) pins.dofs.push_back(Dim * n + a);
  }
  pins.targets.assign(pins.dofs.size(), 0);
  return pins;
}

template <int Dim>
MinimizeReport minimize(const IncrementalPotential<Dim>& p, const Pins& pins, const MinimizeOptions& options,
                        ElasticWorkspace& workspace, Eigen::VectorXd& u) {
  MinimizeReport report;
  const Descent<Dim> descent{p, pins, workspace, report, extent(p.body->mesh)};
  if (!(least_volume_ratio(*p.body, u) > 0)) {
    report.failure = "elements are inverted at the start";
  } else if (!drive_pins(descent, options.max_iterations, u)) {
    report.failure = "the pins cannot move without inverting an element";
  } else {
    descend(descent, options, u);
  }
  report.least_volume_ratio = least_volume_ratio(*p.body, u);
  return report;
}

template <int Dim>
MinimizeReport solve_static(const ElasticBody<Dim>& body, const Eigen::VectorXd& force, const Pins& pins,
                            int load_steps, const MinimizeOptions& options, ElasticWorkspace& workspace,
                            Eigen::VectorXd& u) {
  const Eigen::VectorXd start = u;
  MinimizeReport total;
  double done = 0, step = 1. / load_steps;
  while (done < 1) {
    const double next = done + step > 1 - 1e-9 ? 1 : done + step;
    Eigen::VectorXd trial = u;
    const IncrementalPotential<Dim> potential{&body, 0, {}, {}, next * force, true, {}};
    const MinimizeReport report = minimize(potential, between(pins, start, next), options, workspace, trial);
    const int iterations = total.iterations + report.iterations, projected = total.projected + report.projected;
    total = report;
    total.iterations = iterations;
    total.projected = projected;
    if (report.converged) {
      u = trial;
      done = next;
    } else if ((step /= 2) < 1e-3) {
      return total;
    }
  }
  return total;
}

#define SEICHE_INSTANTIATE(Dim)                                                                                \
  template double potential_value<Dim>(const IncrementalPotential<Dim>&, const Eigen::VectorXd&);              \
  template Eigen::VectorXd potential_gradient<Dim>(const IncrementalPotential<Dim>&, const Eigen::VectorXd&);  \
  template SparseMatrix potential_hessian<Dim>(const IncrementalPotential<Dim>&, const Eigen::VectorXd&,       \
                                               HessianProjection);                                             \
  template Pins pin_nodes<Dim>(const std::vector<int>&);                                                       \
  template MinimizeReport minimize<Dim>(const IncrementalPotential<Dim>&, const Pins&, const MinimizeOptions&, \
                                        ElasticWorkspace&, Eigen::VectorXd&);                                  \
  template MinimizeReport solve_static<Dim>(const ElasticBody<Dim>&, const Eigen::VectorXd&, const Pins&, int, \
                                            const MinimizeOptions&, ElasticWorkspace&, Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
