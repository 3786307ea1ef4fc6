#pragma once
// The padded layout that all fields of a rank share. One integer Site addresses a cell, its low faces and its low node.
// Neighbours are site +- stride(axis).
#include <array>
#include <cstddef>
#include <vector>

#include "base/communicator.h"
#include "grid/box.h"

namespace seiche {

using Site = std::ptrdiff_t;

// The whole grid: cell (i, j, k) spans lower + h (i, j, k) to lower + h (i+1, j+1, k+1).
template <int Dim>
struct Geometry {
  Vec<Dim> lower = Vec<Dim>::Zero();  // m
  double h = 1;                       // cell size, m
  IVec<Dim> cells = IVec<Dim>::Ones();
  std::array<bool, Dim> periodic{};

  Box<Dim> box() const { return {IVec<Dim>::Zero(), cells}; }
  double cell_volume() const { return std::pow(h, Dim); }
  double face_area() const { return std::pow(h, Dim - 1); }
};

// Location of a field's values in a cell, in units of h from its low corner.
template <int Dim>
Vec<Dim> cell_offset() {
  return Vec<Dim>::Constant(0.5);
}
template <int Dim>
Vec<Dim> face_offset(int axis) {
  Vec<Dim> o = Vec<Dim>::Constant(0.5);
  o[axis] = 0;
  return o;
}
template <int Dim>
Vec<Dim> node_offset() {
  return Vec<Dim>::Zero();
}

template <int Dim>
class Layout {
 public:
  Layout(const Geometry<Dim>& geometry, const Box<Dim>& owned, int halo);

  const Geometry<Dim>& geometry() const { return geometry_; }
  double h() const { return geometry_.h; }
  int halo() const { return halo_; }
  Site size() const { return size_; }
  Site stride(int axis) const { return stride_[axis]; }

  const Box<Dim>& cells() const { return owned_; }          // owned cells
  Box<Dim> faces(int axis) const;                           // owned low faces, and the domain's last face
  Box<Dim> nodes() const;                                   // owned low nodes, and the domain's last nodes
  const Box<Dim>& padded() const { return padded_; }        // all stored sites
  const Box<Dim>& authority() const { return authority_; }  // owned cells and the halo beyond the domain's sides
  // Owned cells grown by n, within the stored sites.
  Box<Dim> grown(int n) const { return owned_.empty() ? owned_ : owned_.grown(n).cut(padded_); }
  bool at_lower(int axis) const { return !geometry_.periodic[axis] && owned_.lower[axis] == 0; }
  bool at_upper(int axis) const { return !geometry_.periodic[axis] && owned_.upper[axis] == geometry_.cells[axis]; }

  Site site(const IVec<Dim>& index) const {
    Site s = 0;
    for (int a = 0; a < Dim; ++a) s += (index[a] - padded_.lower[a]) * stride_[a];
    return s;
  }
  IVec<Dim> index(Site site) const;
  // Position of the value at an index, m.
  Vec<Dim> position(const IVec<Dim>& index, const Vec<Dim>& offset) const {
    return geometry_.lower + geometry_.h * (index.template cast<double>() + offset);
  }

 private:
  Geometry<Dim> geometry_;
  Box<Dim> owned_, padded_, authority_;
  int halo_;
  std::array<Site, Dim> stride_{};
  Site size_ = 0;
};

}  // namespace seiche
