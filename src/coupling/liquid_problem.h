#pragma once
// What contacts push against: the bodies' inertia and the liquid's pressure, as one quadratic energy.
#include "coupling/rigid_coupling.h"

namespace seiche {

// e(v) = 1/2 (v - v*)'M(v - v*) + the kinetic energy the liquid must gain to make room, A p + c1 J v = b:
//   grad e = M (v - v*) - c2 J'p,  c1 = rho h/dt, c2 = dt A_f.
// With a contact Hessian K, H = M + K:  (A + c1 c2 J H^-1 J') p = b - c1 J H^-1 (M v* + r),  H v = M v* + r + c2 J'p.
// After some such solves the added mass is worked out, with one solve a column of J:
//   G = c1 c2 J'A^-1 J,  (M + G + K) v = M v* + r + c2 J'p0,  A p0 = b,
// and no further iteration touches the liquid.
template <int Dim>
class LiquidProblem : public InertiaProblem {
 public:
  // Keeps references; `pressure` is the first guess and holds the last solution.
  LiquidProblem(const RigidCoupling<Dim>& coupling, SpdSolver& solver, const Vector& b, Vector& pressure, double c1,
                double c2, const Communicator& ranks);
  int size() const override { return int(coupling_.target.size()); }
  InertiaResponse minimise(const SmallMatrix& K, const Eigen::VectorXd& r) override;
  InertiaResponse respond(const Eigen::VectorXd& v) override;

  const SolveReport& report() const { return report_; }  // of all solves so far

 private:
  Eigen::VectorXd masked(Eigen::VectorXd v) const;
  SmallMatrix masked(const SmallMatrix& K) const;
  std::string solve(const SmallMatrix& H, const Vector& b, Vector& p, double scale);
  Eigen::VectorXd impulse_of_pressure() const;
  bool can_build_added_mass() const;
  int solves_before_added_mass() const;
  std::string build_added_mass();
  InertiaResponse minimise_with_added_mass(const SmallMatrix& K, const Eigen::VectorXd& r) const;
  InertiaResponse respond_with_pressure(const Eigen::VectorXd& v, const Eigen::VectorXd& force) const;

  const RigidCoupling<Dim>& coupling_;
  SpdSolver& solver_;
  const Vector& b_;
  Vector& pressure_;
  double c1_, c2_;
  Communicator ranks_;
  // What the tolerance is relative to: the flows that liquid and bodies would have alone. Not the right-hand side,
  // which grows without bound for ever lighter bodies.
  double scale_ = 0;
  SolveReport report_;
  int coupled_solves_ = 0;
  struct AddedMass {
    Vector p0;                    // A p0 = b
    std::vector<Vector> columns;  // of A^-1 J, empty where J's is zero
    Eigen::VectorXd impulse;      // c2 J'p0
    Eigen::MatrixXd G;
  };
  std::unique_ptr<AddedMass> added_;
};

}  // namespace seiche
