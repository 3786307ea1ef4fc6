// Connected components of the liquid across ranks.
#include <cstring>
#include <map>
#include <numeric>

#include "fluid/pressure.h"
#include "grid/loops.h"

namespace seiche {
namespace {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The smaller index becomes the root, so that roots do not depend on the order of joining.
  void join(int i, int j) {
    i = root(i), j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> parent_;
};

// Labels of this rank's connected pieces: each the smallest row it is known to reach.
template <int Dim>
class Labelling {
 public:
  Labelling(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows)
      : in_(in), rows_(rows), sets_(rows.cells.size()), label_(rows.cells.size()), field_(in.layout, -1) {
    for (std::size_t n = 0; n < rows.cells.size(); ++n)
      for_each_open_link(int(n), [&](Site across) {
        const std::int64_t other = rows_.row[across] - rows_.first;
        if (owned(other)) sets_.join(int(n), int(other));
      });
    for (std::size_t n = 0; n < label_.size(); ++n) label_[n] = rows.first + sets_.root(int(n));
    while (adopt_from_neighbours()) {
    }
  }

  std::int64_t label(int n) { return label_[sets_.root(n)]; }

  bool sees_given_pressure(int n) const {
    bool any = false;
    for_each_face_of(in_.layout, rows_.cells[n], [&](int a, Site f, int, Site across) {
      if (!in_.faces.is_unknown(a, f)) return;
      any = any || in_.faces.kind_at(a, f) == FaceKind::outflow || rows_.row[across] < 0;
    });
    return any;
  }

 private:
  bool owned(std::int64_t local) const { return local >= 0 && local < std::int64_t(label_.size()); }

  template <class Visit>
  void for_each_open_link(int n, const Visit& visit) const {
    for_each_face_of(in_.layout, rows_.cells[n], [&](int a, Site f, int, Site across) {
      if (in_.faces.kind_at(a, f) == FaceKind::open && rows_.row[across] >= 0) visit(across);
    });
  }

  bool adopt_from_neighbours() {
    for (std::size_t n = 0; n < label_.size(); ++n) field_[rows_.cells[n]] = label(int(n));
    in_.halo.fill_ghosts({field_.data()});
    bool changed = false;
    for (std::size_t n = 0; n < label_.size(); ++n)
      for_each_open_link(int(n), [&](Site across) {
        std::int64_t& mine = label_[sets_.root(int(n))];
        if (field_[across] < 0 || field_[across] >= mine) return;
        mine = field_[across];
        changed = true;
      });
    return in_.ranks.any(changed);
  }

  const ProjectionInput<Dim>& in_;
  const PressureRows<Dim>& rows_;
  DisjointSets sets_;
  std::vector<std::int64_t> label_;
  CellField<Dim, std::int64_t> field_;
};

// label -> whether any rank saw a given pressure there, on all ranks.
std::map<std::int64_t, bool> agree(const std::map<std::int64_t, bool>& mine, const Communicator& ranks) {
  std::string bytes;
  for (const auto& [label, open] : mine) {
    const std::int64_t code = 2 * label + (open ? 1 : 0);
    bytes.append(reinterpret_cast<const char*>(&code), sizeof code);
  }
  std::map<std::int64_t, bool> all;
  for (const std::string& part : ranks.all_gather(bytes))
    for (std::size_t k = 0; k < part.size(); k += sizeof(std::int64_t)) {
      std::int64_t code;
      std::memcpy(&code, part.data() + k, sizeof code);
      all[code / 2] = all[code / 2] || (code % 2 == 1);
    }
  return all;
}

}  // namespace

template <int Dim>
NullSpace find_closed_components(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows) {
  Labelling<Dim> labelling(in, rows);
  std::map<std::int64_t, bool> mine;
  for (int n = 0; n < int(rows.cells.size()); ++n) {
    bool& open = mine[labelling.label(n)];
    open = open || labelling.sees_given_pressure(n);
  }
  NullSpace closed;
  std::map<std::int64_t, int> number;
  for (const auto& [label, open] : agree(mine, in.ranks)) number[label] = open ? -1 : closed.count++;
  for (int n = 0; n < int(rows.cells.size()); ++n) closed.component.push_back(number.at(labelling.label(n)));
  return closed;
}

template NullSpace find_closed_components<2>(const ProjectionInput<2>&, const PressureRows<2>&);
template NullSpace find_closed_components<3>(const ProjectionInput<3>&, const PressureRows<3>&);

}  // namespace seiche
