// Constraint between elastic walls: sealed liquid without a free surface keeps its volume.
#include "coupling/solids/applied_forces.h"
#include "coupling/solids/joints.h"
#include "coupling/solids/kind_elastic.h"
#include "coupling/solids/rebound.h"
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/interaction.h"
#include "coupling/state/state.h"

namespace seiche {
namespace {

template <int Dim>
class Cavities : public Interaction<Dim> {
 public:
  explicit Cavities(const std::vector<Body<Dim>>& bodies) : bodies_(bodies) {}

  void couple(const CoupledStep<Dim>& step, CouplingParts<Dim>& parts) const override {
    parts.coupling.cavities = constrain_cavity_volumes(step, elastic_motions(step.state.solids), parts.entries);
  }

  void keep_over(const State<Dim>& state, double dt, std::vector<Eigen::VectorXd>& velocities) const override {
    keep_cavities(bodies_, elastic_motions(state.solids), {state.time, dt, state.horizon}, velocities);
  }

  void take(const SolidCoupling<Dim>& c, State<Dim>& state) const override {
    for (std::size_t n = 0; n < c.cavities.size(); ++n)
      for (const WallPatch<Dim>& wall : c.cavities[n].walls) {
        ElasticMotion& motion = *elastic_motion(state.solids[std::size_t(wall.body)]);
        motion.cavity[wall.patch] = double(n);
        motion.kept_volume[wall.patch] = c.cavities[n].volume;
      }
  }

  // Cavities found by the trial of the first step keep their volume at the start in the first step, too.
  void inform(const State<Dim>& trial, State<Dim>& state) const override {
    state.sealed = trial.sealed;
    const ElasticMotions tried = elastic_motions(trial.solids);
    for (std::size_t k = 0; k < tried.size(); ++k)
      if (tried[k]) elastic_motion(state.solids[k])->cavity = tried[k]->cavity;
    const ElasticMotions motions = elastic_motions(state.solids);
    for (const CavityWalls<Dim>& walls : kept_cavities(bodies_, motions)) {
      std::vector<Eigen::VectorXd> u;
      for (const WallPatch<Dim>& wall : walls) u.push_back(motions[std::size_t(wall.body)]->state.u);
      const double volume = enclosed_volume(walls, u);
      for (const WallPatch<Dim>& wall : walls)
        elastic_motion(state.solids[std::size_t(wall.body)])->kept_volume[wall.patch] = volume;
    }
  }

 private:
  const std::vector<Body<Dim>>& bodies_;
};

}  // namespace

template <int Dim>
Interactions<Dim> make_interactions(const Domain<Dim>& domain, const std::vector<Body<Dim>>& bodies,
                                    const JointSet<Dim>& joints, const std::vector<Force<Dim>>& forces) {
  Interactions<Dim> list;
  list.push_back(std::make_unique<Cavities<Dim>>(bodies));
  list.push_back(make_rebounds<Dim>());
  if (!joints.list.empty()) list.push_back(make_joint_interaction(joints));
  if (!forces.empty()) list.push_back(make_applied_forces(domain, forces));
  return list;
}

template Interactions<2> make_interactions<2>(const Domain<2>&, const std::vector<Body<2>>&, const JointSet<2>&,
                                              const std::vector<Force<2>>&);
template Interactions<3> make_interactions<3>(const Domain<3>&, const std::vector<Body<3>>&, const JointSet<3>&,
                                              const std::vector<Force<3>>&);

}  // namespace seiche
