#pragma once
// Inertia of the bodies in one contact solve, with liquid if there is any, as a quadratic energy of the velocities.
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "base/index_range.h"

namespace seiche {

// Generalised velocity of one body: (v of the centre of mass, omega); in 2D (v_x, v_y, omega_z).
template <int Dim>
constexpr int twist_size = Dim == 2 ? 3 : 6;

enum class Shape : char { convex, indefinite };

// Solution at `velocity`. The gradient of e is the impulse on each degree of freedom (N s, N m s).
struct InertiaResponse {
  std::string failure;          // empty: success
  Shape shape = Shape::convex;  // indefinite: there is no minimum, and nothing else is set
  Eigen::VectorXd velocity, gradient;
  // Part of the gradient from the multipliers of constraints on v, in the constraints' own scale. Meaningless where the
  // velocity violates the constraints. Empty: no constraints.
  Eigen::VectorXd constraint = {};
};

// e(v) (J), a convex quadratic in the stacked velocities of free bodies and of the nodes of deformable bodies.
class InertiaProblem {
 public:
  virtual ~InertiaProblem();
  virtual int size() const = 0;
  // Columns of K that this rank passes to minimise(). K is symmetric, so they serve as rows. Others are not read.
  virtual IndexRange columns() const { return {0, size()}; }
  // K v from these columns of all ranks. Collective.
  virtual Eigen::VectorXd multiply(const Eigen::SparseMatrix<double>& K, const Eigen::VectorXd& v) const {
    return K * v;
  }
  // Minimises e(v) + 1/2 v'Kv - r'v, K symmetric. K may be indefinite, so implementations must detect a missing minimum
  // (by a Cholesky factorisation).
  virtual InertiaResponse minimise(const Eigen::SparseMatrix<double>& K, const Eigen::VectorXd& r) = 0;
  virtual InertiaResponse respond(const Eigen::VectorXd& v) = 0;
  // False if minimise() may miss that there is no minimum, and then not converge.
  virtual bool notices_indefinite() const { return true; }
  // Linearises the constraints of minimise() about v from now on.
  virtual void linearise_at(const Eigen::VectorXd& /*v*/) {}
  // True if v has the prescribed velocities at the fixed degrees of freedom. Results of minimise() always have.
  virtual bool holds(const Eigen::VectorXd& v) const;
};

enum class Freedom : char { free, fixed };

// Bodies without liquid: e = 1/2 (v - v*)'M(v - v*). Fixed degrees of freedom have the velocities `held` (m/s, rad/s;
// of the size of v; empty: zero). Their gradient is the constraint impulse.
class DryProblem : public InertiaProblem {
 public:
  DryProblem(Eigen::SparseMatrix<double> mass, Eigen::VectorXd target, std::vector<Freedom> freedom = {},
             Eigen::VectorXd held = {});
  int size() const override { return static_cast<int>(target_.size()); }
  InertiaResponse minimise(const Eigen::SparseMatrix<double>& K, const Eigen::VectorXd& r) override;
  InertiaResponse respond(const Eigen::VectorXd& v) override;
  bool holds(const Eigen::VectorXd& v) const override;

 private:
  Eigen::SparseMatrix<double> mass_;
  Eigen::VectorXd target_;
  std::vector<Freedom> freedom_;
  Eigen::VectorXd held_;
};

}  // namespace seiche
