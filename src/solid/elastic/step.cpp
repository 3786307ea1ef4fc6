#include "solid/elastic/step.h"

#include "solid/elastic/excess.h"

namespace seiche {
namespace {

// y_new = now y + old y_old + gamma dy/dt_new. BDF2 with r = dt / dt_old: now = (1 + r)^2 / (1 + 2 r),
// old = -r^2 / (1 + 2 r), gamma = dt (1 + r) / (1 + 2 r). Without an earlier
// step, or above `most_growth`: backward Euler. BDF2 is unstable if all steps grow by 1 + sqrt(2) or more (Grigorieff
// 1983); a single one, as after a frame, does no harm and is more accurate.
struct Weights {
  double now = 1, old = 0, gamma = 0;
};

constexpr double most_growth = 5;

Weights weights(ElasticScheme scheme, double dt, double dt_old) {
  if (scheme == ElasticScheme::backward_euler || dt > most_growth * dt_old) return {1, 0, dt};
  const double r = dt / dt_old;
  return {(1 + r) * (1 + r) / (1 + 2 * r), -r * r / (1 + 2 * r), dt * (1 + r) / (1 + 2 * r)};
}

// Rayleigh damping C = alpha M + beta K(u), with K projected to positive semi-definite so that damping only dissipates.
template <int Dim>
SparseMatrix rayleigh_damping(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) {
  const auto& [density, lame, alpha, beta] = body.properties;
  if (alpha == 0 && beta == 0) return {};
  SparseMatrix C = body.pattern;
  if (beta > 0) add_stiffness(body, u, HessianProjection::convex, C);
  for (Eigen::Index i = 0; i < C.nonZeros(); ++i) {
    C.valuePtr()[i] = beta * C.valuePtr()[i] + alpha * body.mass.valuePtr()[i];
  }
  return C;
}

}  // namespace

template <int Dim>
ElasticState at_rest(const ElasticBody<Dim>& body) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(body.size());
  return {zero, zero, zero, zero, 0};
}

template <int Dim>
IncrementalPotential<Dim> begin_step(const ElasticBody<Dim>& body, const ElasticState& state, ElasticScheme scheme,
                                     double dt, const StepLoad& load) {
  const auto [now, old, gamma] = weights(scheme, dt, state.dt_old);
  return {&body,      gamma,         now * state.u + old * state.u_old, now * state.v + old * state.v_old,
          load.force, load.constant, rayleigh_damping(body, state.u)};
}

template <int Dim>
void end_step(const IncrementalPotential<Dim>& potential, double dt, const Pins& pins, const Eigen::VectorXd& u,
              ElasticState& state) {
  Eigen::VectorXd v = (u - potential.base) / potential.gamma;
  remove_excess_energy(potential, pins, {state.u, state.v, u}, v);
  state.u_old = state.u;
  state.v_old = state.v;
  state.u = u;
  state.v = v;
  state.dt_old = dt;
}

template <int Dim>
MinimizeReport advance(const ElasticBody<Dim>& body, ElasticScheme scheme, double dt, const StepLoad& load,
                       const Pins& pins, const MinimizeOptions& options, ElasticWorkspace& workspace,
                       ElasticState& state) {
  const auto potential = begin_step(body, state, scheme, dt, load);
  Eigen::VectorXd u = state.u;
  const MinimizeReport report = minimize(potential, pins, options, workspace, u);
  if (report.converged) end_step(potential, dt, pins, u, state);
  return report;
}

template <int Dim>
double kinetic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& v) {
  return v.dot(body.mass * v) / 2;
}

#define SEICHE_INSTANTIATE(Dim)                                                                                      \
  template ElasticState at_rest<Dim>(const ElasticBody<Dim>&);                                                       \
  template IncrementalPotential<Dim> begin_step<Dim>(const ElasticBody<Dim>&, const ElasticState&, ElasticScheme,    \
                                                     double, const StepLoad&);                                       \
  template void end_step<Dim>(const IncrementalPotential<Dim>&, double, const Pins&, const Eigen::VectorXd&,         \
                              ElasticState&);                                                                        \
  template MinimizeReport advance<Dim>(const ElasticBody<Dim>&, ElasticScheme, double, const StepLoad&, const Pins&, \
                                       const MinimizeOptions&, ElasticWorkspace&, ElasticState&);                    \
  template double kinetic_energy<Dim>(const ElasticBody<Dim>&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
