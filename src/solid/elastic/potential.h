#pragma once
// The energy of elastic bodies as a function of their nodes' velocities.
#include <memory>

#include "base/work_share.h"
#include "solid/elastic/body.h"
#include "solid/energy/velocity_potential.h"

namespace seiche {

// One body: displacement at the start of the interval, and the first index of its nodes' velocities in the stacked v.
template <int Dim>
struct ElasticShare {
  const ElasticBody<Dim>* body;
  const Eigen::VectorXd* displacement;  // m
  int first_dof;
  HeldPressure<Dim> held;
  bool may_turn = true;  // no pins
};

// P(v) = dt/H sum Psi(u_n + H w), with the velocities w of a body's nodes over the interval H. Psi includes the work
// against the held pressure. The gradient is dt Psi', the impulse of the elastic forces at the end of the interval. The
// Hessian is dt H Psi''.
template <int Dim>
class ElasticPotential : public VelocityPotential {
 public:
  // Keeps the pointers. The bodies are in the order of their unknowns. `size`: of v. dt and horizon: s, positive.
  // `work`: processes that share the elements of large bodies; null: none do.
  ElasticPotential(std::vector<ElasticShare<Dim>> bodies, int size, double dt, double horizon,
                   std::shared_ptr<const WorkShare> work = nullptr);
  double energy(const Eigen::VectorXd& v) const override;
  void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override;
  Eigen::SparseMatrix<double> hessian(const Eigen::VectorXd& v, HessianProjection curvature,
                                      IndexRange columns) const override;
  double step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const override;
  double angle(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const override;
  void turn(const Eigen::VectorXd& v, Eigen::VectorXd& dv) const override;
  double round_off() const override;

 private:
  bool is_shared(const ElasticBody<Dim>& body) const;
  IndexRange own_elements(const ElasticBody<Dim>& body) const;
  SparseMatrix stiffness(const ElasticShare<Dim>& share, const Eigen::VectorXd& v, HessianProjection curvature,
                         IndexRange columns, bool whole) const;
  Eigen::VectorXd displacement(const ElasticShare<Dim>& share, const Eigen::VectorXd& v) const;
  Eigen::VectorXd points(const ElasticShare<Dim>& share, const Eigen::VectorXd& v) const;

  std::vector<ElasticShare<Dim>> bodies_;
  int size_;
  double dt_, horizon_;
  std::shared_ptr<const WorkShare> work_;
};

}  // namespace seiche
