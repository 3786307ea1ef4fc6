#include "base/checkpoint_boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
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

FieldRecord common_box(const FieldRecord& a, const FieldRecord& b) {
  FieldRecord common;
  for (int axis = 0; axis < 3; ++axis) {
    common.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
    common.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
  }
  return common;
}

// Copies the intersection of the boxes of `from` and `to` row by row; returns its number of entries. Both hold
// `components` values an entry, those of `from` in `source`.
std::int64_t copy_common(const FieldRecord& from, const std::vector<double>& source, const FieldRecord& to,
                         std::size_t components, std::vector<double>& target) {
  const FieldRecord common = common_box(from, to);
  const std::int64_t entries = box_entries(common);
  if (entries == 0) return 0;
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

using Bounds = std::array<int, 6>;

Bounds bounds_of(const FieldRecord& field) {
  return {field.lower[0], field.lower[1], field.lower[2], field.upper[0], field.upper[1], field.upper[2]};
}

FieldRecord box_of(const std::string& name, const Bounds& b) {
  return {name, {b[0], b[1], b[2]}, {b[3], b[4], b[5]}, {}};
}

template <class T>
std::string bytes_of(const T* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}

// Box and values of what `from` and `to` share; empty: nothing.
std::string message_for(const FieldRecord& from, const std::vector<double>& source, const FieldRecord& to) {
  const FieldRecord common = common_box(from, to);
  std::vector<double> values;
  if (copy_common(from, source, common, 1, values) == 0) return {};
  const Bounds bounds = bounds_of(common);
  return bytes_of(bounds.data(), bounds.size()) + bytes_of(values.data(), values.size());
}

FieldRecord read_message(const std::string& name, const std::string& bytes) {
  Bounds bounds;
  std::memcpy(bounds.data(), bytes.data(), sizeof(bounds));
  FieldRecord field = box_of(name, bounds);
  std::vector<double> values((bytes.size() - sizeof(bounds)) / sizeof(double));
  std::memcpy(values.data(), bytes.data() + sizeof(bounds), values.size() * sizeof(double));
  field.values = PackedValues(values);
  return field;
}

// Messages of one field to all ranks, which want the boxes in `all`.
std::vector<std::string> messages(const FieldRecord& own, const std::vector<std::string>& all) {
  const std::vector<double> source = own.values.unpack();
  std::vector<std::string> to;
  for (const std::string& text : all) {
    Bounds bounds;
    std::memcpy(bounds.data(), text.data(), sizeof(bounds));
    to.push_back(message_for(own, source, box_of(own.name, bounds)));
  }
  return to;
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
    } else if (box_entries(common_box(source, field)) > 0) {
      missing_[n] -= copy_common(source, source.values.unpack(), field, components, pieces_[n]);
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

std::vector<FieldRecord> redistribute(const std::vector<FieldRecord>& own, const std::vector<FieldRecord>& wanted,
                                      const Communicator& ranks) {
  BoxFiller filler(wanted);
  for (std::size_t n = 0; n < own.size(); ++n) {
    const Bounds bounds = bounds_of(wanted[n]);
    const std::vector<std::string> all = ranks.all_gather(bytes_of(bounds.data(), bounds.size()));
    for (const std::string& bytes : ranks.exchange(messages(own[n], all)))
      if (!bytes.empty()) filler.take(read_message(own[n].name, bytes));
  }
  if (!filler.complete())
    throw Error(ExitCode::bad_checkpoint, fmt::format("no rank holds all of the field {}", filler.first_incomplete()));
  return std::move(filler).result();
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
