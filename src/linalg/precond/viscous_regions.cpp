#include "linalg/precond/viscous_regions.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <set>

namespace seiche {
namespace {

// Diagonals and links of liquid of one viscosity vary by less; levels are further apart, or what differs between them
// would often be a fringe of faces alone.
constexpr double alike = 30, level_ratio = 1000;

// Sets of this rank's rows that are joined, each with the lowest row that it is known to reach.
class JoinedRows {
 public:
  explicit JoinedRows(const LinearSystem& F) : F_(F), parent_(std::size_t(F.rows())) {}

  // Of rows with a diagonal of at least `level`. Collective. The lowest row of each row's set; -1 without one.
  const Vector& label(double level) {
    std::iota(parent_.begin(), parent_.end(), 0);
    set_flags(level);
    const DistributedMatrix& P = F_.pattern();
    for_each_link(level, [&](int i, int j) {
      if (j < F_.rows()) join(i, j);
    });
    label_.assign(flags_.size(), -1.0);
    for (int i = 0; i < F_.rows(); ++i)
      if (flags_[std::size_t(i)] != 0) label_[std::size_t(i)] = double(P.first_row + root(i));
    while (F_.ranks().any(take_from_others(level))) {
    }
    return label_;
  }
  // Of sets with rows of other ranks beside this one's, at that level.
  std::set<Row> labels_across(double level) const {
    std::set<Row> labels;
    for_each_link(level, [&](int i, int j) {
      if (j >= F_.rows()) labels.insert(Row(label_[std::size_t(i)]));
    });
    return labels;
  }

 private:
  void set_flags(double level) {
    flags_.assign(std::size_t(F_.rows() + F_.halo().ghosts()), 0.0);
    for (int i = 0; i < F_.rows(); ++i) flags_[std::size_t(i)] = F_.diagonal(i) >= level;
    F_.halo().fill_ghosts(flags_);
  }
  template <class Visit>
  void for_each_link(double level, Visit visit) const {
    const DistributedMatrix& P = F_.pattern();
    for (int i = 0; i < F_.rows(); ++i) {
      if (flags_[std::size_t(i)] == 0) continue;
      for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k) {
        if (std::abs(F_.values()[std::size_t(k)]) * alike < level) continue;
        const int j = F_.halo().local_index(P.column[k]);
        if (flags_[std::size_t(j)] != 0) visit(i, j);
      }
    }
  }
  int root(int i) {
    while (parent_[std::size_t(i)] != i) i = parent_[std::size_t(i)] = parent_[std::size_t(parent_[std::size_t(i)])];
    return i;
  }
  void join(int i, int j) {
    const int a = root(i), b = root(j);
    parent_[std::size_t(std::max(a, b))] = std::min(a, b);
  }
  // The labels of linked rows of other ranks, where lower. Whether any was.
  bool take_from_others(double level) {
    F_.halo().fill_ghosts(label_);
    bool changed = false;
    for_each_link(level, [&](int i, int j) {
      if (j < F_.rows()) return;
      double& own = label_[std::size_t(root(i))];
      if (label_[std::size_t(j)] < own) own = label_[std::size_t(j)], changed = true;
    });
    for (int i = 0; i < F_.rows(); ++i)
      if (flags_[std::size_t(i)] != 0) label_[std::size_t(i)] = label_[std::size_t(root(i))];
    return changed;
  }

  const LinearSystem& F_;
  std::vector<int> parent_;
  Vector flags_, label_;  // with ghosts
};

struct Count {
  Row label;
  std::int64_t rows;
};

// Over all ranks, of sets with at least `fewest` rows; of smaller ones only those `across` ranks are heard of.
std::vector<ViscousRegion> count_sets(const LinearSystem& F, const Vector& label, const std::set<Row>& across,
                                      int fewest) {
  std::map<Row, std::int64_t> mine, all;
  for (int i = 0; i < F.rows(); ++i)
    if (label[std::size_t(i)] >= 0) ++mine[Row(label[std::size_t(i)])];
  std::string bytes;
  for (const auto& [first, rows] : mine) {
    const Count count{first, rows};
    if (rows >= fewest || across.count(first)) bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  }
  for (const std::string& part : F.ranks().all_gather(bytes))
    for (std::size_t k = 0; k < part.size(); k += sizeof(Count)) {
      Count count;
      std::memcpy(&count, part.data() + k, sizeof count);
      all[count.label] += count.rows;
    }
  std::vector<ViscousRegion> sets;
  for (const auto& [first, rows] : all)
    if (rows >= fewest) sets.push_back({first, rows, {}});
  return sets;
}

void keep_largest(std::vector<ViscousRegion>& regions, std::size_t most) {
  std::stable_sort(regions.begin(), regions.end(),
                   [](const ViscousRegion& a, const ViscousRegion& b) { return a.size > b.size; });
  if (regions.size() > most) regions.resize(most);
}

// Takes out sets that are next to what an earlier level found. Collective.
void drop_known(const LinearSystem& F, const Vector& label, const std::vector<ViscousRegion>& known,
                std::vector<ViscousRegion>& sets) {
  constexpr double as_large = 1.05;
  for (const ViscousRegion& region : known) {
    const double own = region.row.empty() ? -1 : label[std::size_t(region.row.front())];
    const Row around = Row(F.ranks().global_max(own));
    std::erase_if(sets, [&](const ViscousRegion& s) {
      return s.first == around && double(s.size) <= as_large * double(region.size);
    });
  }
}

void take_rows(const LinearSystem& F, const Vector& label, std::vector<ViscousRegion>& sets) {
  std::map<Row, ViscousRegion*> by_label;
  for (ViscousRegion& s : sets) by_label[s.first] = &s;
  for (int i = 0; i < F.rows(); ++i)
    if (const auto s = by_label.find(Row(label[std::size_t(i)])); s != by_label.end()) s->second->row.push_back(i);
}

}  // namespace

std::vector<ViscousRegion> find_viscous_regions(const LinearSystem& F, int fewest, std::size_t most) {
  double low = INFINITY, high = 0;
  for (int i = 0; i < F.rows(); ++i) low = std::min(low, F.diagonal(i)), high = std::max(high, F.diagonal(i));
  low = F.ranks().global_min(low), high = F.ranks().global_max(high);
  JoinedRows joined(F);
  std::vector<ViscousRegion> regions;
  for (double level = high / alike; level > 0; level /= level_ratio) {
    const Vector& label = joined.label(level);
    std::vector<ViscousRegion> sets = count_sets(F, label, joined.labels_across(level), fewest);
    drop_known(F, label, regions, sets);
    keep_largest(sets, most);
    take_rows(F, label, sets);
    std::move(sets.begin(), sets.end(), std::back_inserter(regions));
    keep_largest(regions, most);
    if (level <= low) break;
  }
  return regions;
}

}  // namespace seiche
