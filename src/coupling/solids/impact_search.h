#pragma once
// Impacts that begin, go on and end in a solve.
#include <map>

#include "coupling/solids/impact_columns.h"
#include "coupling/state/setup.h"

namespace seiche {

// Velocities of all unknowns, m/s and rad/s.
struct ImpactVelocities {
  const Eigen::VectorXd &before, &alone, &free, &after;  // the solve; without contact and rebounds; without contact
};

// Groups of impacts that share free solids or whose solids joints link, in the order of their first members.
template <int Dim>
std::vector<Impacts> clusters_of(const Impacts& impacts, const ImpactColumns<Dim>& columns);

template <int Dim>
class ImpactSearch {
 public:
  ImpactSearch(const Setup<Dim>& setup, const State<Dim>& state, ImpactColumns<Dim> columns, double dt, double horizon,
               const ImpactVelocities& v)
      : setup_(setup), state_(state), columns_(std::move(columns)), dt_(dt), horizon_(horizon), v_(v) {}
  // Continues the impacts that were under way before the solve, with the impulses of contact `pairs`, and those that
  // have rebounded in it. Collective.
  Impacts run(const std::vector<PairImpulse>& pairs) const;

 private:
  using SolidPair = std::array<int, 2>;
  using Push = std::vector<Impact::Impulse>;
  using Pushes = std::map<SolidPair, Push>;

  std::optional<double> coefficient(int a, int b) const;
  Pushes pushes_of(const std::vector<PairImpulse>& pairs) const;
  ImpactColumn column_of(const Impact& impact) const {
    return columns_.column(impact.first, impact.second, impact.impulses);
  }
  double driven(const ImpactColumn& column) const;
  double least_approach(const ImpactColumn& column) const;
  Impact begun(const SolidPair& pair, const Push& push) const;
  bool is_fast(const SolidPair& pair, const Push& push) const;
  bool touches(const SolidPair& pair, const Impacts& impacts) const;
  void go_on(const Push& push, Impact& impact) const;
  void begin(Pushes pushes, Impacts& impacts) const;
  bool is_over(const Impacts& cluster) const;
  void set_rebounds(Impacts& cluster) const;
  Impact rebounded(const Impact& earlier, bool is_pushed) const;

  const Setup<Dim>& setup_;
  const State<Dim>& state_;
  const ImpactColumns<Dim> columns_;
  double dt_, horizon_;
  ImpactVelocities v_;
};

}  // namespace seiche
