#pragma once
// Contact in liquid with few liquid solves: contact is solved against a model of what the liquid does to the bodies,
// the model is corrected by what the liquid does at the velocities found, and so on until both agree.
#include "coupling/solve/liquid_problem.h"
#include "solid/contact/contact.h"

namespace seiche {

// e(v) = g0.(v - v0) + 1/2 (v - v0)'T (v - v0). T begins as M + c (J'Z)(Z'AZ)^-1(Z'J), the mass and what the columns of
// the preconditioner know of the added mass J'A^-1 J, and learns from each answer (BFGS update).
class AddedMassModel : public InertiaProblem {
 public:
  // v0, g0: velocities and the true gradient there. Fixed degrees of freedom stay as they are.
  AddedMassModel(Eigen::MatrixXd T, const Eigen::VectorXd& v0, const Eigen::VectorXd& g0, std::vector<Freedom> freedom);
  int size() const override { return int(v0_.size()); }
  InertiaResponse minimise(const SparseMatrix& K, const Eigen::VectorXd& r) override;
  InertiaResponse respond(const Eigen::VectorXd& v) override;

  // T^-1 (g - model's gradient at v): how far off the model's velocities are where the true gradient at v is g.
  Eigen::VectorXd error(const Eigen::VectorXd& v, const Eigen::VectorXd& g) const;
  // Takes the true gradient g at v in.
  void learn(const Eigen::VectorXd& v, const Eigen::VectorXd& g);

 private:
  void hold_fixed(Eigen::MatrixXd& T) const;
  Eigen::VectorXd masked(Eigen::VectorXd g) const;

  Eigen::MatrixXd T_;
  Eigen::VectorXd v0_, g0_;
  std::vector<Freedom> freedom_;
};

struct ContactInLiquid {
  ContactReport contact;
  int corrections = 0;  // liquid solves after the first
  // Whether the model came to agree with the liquid. Else the velocities are free of intersections and near the
  // minimum, but not it.
  bool agreed = false;
};

// The model is dense: more bodies than this are quicker without it.
constexpr std::size_t most_modelled = 100;

// The minimum of the liquid's energy with contact; the pressure of `problem` belongs to the velocities returned.
// `speeds` holds, for each degree of freedom, the speed of the body's farthest point where it is one.
template <int Dim>
ContactInLiquid solve_contact_in_liquid(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions,
                                        double horizon, double dt, const SolidCoupling<Dim>& coupling,
                                        const SpdSolver& solver, LiquidProblem<Dim>& problem,
                                        const Eigen::VectorXd& speeds, double tolerance, const ContactOptions& options);

}  // namespace seiche
