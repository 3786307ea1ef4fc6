#include "grid/layout.h"

namespace seiche {

template <int Dim>
Layout<Dim>::Layout(const Geometry<Dim>& geometry, const Box<Dim>& owned, int halo)
    : geometry_(geometry), owned_(owned), padded_(owned), authority_(owned), halo_(halo) {
  if (owned.empty()) return;
  padded_ = owned.grown(halo);
  for (int a = 0; a < Dim; ++a) {
    if (at_lower(a)) authority_.lower[a] = padded_.lower[a];
    if (at_upper(a)) authority_.upper[a] = padded_.upper[a];
  }
  size_ = 1;
  for (int a = 0; a < Dim; ++a) {
    stride_[a] = size_;
    size_ *= padded_.upper[a] - padded_.lower[a];
  }
}

template <int Dim>
Box<Dim> Layout<Dim>::faces(int axis) const {
  Box<Dim> b = owned_;
  if (!b.empty() && at_upper(axis)) b.upper[axis] += 1;
  return b;
}

template <int Dim>
Box<Dim> Layout<Dim>::nodes() const {
  Box<Dim> b = owned_;
  for (int a = 0; a < Dim && !owned_.empty(); ++a)
    if (at_upper(a)) b.upper[a] += 1;
  return b;
}

template <int Dim>
IVec<Dim> Layout<Dim>::index(Site site) const {
  IVec<Dim> i;
  for (int a = Dim - 1; a >= 0; --a) {
    i[a] = int(site / stride_[a]) + padded_.lower[a];
    site %= stride_[a];
  }
  return i;
}

template class Layout<2>;
template class Layout<3>;

}  // namespace seiche
