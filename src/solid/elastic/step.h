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

// Load f of a step, gravity included.
struct StepLoad {
  Eigen::VectorXd force;  // at the end of the step, N
  bool constant = false;  // the same at the start of the step
};

// The incremental potential of the step from `state` over dt.
template <int Dim>
IncrementalPotential<Dim> begin_step(const ElasticBody<Dim>& body, const ElasticState& state, ElasticScheme scheme,
                                     double dt, const StepLoad& load);

// Takes the minimiser u as the new state; v = (u - u0) / gamma without energy added by the scheme (excess.h).
template <int Dim>
void end_step(const IncrementalPotential<Dim>& potential, double dt, const Pins& pins, const Eigen::VectorXd& u,
              ElasticState& state);

// One step: begin_step, minimize from the present displacements, end_step. On failure the state is unchanged.
template <int Dim>
[[nodiscard]] MinimizeReport advance(const ElasticBody<Dim>& body, ElasticScheme scheme, double dt,
                                     const StepLoad& load, const Pins& pins, const MinimizeOptions& options,
                                     ElasticWorkspace& workspace, ElasticState& state);

// Kinetic energy, J.
template <int Dim>
double kinetic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& v);

}  // namespace seiche
