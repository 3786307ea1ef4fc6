#pragma once
// Generalised directions of impacts of rigid solids: with impulses of contact lambda_p, the column W of a pair is their
// sum over Lambda = sum |lambda_p|, so that W'v is the speed at which the pair parts, their mean weighted by them.
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/impact.h"
#include "coupling/state/state.h"

namespace seiche {

struct ImpactColumn {
  std::array<int, 2> first_unknown{-1, -1};             // of both solids; below 0: it has none
  std::array<Eigen::VectorXd, 2> part;                  // of W; the second with its sign
  double prescribed = 0;                                // speed at which prescribed motion parts the pair, m/s
  double size = 0;                                      // Lambda, N s
  std::array<Vec3, 2> arm{Vec3::Zero(), Vec3::Zero()};  // mean place from the centres of mass, m

  double parting(const Eigen::VectorXd& v) const;
  void add_to(Eigen::VectorXd& push, double impulse) const;
};

template <int Dim>
class ImpactColumns {
 public:
  ImpactColumns(const State<Dim>& state, const SolidCoupling<Dim>& coupling, double horizon)
      : state_(state), coupling_(coupling), horizon_(horizon) {}
  ImpactColumn column(int first, int second, const std::vector<Impact::Impulse>& impulses) const;
  // W_i'M^-1 W_j without liquid.
  double product(const ImpactColumn& a, const ImpactColumn& b) const { return dot(a, over_mass(b)); }
  Eigen::MatrixXd products(const std::vector<ImpactColumn>& columns) const;
  // The centre of mass of rigid solid k at the solve, m; nothing for others.
  std::optional<Vec3> center(int k) const;
  // First unknown of solid k in the solve; -1: none.
  int first_unknown(int k) const;
  // Change of velocity of side 0 or 1 of the pair at its mean place, by a change dv of all unknowns.
  Vec3 change_at(const ImpactColumn& column, int side, const Eigen::VectorXd& dv) const;

 private:
  static double dot(const ImpactColumn& a, const ImpactColumn& b);
  ImpactColumn over_mass(ImpactColumn column) const;  // M^-1 W
  std::array<Vec3, 2> arms_at_one_place(int first, int second, const Impact::Impulse& i) const;
  Eigen::VectorXd without_held(int first, Eigen::VectorXd v) const;

  const State<Dim>& state_;
  const SolidCoupling<Dim>& coupling_;
  double horizon_;
};

}  // namespace seiche
