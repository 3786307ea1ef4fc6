#pragma once
// A State as named records and back, bit for bit.
#include "base/checkpoint_data.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
CheckpointData save_state(const Setup<Dim>& setup, const State<Dim>& state);

template <int Dim>
State<Dim> load_state(const Setup<Dim>& setup, const CheckpointData& data);

// The boxes of this rank's records for the levels that `scalars` of a checkpoint speak of; values empty.
template <int Dim>
std::vector<FieldRecord> state_boxes(const Setup<Dim>& setup);

}  // namespace seiche
