// Solids at rest.
#include "coupling/solids/solid_kinds.h"
#include "coupling/state/participant.h"

namespace seiche {
namespace {

template <int Dim>
class StaticParticipant : public Participant<Dim> {
 public:
  using Participant<Dim>::Participant;
  std::unique_ptr<Participant<Dim>> copy() const override { return std::make_unique<StaticParticipant>(*this); }
};

}  // namespace

SolidKindRow static_solid() {
  return {
      SolidKind::fixed, "at rest", {}, make_participant<StaticParticipant<2>>, make_participant<StaticParticipant<3>>};
}

}  // namespace seiche
