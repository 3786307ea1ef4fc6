#pragma once
// What stands behind the bodies of one contact solve (inertia, and liquid where there is any), as a quadratic
// energy.
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

namespace seiche {

// Generalised velocities of one body: (v of the centre of mass, omega), in 2D (v_x, v_y, omega_z).
template <int Dim>
constexpr int twist_size = Dim == 2 ? 3 : 6;

enum class Shape : char { convex, indefinite };

// The gradient of e at `velocity` is the impulse that acts on each degree of freedom (N s, N m s).
struct InertiaResponse {
  std::string failure;          // empty if it went well
  Shape shape = Shape::convex;  // indefinite: there is no minimum, nothing else is set
  Eigen::VectorXd velocity, gradient;
  // The part of the gradient that multipliers of constraints on v make up, of the constraints' own scale: where they
  // were not met at the velocity, it says nothing. Empty: there is none.
  Eigen::VectorXd constraint = {};
};

// e(v), a convex quadratic in the stacked generalised velocities of the free bodies and of the nodes of deformable ones
// (J).
class InertiaProblem {
 public:
  virtual ~InertiaProblem();
  virtual int size() const = 0;
  // The v that minimises e(v) + 1/2 v'Kv - r'v, K symmetric. That this has a minimum must be found out (by a Cholesky
  // factor): K is not always positive semi-definite.
  virtual InertiaResponse minimise(const Eigen::SparseMatrix<double>& K, const Eigen::VectorXd& r) = 0;
  virtual InertiaResponse respond(const Eigen::VectorXd& v) = 0;
  // The constraints that minimise() is to meet are taken to first order about v from now on.
  virtual void linearise_at(const Eigen::VectorXd& /*v*/) {}
  // Whether the degrees of freedom that are held have their prescribed velocities at v; those that minimise() returns
  // do.
  virtual bool holds(const Eigen::VectorXd& v) const;
};

enum class Freedom : char { free, fixed };

// Bodies without liquid: e = 1/2 (v - v*)'M(v - v*). Fixed degrees of freedom have the velocities `held` (m/s, rad/s;
// of the size of v, or empty: zero); their gradient is the impulse that would hold them.
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
