#pragma once
// Generalised directions of impacts of rigid solids: with impulses of contact lambda_p, the column W of a pair is their
// sum over Lambda = sum |lambda_p|, so that W'v is the speed at which the pair parts, their mean weighted by them.
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/impact.h"
#include "coupling/state/state.h"
#include "linalg/core/body_matrix.h"

namespace seiche {

struct ImpactColumn {
  std::array<int, 2> first_unknown{-1, -1};             // of both solids; below 0: it has none
  std::array<Eigen::VectorXd, 2> part;                  // of W; the second with its sign
  double prescribed = 0;                                // speed at which prescribed motion parts the pair, m/s
  double size = 0;                                      // Lambda, N s
  std::array<Vec3, 2> arm{Vec3::Zero(), Vec3::Zero()};  // mean place from the centres of mass, m

  double parting(const Eigen::VectorXd& v) const { return prescribed + dot(v); }
  double dot(const Eigen::VectorXd& v) const;  // W'v
  void add_to(Eigen::VectorXd& push, double impulse) const;
};

// M of a solve with its joints, factored; null without joints. Collective.
template <int Dim>
std::shared_ptr<const BodyMatrix> jointed_inertia(const SolidCoupling<Dim>& coupling, const Communicator& ranks);

template <int Dim>
class ImpactColumns {
 public:
  // `jointed`: that of jointed_inertia(). Responses to impulses are collective with it.
  ImpactColumns(const State<Dim>& state, const SolidCoupling<Dim>& coupling, std::shared_ptr<const BodyMatrix> jointed,
                double horizon);
  ImpactColumn column(int first, int second, const std::vector<Impact::Impulse>& impulses) const;
  // W_i'M^-1 W_j without liquid, on the motions that joints allow.
  double product(const ImpactColumn& a, const ImpactColumn& b) const { return a.dot(response(b)); }
  Eigen::MatrixXd products(const std::vector<ImpactColumn>& columns) const;
  // The centre of mass of rigid solid k at the solve, m; nothing for others.
  std::optional<Vec3> center(int k) const;
  // First unknown of solid k in the solve; -1: none.
  int first_unknown(int k) const;
  // True if an impulse on solid a moves solid b: both are rigid, and the same or joined, perhaps by others.
  bool moves_with(int a, int b) const;
  // Change of velocity of side 0 or 1 of the pair at its mean place, by a change dv of all unknowns.
  Vec3 change_at(const ImpactColumn& column, int side, const Eigen::VectorXd& dv) const;

 private:
  Eigen::VectorXd response(const ImpactColumn& column) const;  // M^-1 W
  int block(int k) const;                                      // of solid k; -1: it has no unknowns
  std::array<Vec3, 2> arms_at_one_place(int first, int second, const Impact::Impulse& i) const;
  Eigen::VectorXd without_held(int first, Eigen::VectorXd v) const;

  const State<Dim>& state_;
  const SolidCoupling<Dim>& coupling_;
  std::shared_ptr<const BodyMatrix> jointed_;
  std::vector<int> group_;  // of each block: the smallest one that joints link it to
  double horizon_;
};

}  // namespace seiche
