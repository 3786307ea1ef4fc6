#pragma once
// Connected components of rows across ranks. The label of a component is its smallest row.
#include <cstring>
#include <map>
#include <string>

#include "base/disjoint_sets.h"
#include "fluid/pressure/pressure.h"

namespace seiche {

// Rows of cells are joined by open faces. Each region of air is a further node after this rank's rows. All ranks share
// these nodes, so that all rows that touch a region are joined.
template <int Dim>
class Labelling {
 public:
  // Keeps references. Collective.
  Labelling(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows)
      : in_(in),
        rows_(rows),
        sets_(rows.cells.size() + rows.air_row.size()),
        label_(rows.cells.size() + rows.air_row.size(), std::numeric_limits<std::int64_t>::max()),
        field_(in.layout, -1) {
    join_rows();
    for (std::size_t n = 0; n < label_.size(); ++n) {
      const bool is_row = n < rows.cells.size();
      adopt(int(n), is_row ? rows.first + Row(n) : rows.air_row[n - rows.cells.size()]);
    }
    while (adopt_from_neighbours()) {
    }
  }

  std::int64_t label(int n) { return label_[sets_.root(n)]; }

 private:
  int node_of_region(std::int64_t k) const { return int(rows_.cells.size()) + int(k); }
  bool owned(std::int64_t local) const { return local >= 0 && local < std::int64_t(rows_.cells.size()); }

  void join_rows() {
    for (int n = 0; n < int(rows_.liquid); ++n)
      for_each_open_link(n, [&](Site across) {
        const std::int64_t other = rows_.row[across] - rows_.first, region = rows_.region(across);
        if (region >= 0)
          sets_.join(n, node_of_region(region));
        else if (owned(other))
          sets_.join(n, int(other));
      });
    for (std::size_t n = rows_.liquid; n < rows_.cells.size(); ++n)
      sets_.join(int(n), node_of_region(rows_.region(rows_.cells[n])));
  }

  template <class Visit>
  void for_each_open_link(int n, const Visit& visit) const {
    for_each_face_of(in_.layout, rows_.cells[n], [&](int a, Site f, int, Site across) {
      if (in_.faces.kind_at(a, f) == FaceKind::open && rows_.row[across] >= 0) visit(across);
    });
  }

  bool adopt(int n, std::int64_t label) {
    std::int64_t& mine = label_[sets_.root(n)];
    if (label >= mine) return false;
    mine = label;
    return true;
  }

  bool adopt_from_neighbours() {
    for (std::size_t n = 0; n < rows_.liquid; ++n) field_[rows_.cells[n]] = label(int(n));
    in_.halo.fill_ghosts({field_.data()});
    bool changed = false;
    for (int n = 0; n < int(rows_.liquid); ++n)
      for_each_open_link(n, [&](Site across) {
        if (field_[across] >= 0) changed = adopt(n, field_[across]) || changed;
      });
    changed = adopt_of_regions() || changed;
    return in_.ranks.any(changed);
  }

  // Takes the smallest label of each region of air over all ranks.
  bool adopt_of_regions() {
    const std::size_t count = rows_.air_row.size();
    if (count == 0) return false;
    std::vector<std::int64_t> labels(count);
    for (std::size_t k = 0; k < count; ++k) labels[k] = label(node_of_region(std::int64_t(k)));
    bool changed = false;
    const std::string bytes(reinterpret_cast<const char*>(labels.data()), count * sizeof(std::int64_t));
    for (const std::string& part : in_.ranks.all_gather(bytes)) {
      std::memcpy(labels.data(), part.data(), part.size());
      for (std::size_t k = 0; k < count; ++k) changed = adopt(node_of_region(std::int64_t(k)), labels[k]) || changed;
    }
    return changed;
  }

  const ProjectionInput<Dim>& in_;
  const PressureRows<Dim>& rows_;
  DisjointSets sets_;
  std::vector<std::int64_t> label_;
  CellField<Dim, std::int64_t> field_;
};

// Logical or over all ranks, by label. Collective.
std::map<std::int64_t, bool> any_of_labels(const std::map<std::int64_t, bool>& mine, const Communicator& ranks);

}  // namespace seiche
