#include "levelset/extrapolate.h"

#include "grid/loops.h"

namespace seiche {
namespace {

// Mean over the neighbours known from earlier layers of the value they predict here.
template <int Dim>
bool predict(const Layout<Dim>& layout, const IVec<Dim>& index, Site s, const std::vector<double>& f,
             const std::vector<char>& known, char layer, int linear_layers, double& value) {
  double sum = 0;
  int count = 0;
  const auto earlier = [&](const IVec<Dim>& i, Site at) {
    return layout.padded().contains(i) && known[at] > 0 && known[at] < layer;
  };
  for (int a = 0; a < Dim; ++a)
    for (int side = -1; side <= 1; side += 2) {
      IVec<Dim> i = index;
      i[a] += side;
      const Site d = side * layout.stride(a);
      if (!earlier(i, s + d)) continue;
      i[a] += side;
      const bool straight = layer - 2 < linear_layers && earlier(i, s + 2 * d);
      sum += straight ? 2 * f[s + d] - f[s + 2 * d] : f[s + d];
      ++count;
    }
  if (count > 0) value = sum / count;
  return count > 0;
}

}  // namespace

template <int Dim>
void extrapolate(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box, const ExtrapolateOptions& options,
                 std::vector<double>& f, std::vector<char>& known) {
  halo.fill_ghosts({f.data()});
  halo.fill_ghosts({known.data()});
  for (int n = 0; n < options.layers; ++n) {
    const char layer = char(n + 2);
    for_each_index(layout, box, [&](Site s, const IVec<Dim>& i) {
      double value;
      if (known[s] != 0 || !predict(layout, i, s, f, known, layer, options.linear_layers, value)) return;
      f[s] = value;
      known[s] = layer;
    });
    halo.fill_ghosts({f.data()});
    halo.fill_ghosts({known.data()});
  }
}

template void extrapolate<2>(const Layout<2>&, const Halo<2>&, const Box<2>&, const ExtrapolateOptions&,
                             std::vector<double>&, std::vector<char>&);
template void extrapolate<3>(const Layout<3>&, const Halo<3>&, const Box<3>&, const ExtrapolateOptions&,
                             std::vector<double>&, std::vector<char>&);

}  // namespace seiche
