#include "coupling/solve/viscous_problem.h"

#include <fmt/format.h>

#include "coupling/solids/joint_bow.h"

namespace seiche {

template <int Dim>
ViscousProblem<Dim>::ViscousProblem(const SolidCoupling<Dim>& coupling, const ViscousStep<Dim>& viscous,
                                    const ViscousSolvers& solvers, double area, const NullSpace& closed, Vector& u,
                                    Vector& p, const Communicator& ranks)
    : CoupledProblem<Dim>(coupling),
      viscous_(viscous),
      solvers_(solvers),
      area_(area),
      closed_(closed),
      u_(u),
      p_(p),
      ranks_(ranks),
      H_(ranks),
      none_(ranks),
      last_(coupling.free) {}

// With v = w + the part that the joints prescribe, C w = 0.
template <int Dim>
SaddleReport ViscousProblem<Dim>::solve_with_joints(SaddleSolver& solver, const BodyMatrix& H, Vector f,
                                                    Eigen::VectorXd g, Vector q, Eigen::VectorXd& v) {
  const Eigen::VectorXd part = this->prescribed_by_joints(H);
  add_multiplied(viscous_.system().G, -part, f);
  add_multiplied(viscous_.J(), -part, q);
  g = H.constraints().without_multipliers(g - H.multiply(part));
  Eigen::VectorXd w = H.constraints().moved_onto(v - part, Eigen::VectorXd::Zero(H.constraints().rows().rows()));
  const SaddleReport r = solver.solve(H, f, g, q, u_, w, p_);
  v = w + part;
  return r;
}

template <int Dim>
std::string ViscousProblem<Dim>::solve(SaddleSolver& solver, const BodyMatrix& H, const Vector& f,
                                       const Eigen::VectorXd& g, const Vector& q, Eigen::VectorXd& v) {
  const SaddleReport r = coupling_.is_constrained() && H.size() > 0 ? solve_with_joints(solver, H, f, g, q, v)
                                                                    : solver.solve(H, f, g, q, u_, v, p_);
  report_.converged = r.converged;
  report_.iterations += r.iterations;
  report_.residual = std::max(report_.residual, r.residual);
  if (H.size() > 0) report_.mismatch = r.mismatch;  // no meaning for given motion of the bodies
  report_.used = r.used;
  report_.failed_attempts.insert(report_.failed_attempts.end(), r.failed_attempts.begin(), r.failed_attempts.end());
  if (r.converged) return {};
  return fmt::format("the solve of pressure and viscosity stopped at residual {:.2e} after {} iterations", r.residual,
                     r.iterations);
}

// grad e = M v - push - g + H_vv v + G'u + J'p^, fixed unknowns included; the same bits on all ranks.
template <int Dim>
InertiaResponse ViscousProblem<Dim>::response_at(const Eigen::VectorXd& v) const {
  const ViscousSystem<Dim>& system = viscous_.system();
  Eigen::VectorXd reaction = local_transposed(system.G, u_) + local_transposed(viscous_.J(), p_);
  reaction += local_transposed(viscous_.G_held(), u_) + local_transposed(viscous_.J_held(), p_);
  ranks_.global_sum(std::span<double>(reaction.data(), std::size_t(reaction.size())));
  make_identical(reaction, ranks_);
  const Eigen::VectorXd gradient = coupling_.mass * v - push_with_bow(coupling_) - system.g + system.Hvv * v + reaction;
  return {{}, Shape::convex, v, gradient, reaction_of_means()};
}

// J'p^ of the mean pressures of closed components, the multipliers of chi'(J v) = given. Empty: bodies feel none.
template <int Dim>
Eigen::VectorXd ViscousProblem<Dim>::reaction_of_means() const {
  const std::vector<int>& sensed = solvers_.coupled.sensed_components();
  if (sensed.empty()) return {};
  Eigen::VectorXd reaction = multiply_transposed(viscous_.J(), component_means(closed_, sensed, p_, ranks_), ranks_);
  make_identical(reaction, ranks_);
  return reaction;
}

template <int Dim>
InertiaResponse ViscousProblem<Dim>::minimise(const SparseMatrix& K, const Eigen::VectorXd& r) {
  const ViscousSystem<Dim>& system = viscous_.system();
  Eigen::VectorXd push = push_with_bow(coupling_) + r + system.g;
  SparseMatrix H = coupling_.mass + system.Hvv;
  if (K.nonZeros() > 0) H = H + K;
  if (!H_.set(uncouple_held(coupling_, H, push), coupling_.J.constraints)) return indefinite_response();
  Eigen::VectorXd v = last_;
  if (std::string failure = solve(solvers_.coupled, H_, system.f, push, this->with_missing_fluxes(system.q, -area_), v);
      !failure.empty())
    return failed_response(failure);
  this->hold(v);
  last_ = v;
  return response_at(v);
}

// q includes the fluxes of fixed unknowns at their prescribed velocities, whatever v has there.
template <int Dim>
InertiaResponse ViscousProblem<Dim>::respond(const Eigen::VectorXd& v) {
  const ViscousSystem<Dim>& system = viscous_.system();
  Vector f = system.f, q = this->with_missing_fluxes(system.q, -area_);
  const Eigen::VectorXd moving = -this->free_part(v);
  add_multiplied(system.G, moving, f);
  add_multiplied(viscous_.J(), moving, q);
  Eigen::VectorXd none;
  if (std::string failure = solve(solvers_.alone(), none_, f, none, q, none); !failure.empty())
    return failed_response(failure);
  return response_at(v);
}

template class ViscousProblem<2>;
template class ViscousProblem<3>;

}  // namespace seiche
