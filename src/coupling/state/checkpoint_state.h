#pragma once
// Converts a State to named records and back, bit for bit.
#include "base/checkpoint_data.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
CheckpointData save_state(const Setup<Dim>& setup, const State<Dim>& state);

// Throws Error(bad_checkpoint) if a record is missing or its size differs. Ghosts filled. Collective.
template <int Dim>
State<Dim> load_state(const Setup<Dim>& setup, const CheckpointData& data);

// Names and boxes of the fields that load_state() reads on this rank; values empty.
template <int Dim>
std::vector<FieldRecord> state_boxes(const Setup<Dim>& setup);

}  // namespace seiche
