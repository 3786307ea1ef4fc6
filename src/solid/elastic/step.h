#pragma once
// Implicit time steps of an elastic body.
#include "solid/elastic/minimize.h"

namespace seiche {

enum class ElasticScheme { backward_euler, bdf2 };

struct ElasticState {
  Eigen::VectorXd u, v;          // m, m/s
  Eigen::VectorXd u_old, v_old;  // one step earlier
  double dt_old = 0;             // s; 0: no earlier step
};

template <int Dim>
ElasticState at_rest(const ElasticBody<Dim>& body);

// f of a step, gravity included.
struct StepLoad {
  Eigen::VectorXd force;  // at the end of the step, N
  bool constant = false;  // the same at its start
};

// What the step from `state` over dt minimises.
template <int Dim>
IncrementalPotential<Dim> begin_step(const ElasticBody<Dim>& body, const ElasticState& state, ElasticScheme scheme,
                                     double dt, const StepLoad& load);

// Takes the minimum u as the new state; v = (u - u0) / gamma without energy that the scheme added (excess.h).
template <int Dim>
void end_step(const IncrementalPotential<Dim>& potential, double dt, const Pins& pins, const Eigen::VectorXd& u,
              ElasticState& state);

// begin, minimize from the displacements before the step, end. On failure the state is left as it was.
template <int Dim>
[[nodiscard]] MinimizeReport advance(const ElasticBody<Dim>& body, ElasticScheme scheme, double dt,
                                     const StepLoad& load, const Pins& pins, const MinimizeOptions& options,
                                     ElasticWorkspace& workspace, ElasticState& state);

// J
template <int Dim>
double kinetic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& v);

}  // namespace seiche
