#include "coupling/transport/reached_sites.h"

#include <cstring>

#include "grid/loops.h"

namespace seiche {
namespace {

// Marks all within `width` stored sites of marked ones along an axis.
template <int Dim>
void widen(const Layout<Dim>& layout, int axis, int width, CellField<Dim, char>& marks) {
  const CellField<Dim, char> old = marks;
  const Box<Dim>& all = layout.padded();
  for_each_row(layout, all, [&](Site first, const IVec<Dim>& i, int length) {
    char* to = marks.data() + first;
    for (int k = -width; k <= width; ++k) {
      if (axis > 0 && (i[axis] + k < all.lower[axis] || i[axis] + k >= all.upper[axis])) continue;
      const int begin = axis == 0 ? std::max(0, -k) : 0, end = axis == 0 ? std::min(length, length - k) : length;
      const char* from = old.data() + first + k * layout.stride(axis);
      if (std::memchr(from + begin, 1, std::size_t(end - begin)) == nullptr) continue;
      for (int n = begin; n < end; ++n) to[n] = char(to[n] | from[n]);
    }
  });
}

}  // namespace

template <int Dim>
CellField<Dim, char> reached_sites(const Domain<Dim>& domain, const FaceField<Dim, char>& near) {
  CellField<Dim, char> marks(domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_marked(domain.layout, domain.layout.faces(a), near[a].data(), [&](Site f) { marks[f] = 1; });
  for (int widths = 0; widths < 2; ++widths) {
    domain.halo.fill_ghosts({marks.data()});
    for (int axis = 0; axis < Dim; ++axis) widen(domain.layout, axis, domain.layout.halo(), marks);
  }
  domain.halo.fill_ghosts({marks.data()});
  return marks;
}

template CellField<2, char> reached_sites<2>(const Domain<2>&, const FaceField<2, char>&);
template CellField<3, char> reached_sites<3>(const Domain<3>&, const FaceField<3, char>&);

}  // namespace seiche
