#pragma once
// Contact in liquid with few liquid solves. Contact is solved against a quadratic model of the liquid. The liquid's
// response to the velocities found then corrects the model, until both agree.
#include "coupling/solve/liquid_problem.h"
#include "linalg/core/constraint_rows.h"
#include "linalg/core/dense_factors.h"
#include "solid/contact/contact.h"

namespace seiche {

// e(v) = g0.(v - v0) + 1/2 (v - v0)'T (v - v0). T starts as M + c (J'Z)(Z'AZ)^-1(Z'J), the mass and an estimate of the
// added mass c J'A^-1 J, with c = c1 c2 and Z the deflation vectors (linalg/spd/deflation.h). Each liquid solve adds a
// BFGS update.
class AddedMassModel : public InertiaProblem {
 public:
  // g0: true gradient at v0. Fixed degrees of freedom keep v0, and velocities are confined to C v = C v0;
  // up to `slack`, they count as being there.
  AddedMassModel(Eigen::MatrixXd T, const Eigen::VectorXd& v0, const Eigen::VectorXd& g0, std::vector<Freedom> freedom,
                 const SparseMatrix& C = {}, Eigen::VectorXd slack = {});
  int size() const override { return int(v0_.size()); }
  InertiaResponse minimise(const SparseMatrix& K, const Eigen::VectorXd& r) override;
  InertiaResponse respond(const Eigen::VectorXd& v) override;
  bool holds(const Eigen::VectorXd& v) const override;

  // T^-1 (g - model's gradient at v): error of the model's velocities if the true gradient at v is g.
  Eigen::VectorXd error(const Eigen::VectorXd& v, const Eigen::VectorXd& g) const;
  // Updates the model by the true gradient g at v.
  void learn(const Eigen::VectorXd& v, const Eigen::VectorXd& g);

 private:
  void hold_fixed(Eigen::MatrixXd& T) const;
  Eigen::VectorXd masked(Eigen::VectorXd g) const;
  ConstraintRows constraints_with(const DenseLlt& factor) const;

  Eigen::MatrixXd T_;
  Eigen::VectorXd v0_, g0_;
  std::vector<Freedom> freedom_;
  SparseMatrix C_;
  Eigen::VectorXd slack_;
};

struct ContactInLiquid {
  ContactReport contact;
  int corrections = 0;  // liquid solves after the first
  // True: the model agrees with the liquid. False: the velocities are free of intersections and only near the minimum.
  bool agreed = false;
};

// Largest number of bodies for the model. It is dense, so more bodies are faster without it.
constexpr std::size_t most_modelled = 100;

// Minimum of the energy of liquid and bodies with contact and the potential of their joints. The pressure of `problem`
// belongs to the velocities returned. `speeds`: speed of the body's farthest point per unit of each degree of freedom.
// `start`: as of solve_contact(). Collective.
template <int Dim>
ContactInLiquid solve_contact_in_liquid(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions,
                                        double horizon, double dt, const SolidCoupling<Dim>& coupling,
                                        const SpdSolver& solver, LiquidProblem<Dim>& problem,
                                        const Eigen::VectorXd& speeds, double tolerance, const ContactOptions& options,
                                        const Eigen::VectorXd& start);

}  // namespace seiche
