#include "files/checkpoint_boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace seiche {
namespace {

using Index = std::array<int, 3>;

std::size_t offset_in(const FieldRecord& field, const Index& i) {
  const auto extent = [&](int axis) { return std::size_t(field.upper[axis] - field.lower[axis]); };
  return std::size_t(i[0] - field.lower[0]) +
         extent(0) * (std::size_t(i[1] - field.lower[1]) + extent(1) * std::size_t(i[2] - field.lower[2]));
}

// Copies the intersection of `from` and `to` row by row; returns its number of entries. Both hold `components` values
// an entry.
std::int64_t copy_common(const FieldRecord& from, const FieldRecord& to, std::size_t components,
                         std::vector<double>& target) {
  FieldRecord common;
  for (int axis = 0; axis < 3; ++axis) {
    common.lower[axis] = std::max(from.lower[axis], to.lower[axis]);
    common.upper[axis] = std::min(from.upper[axis], to.upper[axis]);
  }
  const std::int64_t entries = box_entries(common);
  if (entries == 0) return 0;
  const std::vector<double> source = from.values.unpack();
  target.resize(std::size_t(box_entries(to)) * components);
  const std::size_t row = std::size_t(common.upper[0] - common.lower[0]) * components;
  for (int k = common.lower[2]; k < common.upper[2]; ++k) {
    for (int j = common.lower[1]; j < common.upper[1]; ++j) {
      const Index start{common.lower[0], j, k};
      std::copy_n(source.data() + offset_in(from, start) * components, row,
                  target.data() + offset_in(to, start) * components);
    }
  }
  return entries;
}

}  // namespace

std::int64_t box_entries(const FieldRecord& field) {
  std::int64_t n = 1;
  for (int axis = 0; axis < 3; ++axis) n *= std::max(0, field.upper[axis] - field.lower[axis]);
  return n;
}

BoxFiller::BoxFiller(const std::vector<FieldRecord>& wanted) : fields_(wanted), pieces_(wanted.size()) {
  for (const FieldRecord& field : fields_) missing_.push_back(box_entries(field));
}

void BoxFiller::take(const FieldRecord& source) {
  const std::int64_t entries = box_entries(source);
  if (entries == 0) return;
  const std::size_t components = source.values.size() / std::size_t(entries);
  if (components == 0 || components * std::size_t(entries) != source.values.size()) {
    throw Error(ExitCode::bad_checkpoint, fmt::format("field {} has {} values in a box of {} entries", source.name,
                                                      source.values.size(), entries));
  }
  for (std::size_t n = 0; n < fields_.size(); ++n) {
    FieldRecord& field = fields_[n];
    if (field.name != source.name) continue;
    if (field.lower == source.lower && field.upper == source.upper) {
      field.values = source.values;
      missing_[n] = 0;
    } else {
      missing_[n] -= copy_common(source, field, components, pieces_[n]);
    }
  }
}

std::vector<FieldRecord> BoxFiller::result() && {
  for (std::size_t n = 0; n < fields_.size(); ++n)
    if (!pieces_[n].empty()) fields_[n].values = PackedValues(std::exchange(pieces_[n], {}));
  return std::move(fields_);
}

bool BoxFiller::complete() const {
  return first_incomplete().empty();
}

std::string BoxFiller::first_incomplete() const {
  for (std::size_t n = 0; n < fields_.size(); ++n) {
    if (missing_[n] > 0) return fields_[n].name;
  }
  return {};
}

std::string first_not_finite(const std::vector<FieldRecord>& fields) {
  for (const FieldRecord& field : fields) {
    const auto n = std::int64_t(field.values.first_not_finite());
    if (n == std::int64_t(field.values.size())) continue;
    const std::int64_t nx = std::max(1, field.upper[0] - field.lower[0]),
                       ny = std::max(1, field.upper[1] - field.lower[1]);
    return fmt::format("{} at ({}, {}, {})", field.name, field.lower[0] + n % nx, field.lower[1] + n / nx % ny,
                       field.lower[2] + n / (nx * ny));
  }
  return {};
}

}  // namespace seiche
