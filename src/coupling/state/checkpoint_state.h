#pragma once
// A State as named records and back, bit for bit.
#include "base/checkpoint_data.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

template <int Dim>
CheckpointData save_state(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                          const State<Dim>& state);

template <int Dim>
State<Dim> load_state(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                      const CheckpointData& data);

// The boxes of this rank's records for the levels that `scalars` of a checkpoint speak of; values empty.
template <int Dim>
std::vector<FieldRecord> state_boxes(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids);

}  // namespace seiche
