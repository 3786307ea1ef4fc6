#pragma once
// Fractions of cells and faces cut by level sets that are linear on simplices around the centre. Exact for planes, and
// equivariant under all rotations and reflections of the grid.
#include <array>

#include "grid/fields.h"

namespace seiche {

// A simplex of N dimensions with two linear functions f, g given at its corners.
template <int N>
struct CutSimplex {
  std::array<double, N + 1> f, g;
  double measure;
};

// Measure of {f < 0}, or of {f < 0 and g < 0}.
template <int N>
double negative_measure(const CutSimplex<N>& s);
template <int N>
double negative_measure_both(const CutSimplex<N>& s);

// Open fraction of faces: the part with psi > 0, psi given at the nodes (m, negative inside solids). Fills the low
// faces of the cells in grown(2), except the last stored layer at the upper ends.
template <int Dim>
void open_fractions(const Layout<Dim>& layout, const NodeField<Dim>& psi, FaceField<Dim>& open);

// The same for one face.
template <int Dim>
double open_part_of_face(const Layout<Dim>& layout, const NodeField<Dim>& psi, int axis, Site face);

// Values of a level set in a cell and in those around it: in that at offset o, each -1, 0 or 1, at sum 3^a (o_a + 1).
template <int Dim>
using ValuesAround = std::array<double, Dim == 2 ? 9 : 27>;
template <int Dim>
ValuesAround<Dim> values_around(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell);

// Fraction of a cell with phi < 0 (phi at cell centres, valid one cell around) and psi > 0 (psi at nodes).
template <int Dim>
double liquid_share(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi, Site cell);
template <int Dim>
double liquid_share(const Layout<Dim>& layout, const ValuesAround<Dim>& phi, const NodeField<Dim>& psi, Site cell);
// The same without solids.
template <int Dim>
double liquid_share(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell);
// Fraction of a cell with psi > 0: liquid_share() of a full one.
template <int Dim>
double open_share(const Layout<Dim>& layout, const NodeField<Dim>& psi, Site cell);

// Liquid volume of the owned cells, m^Dim.
template <int Dim>
double local_liquid_volume(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi);

// Liquid volume of the owned cells, m^Dim, and area of its free surface there, m^(Dim-1): the volume gained a metre by
// which phi falls.
struct VolumeAndArea {
  double volume = 0, area = 0;
  VolumeAndArea& operator+=(const VolumeAndArea& other) {
    volume += other.volume;
    area += other.area;
    return *this;
  }
};
// Share of liquid of one cell, and what it gains a cell by which phi falls.
template <int Dim>
VolumeAndArea share_and_area(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi,
                             Site cell);
template <int Dim>
VolumeAndArea share_and_area(const Layout<Dim>& layout, const ValuesAround<Dim>& phi, const NodeField<Dim>& psi,
                             Site cell);
template <int Dim>
VolumeAndArea local_volume_and_area(const Layout<Dim>& layout, const CellField<Dim>& phi, const NodeField<Dim>& psi);

}  // namespace seiche
