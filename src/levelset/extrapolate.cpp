#include "levelset/extrapolate.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "base/parallel_range.h"
#include "grid/loops.h"
#include "levelset/minmod.h"

namespace seiche {
namespace {

// Ratio of the smaller of two values to the larger, 0 if their signs differ.
double likeness(double a, double b) {
  return a * b > 0 ? std::min(a / b, b / a) : 0;
}

// Extrapolates to a site from the sites of earlier layers. Sites must be at least four from the end of the stored ones.
template <int Dim>
struct Predictor {
  const Layout<Dim>& layout;
  const FieldValues<double>& f;
  const FieldValues<char>& known;
  int linear_layers;
  const std::function<bool(Site)>& bends;

  bool earlier(Site at, char layer) const { return known[at] > 0 && known[at] < layer; }

  // The nearest value along a line, plus the minmod of the two slopes behind it if both are known. The result is linear
  // in smooth flow, and constant from drops and sheets too thin to have a slope. In the first layer of `bent` sites it
  // is a parabola where the flow is smooth over four sites, as far as a halo of four reaches.
  double along(Site s, Site d, char layer, bool bent) const {
    if (layer - 2 >= linear_layers || !earlier(s + d, layer) || !earlier(s + 2 * d, layer)) return f[s];
    const double last = f[s] - f[s + d], before = f[s + d] - f[s + 2 * d], straight = minmod(last, before);
    if (!bent || layer > 2 || !earlier(s + 3 * d, layer)) return f[s] + straight;
    const double first = f[s + 2 * d] - f[s + 3 * d];
    const double alike = std::clamp(10 * likeness(last, before) - 3, 0.0, 1.0) *
                         std::clamp(5 * likeness(last - before, before - first) - 1, 0.0, 1.0);
    return f[s] + straight + alike * (2 * last - before - straight);
  }

  // Mean over the known neighbours.
  bool predict(Site s, char layer, double& value) const {
    double sum = 0;
    int count = 0;
    const bool bent = bends && bends(s);
    for (int a = 0; a < Dim; ++a)
      for (const Site d : {-layout.stride(a), layout.stride(a)}) {
        if (!earlier(s + d, layer)) continue;
        sum += along(s + d, d, layer, bent);
        ++count;
      }
    if (count > 0) value = sum / count;
    return count > 0;
  }
};

// Extrapolates only linearly, from values below the limit.
template <int Dim>
struct StraightPredictor {
  const Layout<Dim>& layout;
  const FieldValues<double>& f;
  const FieldValues<char>& known;
  double limit;

  bool earlier(Site at, char layer) const { return known[at] > 0 && known[at] < layer; }

  bool tells(Site at, char layer) const { return earlier(at, layer) && std::abs(f[at]) < limit; }

  double along(Site s, Site d, char layer) const {
    const double slope = f[s] - f[s + d];
    if (tells(s + 2 * d, layer)) return f[s] + minmod(slope, f[s + d] - f[s + 2 * d]);
    return f[s] + std::clamp(slope, -layout.h(), layout.h());
  }

  // Mean over the lines, summed in the order of their values so that rotated scenes have the same round-off.
  bool predict(Site s, char layer, double& value) const {
    std::array<double, 2 * Dim> said;
    said.fill(std::numeric_limits<double>::infinity());  // sorts behind all others
    int count = 0;
    for (int a = 0; a < Dim; ++a)
      for (const Site d : {-layout.stride(a), layout.stride(a)})
        if (tells(s + d, layer) && tells(s + 2 * d, layer)) said[std::size_t(count++)] = along(s + d, d, layer);
    std::sort(said.begin(), said.end());
    if (count > 0) value = std::accumulate(said.begin(), said.begin() + count, 0.0) / count;
    return count > 0;
  }
};

// Moves sites from unknown to queued, each once.
struct Queue {
  static constexpr char queued = 127;  // above every layer
  FieldValues<char>& known;
  std::vector<Site> sites;

  void add(Site s) {
    if (known[s] != 0) return;
    known[s] = queued;
    sites.push_back(s);
  }
};

// The part of the box that is next to one of its sides.
template <int Dim>
Box<Dim> slab(Box<Dim> box, int axis, int side) {
  if (side == 0)
    box.upper[axis] = std::min(box.upper[axis], box.lower[axis] + 1);
  else
    box.lower[axis] = std::max(box.lower[axis], box.upper[axis] - 1);
  return box;
}

// Unknown sites of the box beside known ones.
template <int Dim>
std::vector<Site> first_front(const Layout<Dim>& layout, const Box<Dim>& box, const FieldValues<char>& known) {
  const auto may_matter = [&](Site s) {
    const char* at = known.data() + s;
    bool beside = any_marked(at - 1) || any_marked(at + 1);
    for (int a = 1; a < Dim; ++a)
      beside = beside || any_marked(at - layout.stride(a)) || any_marked(at + layout.stride(a));
    return beside && !all_marked(at);
  };
  return listed_possible(layout, box, may_matter, [&](Site s) {
    if (known[s] != 0) return false;
    for (int a = 0; a < Dim; ++a)
      if (known[s - layout.stride(a)] != 0 || known[s + layout.stride(a)] != 0) return true;
    return false;
  });
}

// Unknown sites of the box beside those that `layer` filled, here or on other ranks, and sites of `front` that it could
// not fill.
template <int Dim>
std::vector<Site> next_front(const Layout<Dim>& layout, const Box<Dim>& box, char layer, const std::vector<Site>& front,
                             FieldValues<char>& known) {
  Queue queue{known, {}};
  for (const Site s : front) {
    if (known[s] == 0) queue.add(s);
    if (known[s] != layer) continue;
    const IVec<Dim> i = layout.index(s);
    for (int a = 0; a < Dim; ++a) {
      if (i[a] > box.lower[a]) queue.add(s - layout.stride(a));
      if (i[a] + 1 < box.upper[a]) queue.add(s + layout.stride(a));
    }
  }
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1}) {
      const Site beyond = side == 0 ? -layout.stride(a) : layout.stride(a);
      for_each_index_in_order(layout, slab(box, a, side), [&](Site s, const IVec<Dim>&) {
        if (known[s + beyond] == layer) queue.add(s);
      });
    }
  for (const Site s : queue.sites) known[s] = 0;
  return queue.sites;
}

// Fills unknown sites with the predictor's values, layer by layer. Visits only sites beside known ones.
template <int Dim, class Predictor>
void fill_layers(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box, int layers,
                 const Predictor& predictor, FieldValues<double>& f, FieldValues<char>& known) {
  std::vector<Site> front = first_front(layout, box, known);
  for (int n = 0; n < layers; ++n) {
    const char layer = char(n + 2);
    std::vector<std::optional<double>> values(front.size());
    parallel_range_in_tasks(front.size(), 1024, [&](std::size_t k) {
      double value;
      if (predictor.predict(front[k], layer, value)) values[k] = value;
    });
    std::vector<Site> filled;
    for (std::size_t k = 0; k < front.size(); ++k) {
      if (!values[k]) continue;
      f[front[k]] = *values[k], known[front[k]] = layer;
      filled.push_back(front[k]);
    }
    halo.fill_changed(filled, layer, f.data(), known.data());
    if (n + 1 < layers) front = next_front(layout, box, layer, front, known);
  }
}

}  // namespace

template <int Dim>
void extrapolate(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box,
                 const ExtrapolateOptions& options, FieldValues<double>& f, FieldValues<char>& known) {
  halo.fill_ghosts({f.data()});
  halo.fill_ghosts({known.data()});
  const Predictor<Dim> predictor{layout, f, known, options.linear_layers, options.bends};
  fill_layers(layout, halo, box, options.layers, predictor, f, known);
}

template <int Dim>
void extrapolate_straight(const Layout<Dim>& layout, const Halo<Dim>& halo, const Box<Dim>& box, int layers,
                          double limit, FieldValues<double>& f, FieldValues<char>& known) {
  halo.fill_ghosts({f.data()});
  halo.fill_ghosts({known.data()});
  const StraightPredictor<Dim> predictor{layout, f, known, limit};
  fill_layers(layout, halo, box, layers, predictor, f, known);
}

template void extrapolate<2>(const Layout<2>&, const Halo<2>&, const Box<2>&, const ExtrapolateOptions&,
                             FieldValues<double>&, FieldValues<char>&);
template void extrapolate<3>(const Layout<3>&, const Halo<3>&, const Box<3>&, const ExtrapolateOptions&,
                             FieldValues<double>&, FieldValues<char>&);
template void extrapolate_straight<2>(const Layout<2>&, const Halo<2>&, const Box<2>&, int, double,
                                      FieldValues<double>&, FieldValues<char>&);
template void extrapolate_straight<3>(const Layout<3>&, const Halo<3>&, const Box<3>&, int, double,
                                      FieldValues<double>&, FieldValues<char>&);

}  // namespace seiche
