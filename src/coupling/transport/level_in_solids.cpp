#include "coupling/transport/level_in_solids.h"

#include "coupling/geometry/cell_distance.h"
#include "grid/loops.h"
#include "levelset/extrapolate.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

constexpr double depth = 1.5;  // cells; psi of deformed bodies is true to two
constexpr int layers = 4;      // a wall moves by less than that in a step

template <int Dim>
bool is_in_deformed(const StepGeometry<Dim>& g, Site cell) {
  return g.body[cell] >= 0 && g.deforms(g.body[cell]);
}

// 1 in the cells of the domain but for those deeper than that in deformed bodies.
template <int Dim>
std::vector<char> cells_near_outside(const Setup<Dim>& s, const StepGeometry<Dim>& g) {
  std::vector<char> near(std::size_t(s.layout.size()), 0);
  for_each_site(s.layout, s.layout.cells(), [&](Site c) {
    const bool deep = is_in_deformed(g, c) && distance_at_cell(s.layout, g.psi, c).first <= -depth * s.layout.h();
    near[std::size_t(c)] = deep ? 0 : 1;
  });
  return near;
}

}  // namespace

template <int Dim>
void keep_sides_of_walls(const Setup<Dim>& s, const StepGeometry<Dim>& g, CellField<Dim>& phi) {
  if (std::none_of(g.attached.begin(), g.attached.end(), [](const auto& list) { return list != nullptr; })) return;
  std::vector<char> known = cells_near_outside(s, g);
  std::vector<double> outside(phi.data(), phi.data() + s.layout.size());
  extrapolate(s.layout, s.halo, s.layout.cells(), {layers, 0}, outside, known);
  for_each_site(s.layout, s.layout.cells(), [&](Site c) {
    const double value = outside[std::size_t(c)];
    if (known[std::size_t(c)] > 1 && (value < 0) != (phi[c] < 0)) phi[c] = value;
  });
  fill_level_set_ghosts(s.layout, s.halo, phi);
}

template void keep_sides_of_walls<2>(const Setup<2>&, const StepGeometry<2>&, CellField<2>&);
template void keep_sides_of_walls<3>(const Setup<3>&, const StepGeometry<3>&, CellField<3>&);

}  // namespace seiche
