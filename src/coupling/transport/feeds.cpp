#include "coupling/transport/feeds.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "coupling/transport/sources.h"
#include "grid/loops.h"
#include "levelset/fractions.h"

namespace seiche {
namespace {

// Cells of a feed with their room within its shape, as a share of a cell.
template <int Dim>
struct FeedCells {
  const Source<Dim>* feed;
  double volume = 0;          // that it brings where its shape is full, m^Dim
  double wet = 0, whole = 0;  // room of its cells of liquid, and of all its cells
  CellValues cells = {};      // of liquid
};

template <int Dim>
FeedCells<Dim> find_cells(const Domain<Dim>& domain, const Source<Dim>& feed, const FedLiquid<Dim>& liquid, double t0,
                          double t1) {
  FeedCells<Dim> r{&feed, volume_of_feed(feed, t0, t1)};
  if (r.volume == 0) return r;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    const double within = share_within_shape(domain.layout, feed, i);
    const double room = within > 0 ? within * liquid.room(c) : 0;
    if (room == 0) return;
    r.whole += room;
    if (liquid.phi[c] >= 0) return;
    r.wet += room;
    r.cells.emplace_back(c, room);
  });
  return r;
}

}  // namespace

// Gauss's rule of three points: exact for polynomials of the fifth degree.
template <int Dim>
double volume_of_feed(const Source<Dim>& feed, double t0, double t1) {
  const double begin = std::max(feed.spec.from, t0), end = std::min(feed.spec.until, t1);
  if (!(begin < end)) return 0;
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin), away = half * std::sqrt(0.6);
  const auto rate = [&](double t) {
    const double value = (*feed.rate)(Vec3::Zero(), t);
    if (value >= 0 && std::isfinite(value)) return value;
    throw Error(ExitCode::cannot_continue,
                fmt::format("{}.rate = \"{}\" is {:g} at t = {:g} s; it must be finite and at "
                            "least 0 (a source and a drain are opposites)",
                            feed.name, *feed.spec.rate, value, t));
  };
  return feed.sign * half * (5 * rate(middle - away) + 8 * rate(middle) + 5 * rate(middle + away)) / 9;
}

template <int Dim>
FedLiquid<Dim>::FedLiquid(const State<Dim>& solved)
    : phi(solved.liquid_phi.empty() ? solved.phi : solved.liquid_phi),
      room([&solved](Site c) { return solved.room().of(c); }) {}

template <int Dim>
FedLiquid<Dim>::FedLiquid(const Layout<Dim>& layout, const State<Dim>& solved, const NodeField<Dim>& psi)
    : phi(solved.phi),
      room([&](Site c) { return solved.liquid.empty() ? open_share(layout, psi, c) : solved.room().of(c); }) {}

template <int Dim>
CellValues brought_by_feeds(const Domain<Dim>& domain, const std::vector<Source<Dim>>& feeds,
                            const FedLiquid<Dim>& liquid, double t0, double t1) {
  std::vector<FeedCells<Dim>> found;
  std::vector<double> sums;
  for (const Source<Dim>& feed : feeds) {
    found.push_back(find_cells(domain, feed, liquid, t0, t1));
    sums.insert(sums.end(), {found.back().wet, found.back().whole});
  }
  if (!sums.empty()) domain.ranks.global_sum(sums);
  CellValues all;
  for (std::size_t n = 0; n < found.size(); ++n) {
    const double shared_by = found[n].feed->sign > 0 ? sums[2 * n] : sums[2 * n + 1];
    for (const auto& [c, room] : found[n].cells) all.emplace_back(c, found[n].volume * room / shared_by);
  }
  return all;
}

template <int Dim>
std::vector<char> dry_sources(const Domain<Dim>& domain, const std::vector<Source<Dim>>& feeds,
                              const FedLiquid<Dim>& liquid, double t0, double t1) {
  std::vector<char> dry(feeds.size());
  std::vector<double> wet(feeds.size());
  for (std::size_t n = 0; n < feeds.size(); ++n) {
    if (feeds[n].sign < 0) continue;
    const FeedCells<Dim> found = find_cells(domain, feeds[n], liquid, t0, t1);
    dry[n] = found.volume != 0;
    wet[n] = found.wet;
  }
  domain.ranks.global_sum(wet);
  for (std::size_t n = 0; n < feeds.size(); ++n) dry[n] = dry[n] && wet[n] == 0;
  return dry;
}

template <int Dim>
double sum_of_cells(const Domain<Dim>& domain, const CellValues& values) {
  double sum = 0;
  for (const auto& [c, value] : values) sum += value;
  return domain.ranks.global_sum(sum);
}

template <int Dim>
CellValues set_flux_of_feeds(const Domain<Dim>& domain, const std::vector<Source<Dim>>& feeds,
                             const FedLiquid<Dim>& liquid, double t, double dt, FaceGeometry<Dim>& faces) {
  CellValues brought = brought_by_feeds(domain, feeds, liquid, t, t + dt);
  for (auto& [c, value] : brought) {
    value /= dt;
    faces.cell_flux.add(c, -value / domain.layout.geometry().face_area());
  }
  return brought;
}

template <int Dim>
double power_of_feeds(const Domain<Dim>& domain, double density, const CellValues& brought,
                      const CellField<Dim>& pressure, const FaceField<Dim>& u) {
  double sum = 0;
  for (const auto& [c, value] : brought) {
    double square = 0;
    for (int a = 0; a < Dim; ++a) square += std::pow(0.5 * (u.at(a, c) + u.at(a, c + domain.layout.stride(a))), 2);
    sum += value * (pressure[c] + 0.5 * density * square);
  }
  return domain.ranks.global_sum(sum);
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template double volume_of_feed<D>(const Source<D>&, double, double);                                            \
  template struct FedLiquid<D>;                                                                                   \
  template CellValues brought_by_feeds<D>(const Domain<D>&, const std::vector<Source<D>>&, const FedLiquid<D>&,   \
                                          double, double);                                                        \
  template std::vector<char> dry_sources<D>(const Domain<D>&, const std::vector<Source<D>>&, const FedLiquid<D>&, \
                                            double, double);                                                      \
  template double sum_of_cells<D>(const Domain<D>&, const CellValues&);                                           \
  template CellValues set_flux_of_feeds<D>(const Domain<D>&, const std::vector<Source<D>>&, const FedLiquid<D>&,  \
                                           double, double, FaceGeometry<D>&);                                     \
  template double power_of_feeds<D>(const Domain<D>&, double, const CellValues&, const CellField<D>&,             \
                                    const FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
