#include "fluid/volume/own_side.h"

#include <Eigen/Eigenvalues>
#include <bitset>

#include "fluid/volume/neighbours.h"

namespace seiche {
namespace {

template <int Dim>
using AroundMask = std::bitset<std::size_t(neighbour_count<Dim>())>;

// Offset of neighbour n without its parts that lead out of the domain.
template <int Dim>
IVec<Dim> offset_inside(const Layout<Dim>& layout, const IVec<Dim>& cell, int n) {
  const Geometry<Dim>& g = layout.geometry();
  IVec<Dim> o = neighbour_offset<Dim>(n);
  for (int a = 0; a < Dim; ++a)
    if (!g.periodic[a] && (cell[a] + o[a] < 0 || cell[a] + o[a] >= g.cells[a])) o[a] = 0;
  return o;
}

// Neighbours that open faces join to a cell. Ghosts beyond sides are as the cells inside that they continue.
template <int Dim>
AroundMask<Dim> joined_around(const Layout<Dim>& layout, const Room<Dim>& room, Site cell) {
  const IVec<Dim> index = layout.index(cell);
  AroundMask<Dim> joined;
  for (int n = 0; n < neighbour_count<Dim>(); ++n)
    joined[std::size_t(n)] = room.joins(layout, cell, offset_inside(layout, index, n));
  return joined;
}

// Slope g of phi per cell that leaves the least sum of (phi_n - phi - g.o_n)^2/|o_n|^2 over joined neighbours in the
// domain; the shortest where they lie in a line or plane.
template <int Dim>
Vec<Dim> slope_among(const Layout<Dim>& layout, const AroundMask<Dim>& joined, const ValuesAround<Dim>& phi,
                     Site cell) {
  constexpr double singular = 1e-6;
  constexpr int middle = neighbour_count<Dim>() / 2;
  const IVec<Dim> index = layout.index(cell);
  Eigen::Matrix<double, Dim, Dim> m = Eigen::Matrix<double, Dim, Dim>::Zero();
  Vec<Dim> rhs = Vec<Dim>::Zero();
  for (int n = 0; n < neighbour_count<Dim>(); ++n) {
    const IVec<Dim> o = neighbour_offset<Dim>(n);
    if (n == middle || !joined[std::size_t(n)] || !lies_in_domain(layout.geometry(), IVec<Dim>(index + o))) continue;
    const Vec<Dim> x = o.template cast<double>();
    m += x * x.transpose() / x.squaredNorm();
    rhs += x * (phi[std::size_t(n)] - phi[middle]) / x.squaredNorm();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> eigen(m);
  Vec<Dim> slope = Vec<Dim>::Zero();
  for (int k = 0; k < Dim; ++k)
    if (const double value = eigen.eigenvalues()[k]; value > singular)
      slope += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).dot(rhs) / value;
  return slope;
}

// True if phi around a cell need not be continued: no surface or no solid is near, or the cell has no room.
template <int Dim>
bool has_one_side(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi,
                  const NodeField<Dim>& psi, Site cell) {
  const double far = 2 * layout.h();  // as for liquid_share()
  if (room.is_whole() || phi[cell] > far || (phi[cell] < -far && psi[cell] > far)) return true;
  return room.of(cell) == 0;
}

}  // namespace

template <int Dim>
ValuesAround<Dim> values_on_own_side(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi,
                                     Site cell) {
  ValuesAround<Dim> values = values_around(layout, phi, cell);
  if (room.is_whole()) return values;
  const AroundMask<Dim> joined = joined_around(layout, room, cell);
  if (joined.all()) return values;
  const Vec<Dim> slope = slope_among(layout, joined, values, cell);
  for (std::size_t n = 0; n < values.size(); ++n)
    if (!joined[n]) values[n] = phi[cell] + slope.dot(neighbour_offset<Dim>(int(n)).template cast<double>());
  return values;
}

template <int Dim>
double liquid_share(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi,
                    const NodeField<Dim>& psi, Site cell) {
  if (has_one_side(layout, room, phi, psi, cell)) return liquid_share(layout, phi, psi, cell);
  return liquid_share(layout, values_on_own_side(layout, room, phi, cell), psi, cell);
}

template <int Dim>
VolumeAndArea share_and_area(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi,
                             const NodeField<Dim>& psi, Site cell) {
  if (has_one_side(layout, room, phi, psi, cell)) return share_and_area(layout, phi, psi, cell);
  return share_and_area(layout, values_on_own_side(layout, room, phi, cell), psi, cell);
}

#define SEICHE_INSTANTIATE(D)                                                                                          \
  template ValuesAround<D> values_on_own_side<D>(const Layout<D>&, const Room<D>&, const CellField<D>&, Site);         \
  template double liquid_share<D>(const Layout<D>&, const Room<D>&, const CellField<D>&, const NodeField<D>&, Site);   \
  template VolumeAndArea share_and_area<D>(const Layout<D>&, const Room<D>&, const CellField<D>&, const NodeField<D>&, \
                                           Site);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
