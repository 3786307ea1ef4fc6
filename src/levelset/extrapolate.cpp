#include "levelset/extrapolate.h"

#include "grid/loops.h"

namespace seiche {
namespace {

double minmod(double a, double b) {
  return a * b <= 0 ? 0 : (std::abs(a) < std::abs(b) ? a : b);
}

// What the sites known from earlier layers predict. Sites are at least four from the end of the stored ones.
template <int Dim>
struct Predictor {
  const Layout<Dim>& layout;
  const std::vector<double>& f;
  const std::vector<char>& known;
  int linear_layers;

  bool earlier(Site at, char layer) const { return known[at] > 0 && known[at] < layer; }

  // The nearest value along a line, plus the smaller of the two slopes behind it where both are known: continued
  // straight in smooth flow, constant from drops and sheets too thin to have a slope.
  double along(Site s, Site d, char layer) const {
    if (layer - 2 >= linear_layers || !earlier(s + d, layer) || !earlier(s + 2 * d, layer)) return f[s];
    return f[s] + minmod(f[s] - f[s + d], f[s + d] - f[s + 2 * d]);
  }

  // Mean over the known neighbours.
  bool predict(Site s, char layer, double& value) const {
    double sum = 0;
    int count = 0;
    for (int a = 0; a < Dim; ++a)
      for (const Site d : {-layout.stride(a), layout.stride(a)}) {
        if (!earlier(s + d, layer)) continue;
        sum += along(s + d, d, layer);
        ++count;
      }
    if (count > 0) value = sum / count;
    return count > 0;
  }
};

}  // namespace

template <int Dim>
void extrapolate(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box,
                 const ExtrapolateOptions& options, std::vector<double>& f, std::vector<char>& known) {
  halo.fill_ghosts({f.data()});
  halo.fill_ghosts({known.data()});
  const Predictor<Dim> predictor{layout, f, known, options.linear_layers};
  std::vector<char> next = known;  // neighbours still read `known` while this is written
  for (int n = 0; n < options.layers; ++n) {
    const char layer = char(n + 2);
    for_each_site(layout, box, [&](Site s) {
      double value;
      next[s] = known[s];
      if (known[s] != 0 || !predictor.predict(s, layer, value)) return;
      f[s] = value;
      next[s] = layer;
    });
    known.swap(next);
    halo.fill_ghosts({f.data()});
    halo.fill_ghosts({known.data()});
  }
}

template void extrapolate<2>(const Layout<2>&, const Halo<2>&, const Box<2>&, const ExtrapolateOptions&,
                             std::vector<double>&, std::vector<char>&);
template void extrapolate<3>(const Layout<3>&, const Halo<3>&, const Box<3>&, const ExtrapolateOptions&,
                             std::vector<double>&, std::vector<char>&);

}  // namespace seiche
