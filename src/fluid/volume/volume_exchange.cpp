#include "fluid/volume/volume_exchange.h"

#include <algorithm>
#include <cmath>

#include "fluid/volume/surface_pieces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Calls visit(m) for the cells of the surface around c.
template <int Dim, class Visit>
void each_on_surface(const Layout<Dim>& layout, const Difference<Dim>& d, Site c, const Visit& visit) {
  for (int n = 0; n < neighbour_count<Dim>(); ++n) {
    const IVec<Dim> o = neighbour_offset<Dim>(n);
    const Site m = c + step_of(layout, o);
    if (m != c && d.on_surface(m) && d.room.joins(layout, c, o)) visit(m);
  }
}

// Flows between neighbours on the surface, and the shares of them that all cells can bear.
template <int Dim>
class Exchange {
 public:
  Exchange(const Layout<Dim>& layout, const Difference<Dim>& d, const CellField<Dim>& delta,
           const CellField<Dim, char>& good)
      : layout_(layout), d_(d), delta_(delta), good_(good), takes_(layout), gives_(layout) {}

  // Shares of the flows at the good ones of these cells. gain() reads those of a cell and its neighbours.
  void limit(const std::vector<Site>& surface, const CellField<Dim>& share) {
    for_each_listed(surface, [&](Site c) {
      double in = 0, out = 0;
      each(c, [&](Site, double f) { (f > 0 ? in : out) += std::abs(f); });
      takes_[c] = in > 0 ? std::clamp((d_.room.of(c) - share[c]) / in, 0.0, 1.0) : 1;
      gives_[c] = out > 0 ? std::clamp(share[c] / out, 0.0, 1.0) : 1;
    });
  }
  // Gain of cell c, in cells.
  double gain(Site c) const {
    double sum = 0;
    each(c, [&](Site m, double f) {
      sum += f * (f > 0 ? std::min(takes_[c], gives_[m]) : std::min(gives_[c], takes_[m]));
    });
    return sum;
  }

 private:
  template <class Visit>
  void each(Site c, const Visit& visit) const {
    if (!good_[c]) return;
    visit_links(layout_, d_, c, [&](Site m, double w) {
      if (good_[m]) visit(m, w * (delta_[m] - delta_[c]));
    });
  }

  const Layout<Dim>& layout_;
  const Difference<Dim>& d_;
  const CellField<Dim>& delta_;
  const CellField<Dim, char>& good_;
  CellField<Dim> takes_, gives_;
};

// Cells where both may move each other: on a smooth surface that is not rebuilt.
template <int Dim>
CellField<Dim, char> good_cells(const Layout<Dim>& layout, const Difference<Dim>& d, const CellField<Dim>& phi,
                                const CellField<Dim, char>& rebuild) {
  CellField<Dim, char> good(layout);
  for_each_possible(
      layout, cells_around(layout, 2), [&](Site c) { return !all_zero(d.area.data() + c); },
      [&](Site c) {
        if (d.on_surface(c) && !rebuild[c] && is_smooth(layout, phi, c)) good[c] = 1;
      });
  return good;
}

// Cells with little room have what the level set gives them, as far as their hosts have it. Hosts have the rest.
template <int Dim>
void settle_with_hosts(const Layout<Dim>& layout, const Difference<Dim>& d, const Box<Dim>& box,
                       const CellField<Dim>& share, CellField<Dim>& rhs, CellField<Dim>& change) {
  d.room.each_with_host(layout, box, [&](Site c, Site host) {
    const double missing = std::max(d.missing[c], -std::max(0.0, share[host] + change[host]));
    change[c] -= missing;
    change[host] += missing;
    rhs[c] = 0;
    if (d.on_surface(host)) rhs[host] += missing;
  });
}

// A share of liquid that cell `to` is to take from cell `from`, or to give where it is negative.
struct StrayPart {
  Site from, to;
  double share;
};

// Hands the parts over, as far as what each cell takes or gives in all leaves it between empty and full.
template <int Dim>
void hand_over(const Layout<Dim>& layout, const Room<Dim>& cells, const std::vector<StrayPart>& parts,
               const CellField<Dim>& share, CellField<Dim>& change) {
  CellField<Dim> taken(layout), given(layout);
  for (const StrayPart& p : parts) (p.share > 0 ? taken : given)[p.to] += std::abs(p.share);
  for (const StrayPart& p : parts) {
    const double all = (p.share > 0 ? taken : given)[p.to],
                 room = std::max(p.share > 0 ? cells.of(p.to) - share[p.to] : share[p.to], 0.0);
    const double part = p.share * (all > room ? room / all : 1);
    change[p.to] += part;
    change[p.from] -= part;
  }
}

}  // namespace

template <int Dim>
Stray<Dim>::Stray(const Layout<Dim>& layout, const Difference<Dim>& d, const CellField<Dim>& phi,
                  const CellField<Dim>& share)
    : rhs(layout), change(layout), rebuild(layout) {
  constexpr double rounding = 1e-12, least_room = 0.2, most = 0.5, visible = 0.05;
  // Cells of the first layer around take from the second. Smoothness is known no farther than the first.
  const Box<Dim> box = cells_around(layout, 2), first = cells_around(layout, 1);
  const auto may_matter = [&](Site c) { return !all_zero(d.missing.data() + c); };
  for_each_possible(layout, box, may_matter,
                    [&](Site c) { set_if_other(rhs[c], d.on_surface(c) ? d.missing[c] : 0.0); });
  const std::vector<Site> cells = listed_possible(
      layout, box, may_matter, [&](Site c) { return !d.on_surface(c) && std::abs(d.missing[c]) > rounding; });
  settle_with_hosts(layout, d, first, share, rhs, change);
  std::vector<StrayPart> parts;
  for (const Site c : cells) {
    if (d.room.host_of(layout, c)) continue;
    double room = 0;
    each_on_surface(layout, d, c, [&](Site m) { room += d.area[m]; });
    if (room < least_room || std::abs(d.missing[c]) > most) {
      rebuild[c] = std::abs(d.missing[c]) > visible;
      continue;
    }
    each_on_surface(layout, d, c, [&](Site m) {
      const double part = d.missing[c] * d.area[m] / room;
      rhs[m] += part;
      if (first.contains(layout.index(m)) && is_smooth(layout, phi, m)) parts.push_back({c, m, part});
    });
  }
  hand_over(layout, d.room, parts, share, change);
}

template <int Dim>
double exchange_short_waves(const Layout<Dim>& layout, const Difference<Dim>& d, const CellField<Dim>& delta,
                            const CellField<Dim>& phi, const CellField<Dim, char>& rebuild,
                            const std::vector<Site>& surface, CellField<Dim>& share) {
  const CellField<Dim, char> good = good_cells(layout, d, phi, rebuild);
  Exchange<Dim> exchange(layout, d, delta, good);
  exchange.limit(listed_possible(
                     layout, cells_around(layout, 1), [&](Site c) { return any_marked(good.data() + c); },
                     [&](Site c) { return good[c] != 0; }),
                 share);
  double moved = 0;
  for (const Site c : surface) {
    const double gain = exchange.gain(c);
    share[c] += gain;
    moved += std::max(gain, 0.0);
  }
  return moved;
}

#define SEICHE_INSTANTIATE(D)                                                                                       \
  template struct Stray<D>;                                                                                         \
  template double exchange_short_waves<D>(const Layout<D>&, const Difference<D>&, const CellField<D>&,              \
                                          const CellField<D>&, const CellField<D, char>&, const std::vector<Site>&, \
                                          CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
