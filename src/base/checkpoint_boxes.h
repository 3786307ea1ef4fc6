#pragma once
// Redistribution of fields to ranks that own other boxes: of a checkpoint, or of a run whose blocks change.
#include <cstdint>
#include <string>
#include <vector>

#include "base/checkpoint_data.h"
#include "base/communicator.h"

namespace seiche {

// Fills the boxes of `wanted` (given without values) piece by piece.
class BoxFiller {
 public:
  explicit BoxFiller(const std::vector<FieldRecord>& wanted);
  // Copies the intersection of `source` with the wanted boxes of the same name. Throws Error(bad_checkpoint) if the
  // number of values does not match the box.
  void take(const FieldRecord& source);
  bool complete() const;
  // Name of the first field with missing entries.
  std::string first_incomplete() const;
  std::vector<FieldRecord> result() &&;

 private:
  std::vector<FieldRecord> fields_;
  std::vector<std::vector<double>> pieces_;  // of fields that come from more than one box
  std::vector<std::int64_t> missing_;        // entries not yet filled
};

// The fields in the boxes of `wanted` (without values), from those of all ranks. Both have the same names, all
// different, in the same order on all ranks. Throws Error(bad_checkpoint) if the boxes do not hold all that is wanted.
// Collective.
std::vector<FieldRecord> redistribute(const std::vector<FieldRecord>& own, const std::vector<FieldRecord>& wanted,
                                      const Communicator& ranks);

std::int64_t box_entries(const FieldRecord& field);

// "name at (i, j, k)" of the first value that is not finite, or "".
std::string first_not_finite(const std::vector<FieldRecord>& fields);

}  // namespace seiche
