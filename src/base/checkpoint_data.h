#pragma once
// The state of a run as plain named data, so that src/files stores it without knowing the simulation's types.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/packed_values.h"

namespace seiche {

// This rank's part of one grid field: the entries with lower <= index < upper, first axis fastest. The boxes of all
// ranks tile the field without overlap. An idle rank has an empty box.
struct FieldRecord {
  std::string name;
  std::array<int, 3> lower{0, 0, 0}, upper{0, 0, 0};
  PackedValues values;
};

struct CheckpointData {
  std::map<std::string, double> scalars;     // equal on all ranks; stored exactly
  std::map<std::string, std::string> texts;  // equal on all ranks
  std::vector<FieldRecord> fields;           // same names in the same order on all ranks
};

}  // namespace seiche
