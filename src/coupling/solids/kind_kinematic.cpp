// Solids that move as prescribed.
#include "base/time_spec.h"
#include "coupling/solids/solid_kinds.h"
#include "coupling/state/state.h"

namespace seiche {
namespace {

template <int Dim>
class KinematicParticipant : public Participant<Dim> {
 public:
  using Participant<Dim>::Participant;
  using Participant<Dim>::body;
  std::unique_ptr<Participant<Dim>> copy() const override { return std::make_unique<KinematicParticipant>(*this); }

  Placement place(double t0, double t1, double t) const override {
    Placement p{body().pose(t), body().twist(t0, t1), {}, {}};
    if (t != t1) p.twist.about = p.pose.pivot + p.pose.displacement;
    return p;
  }
  Placement prescribed_part(Placement placed) const override { return placed; }

  // Before the first step there is no mean over a step. The difference over 1e-4 frames bounds truncation and
  // cancellation errors by 1e-8.
  void describe(const TimeSpec& time, const State<Dim>& state, SolidState& out) const override {
    if (state.step > 0) return;
    const Twist v = body().velocity(state.time, 1e-4 / time.frame_rate);
    out.velocity = v.at(out.position);
    out.angular_velocity = v.angular;
  }
};

}  // namespace

SolidKindRow kinematic_solid() {
  return {SolidKind::kinematic,
          "moves as prescribed",
          {},
          make_participant<KinematicParticipant<2>>,
          make_participant<KinematicParticipant<3>>};
}

}  // namespace seiche
