#include "coupling/step/wave_absorption.h"

#include <algorithm>

#include "grid/domain_faces.h"
#include "grid/loops.h"
#include "levelset/fractions.h"

namespace seiche {
namespace {

// The columns of cells beside a side, one along each upright line of faces.
template <int Dim>
class SideColumns {
 public:
  SideColumns(const Domain<Dim>& domain, int axis, int side)
      : domain_(domain), waves_(*domain.sides.waves(axis, side)), axis_(axis), side_(side) {
    for (int b = 0; b < Dim; ++b)
      if (b != axis && b != waves_.vertical()) along_ = b;
  }

  // Excess of the level at the side over that of the waves, m, for each column. Collective.
  std::vector<double> excess(const LevelAt<Dim>& level, const NodeField<Dim>& psi) const {
    std::vector<double> above = above_rest(level.phi, psi);
    for (std::size_t n = 0; n < above.size(); ++n) above[n] -= waves_.elevation(foot(n), level.time);
    return above;
  }

  std::size_t count() const { return along_ < 0 ? 1 : std::size_t(cells(along_)); }

  std::size_t number(const IVec<Dim>& i) const {
    if (along_ < 0) return 0;
    const int n = cells(along_), j = i[along_];
    return std::size_t(domain_.layout.geometry().periodic[along_] ? (j % n + n) % n : std::clamp(j, 0, n - 1));
  }

 private:
  // Height of the liquid above the level of rest by what it fills of each column's cells, m. A straight line from the
  // two columns beside the side leads to the side.
  std::vector<double> above_rest(const CellField<Dim>& phi, const NodeField<Dim>& psi) const {
    const Layout<Dim>& layout = domain_.layout;
    const double h = layout.h();
    std::vector<double> above(count());
    const bool two = cells(axis_) > 1;
    for (int layer = 0; layer < (two ? 2 : 1); ++layer) {
      const double weight = !two ? 1 : layer == 0 ? 1.5 : -0.5;
      for_each_index_in_order(layout, cells_of_layer(layer), [&](Site c, const IVec<Dim>& i) {
        const double rest = waves_.above_rest(extend<Dim>(layout.position(i, cell_offset<Dim>())));
        const double change = std::clamp(0.5 - phi[c] / h, 0.0, 1.0) - std::clamp(0.5 - rest / h, 0.0, 1.0);
        if (change != 0) above[number(i)] += weight * h * change * open_share(layout, psi, c);
      });
    }
    domain_.ranks.global_sum(above);
    return above;
  }

  Box<Dim> cells_of_layer(int layer) const {
    Box<Dim> box = domain_.layout.cells();
    const int at = side_ == 0 ? layer : cells(axis_) - 1 - layer;
    box.lower[axis_] = std::max(box.lower[axis_], at);
    box.upper[axis_] = std::min(box.upper[axis_], at + 1);
    return box;
  }

  // A point of the side at a column.
  Vec3 foot(std::size_t column) const {
    const Geometry<Dim>& g = domain_.layout.geometry();
    Vec3 x = extend<Dim>(g.lower);
    if (side_ == 1) x[axis_] += g.cells[axis_] * g.h;
    if (along_ >= 0) x[along_] += (double(column) + 0.5) * g.h;
    return x;
  }

  int cells(int axis) const { return domain_.layout.geometry().cells[axis]; }

  const Domain<Dim>& domain_;
  const WaveSide& waves_;
  int axis_, side_, along_ = -1;  // along_: horizontal axis along the side; none in 2D
};

}  // namespace

template <int Dim>
void absorb_waves(const Domain<Dim>& domain, const LevelAt<Dim>& before, const LevelAt<Dim>& solved, double t,
                  StepGeometry<Dim>& g) {
  const Layout<Dim>& layout = domain.layout;
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1}) {
      const WaveSide* waves = domain.sides.waves(a, side);
      if (!waves || !waves->absorbs()) continue;
      const SideColumns<Dim> columns(domain, a, side);
      const std::vector<double> then = columns.excess(before, g.psi), now = columns.excess(solved, g.psi);
      const double ahead = solved.time > before.time ? (t - solved.time) / (solved.time - before.time) : 0;
      for_each_index_in_order(layout, padded_faces_of_side(layout, a, side), [&](Site f, const IVec<Dim>& i) {
        if (g.faces.kind_at(a, f) != FaceKind::prescribed) return;
        const std::size_t n = columns.number(i);
        const double out = waves->outlet(extend<Dim>(layout.position(i, face_offset<Dim>(a))));
        g.faces.prescribed.add(a, f, (side == 0 ? -1 : 1) * out * (now[n] + ahead * (now[n] - then[n])));
      });
    }
}

namespace {

// Share of gas in the flow across a face of a side, by the level in the cell beside it.
double gas_at_face(double phi, double h) {
  return std::clamp(phi / h - 0.5, 0.0, 1.0);
}

// Calls use(face, column, share of gas) for the prescribed faces of a side with waves, those of ghosts too.
template <int Dim, class Use>
void for_each_wave_face(const Domain<Dim>& domain, const SideColumns<Dim>& columns, int axis, int side,
                        const Box<Dim>& faces, const CellField<Dim>& phi, const FaceGeometry<Dim>& geometry,
                        const Use& use) {
  const Layout<Dim>& layout = domain.layout;
  for_each_index_in_order(layout, faces, [&](Site f, const IVec<Dim>& i) {
    if (geometry.kind_at(axis, f) != FaceKind::prescribed) return;
    const Site inside = side == 0 ? f : f - layout.stride(axis);
    use(f, columns.number(i), gas_at_face(phi[inside], layout.h()));
  });
}

}  // namespace

template <int Dim>
void balance_gas_beside_waves(const Domain<Dim>& domain, const CellField<Dim>& phi, StepGeometry<Dim>& g) {
  const Layout<Dim>& layout = domain.layout;
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1}) {
      if (!domain.sides.waves(a, side)) continue;
      const SideColumns<Dim> columns(domain, a, side);
      std::vector<double> sums(2 * columns.count());  // of each column: flux of liquid, area of gas
      for_each_wave_face(domain, columns, a, side, faces_of_side(layout, a, side), phi, g.faces,
                         [&](Site f, std::size_t n, double gas) {
                           const double open = g.faces.open.at(a, f);
                           sums[2 * n] += open * (1 - gas) * g.faces.prescribed.at(a, f);
                           sums[2 * n + 1] += open * gas;
                         });
      domain.ranks.global_sum(sums);
      for_each_wave_face(domain, columns, a, side, padded_faces_of_side(layout, a, side), phi, g.faces,
                         [&](Site f, std::size_t n, double gas) {
                           if (gas == 0 || !(sums[2 * n + 1] > 0)) return;
                           const double back = -sums[2 * n] / sums[2 * n + 1], u = g.faces.prescribed.at(a, f);
                           g.faces.prescribed.set(a, f, u + gas * (back - u));
                         });
    }
}

template void balance_gas_beside_waves<2>(const Domain<2>&, const CellField<2>&, StepGeometry<2>&);
template void balance_gas_beside_waves<3>(const Domain<3>&, const CellField<3>&, StepGeometry<3>&);
template void absorb_waves<2>(const Domain<2>&, const LevelAt<2>&, const LevelAt<2>&, double, StepGeometry<2>&);
template void absorb_waves<3>(const Domain<3>&, const LevelAt<3>&, const LevelAt<3>&, double, StepGeometry<3>&);

}  // namespace seiche
