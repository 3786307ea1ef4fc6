#pragma once
// Fields of a checkpoint, cut anew when the ranks of a resumed run own other boxes than those that wrote it.
#include <cstdint>
#include <string>
#include <vector>

#include "base/checkpoint_data.h"

namespace seiche {

// Fills `wanted` (boxes without values) piece by piece.
class BoxFiller {
 public:
  explicit BoxFiller(const std::vector<FieldRecord>& wanted);
  // Copies what `source` and the wanted boxes of the same name have in common.
  // Throws Error(bad_checkpoint) when the number of values does not fit the box.
  void take(const FieldRecord& source);
  bool complete() const;
  // The name of the first field with entries missing.
  std::string first_incomplete() const;
  std::vector<FieldRecord> result() && { return std::move(fields_); }

 private:
  std::vector<FieldRecord> fields_;
  std::vector<std::int64_t> missing_;  // entries not yet filled
};

std::int64_t box_entries(const FieldRecord& field);

// "name at (i, j, k)" of the first value that is not finite, or "".
std::string first_not_finite(const std::vector<FieldRecord>& fields);

}  // namespace seiche
