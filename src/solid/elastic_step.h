#pragma once
// Implicit time steps of an elastic body.
#include "solid/elastic_minimize.h"

namespace seiche {

enum class ElasticScheme { backward_euler, bdf2 };

struct ElasticState {
  Eigen::VectorXd u, v;          // m, m/s
  Eigen::VectorXd u_old, v_old;  // one step earlier
  double dt_old = 0;             // s; 0: no earlier step
};

template <int Dim>
ElasticState at_rest(const ElasticBody<Dim>& body);

// What the step from `state` over dt minimises, under the force f at its end (N, gravity included).
template <int Dim>
IncrementalPotential<Dim> begin_step(const ElasticBody<Dim>& body, const ElasticState& state, ElasticScheme scheme,
                                     double dt, const Eigen::VectorXd& force);

// Takes the minimum u as the new state; v = (u - u0) / gamma.
template <int Dim>
void end_step(const IncrementalPotential<Dim>& potential, double dt, const Eigen::VectorXd& u, ElasticState& state);

// The same where only the scheme is at hand.
void end_step(ElasticScheme scheme, double dt, const Eigen::VectorXd& u, ElasticState& state);

// begin, minimize from the displacements before the step, end. On failure the state is left as it was.
template <int Dim>
[[nodiscard]] MinimizeReport advance(const ElasticBody<Dim>& body, ElasticScheme scheme, double dt,
                                     const Eigen::VectorXd& force, const Pins& pins, const MinimizeOptions& options,
                                     ElasticWorkspace& workspace, ElasticState& state);

// J
template <int Dim>
double kinetic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& v);

}  // namespace seiche
