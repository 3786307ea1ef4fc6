#pragma once
// The one table of kinds of solids: scenes, documentation and the simulation loop over it.
#include <memory>
#include <string>
#include <vector>

#include "base/options.h"
#include "base/solid_kind.h"

namespace seiche {

template <int Dim>
class Body;
template <int Dim>
class Participant;
template <int Dim>
class Participants;

struct SolidKindRow {
  SolidKind kind;
  std::string doc;              // cause of its motion, for the scene reference
  std::vector<Option> numbers;  // keys of its own, SolidSpec::numbers
  std::unique_ptr<Participant<2>> (*make_2d)(const Body<2>&, int index);
  std::unique_ptr<Participant<3>> (*make_3d)(const Body<3>&, int index);
};

const std::vector<SolidKindRow>& solid_kinds();

// The solids of a scene at the start. They keep references to the bodies.
template <int Dim>
Participants<Dim> make_participants(const std::vector<Body<Dim>>& bodies);

}  // namespace seiche
