// Connected components of the liquid across ranks.
#include "fluid/pressure/labelling.h"

namespace seiche {

std::map<std::int64_t, bool> any_of_labels(const std::map<std::int64_t, bool>& mine, const Communicator& ranks) {
  std::string bytes;
  for (const auto& [label, yes] : mine) {
    const std::int64_t code = 2 * label + (yes ? 1 : 0);
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

namespace {

template <int Dim>
bool sees_given_pressure(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, std::size_t n) {
  bool any = false;
  if (n >= rows.liquid) return any;
  for_each_face_of(in.layout, rows.cells[n], [&](int a, Site f, int, Site across) {
    if (!in.faces.is_unknown(a, f)) return;
    any = any || in.faces.kind_at(a, f) == FaceKind::outflow || rows.row[across] < 0;
  });
  return any;
}

}  // namespace

template <int Dim>
NullSpace find_closed_components(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows) {
  Labelling<Dim> labelling(in, rows);
  std::map<std::int64_t, bool> mine;
  for (std::size_t n = 0; n < rows.cells.size(); ++n) {
    bool& open = mine[labelling.label(int(n))];
    open = open || sees_given_pressure(in, rows, n);
  }
  NullSpace closed;
  std::map<std::int64_t, int> number;
  for (const auto& [label, open] : any_of_labels(mine, in.ranks)) number[label] = open ? -1 : closed.count++;
  for (int n = 0; n < int(rows.cells.size()); ++n) closed.component.push_back(number.at(labelling.label(n)));
  return closed;
}

template NullSpace find_closed_components<2>(const ProjectionInput<2>&, const PressureRows<2>&);
template NullSpace find_closed_components<3>(const ProjectionInput<3>&, const PressureRows<3>&);

}  // namespace seiche
