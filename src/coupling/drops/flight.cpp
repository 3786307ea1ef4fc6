#include "coupling/drops/flight.h"

#include <algorithm>
#include <cstring>

#include "fluid/volume/neighbours.h"
#include "grid/interpolation.h"

namespace seiche {

template <int Dim>
Vec<Dim> DropForces<Dim>::gain(const Vec<Dim>& x, const Vec<Dim>& v, double t, double dt) const {
  const Vec3 at = extend<Dim>(x);
  Vec3 u = extend<Dim>(v) + dt * pull_on_liquid(gravity, forces, at, t);
  for (const Force<Dim>& force : forces) {
    if (force.spec.kind != ForceKind::drag || !force.acts_on_liquid() || !force.acts_at(at)) continue;
    const double rate = force.rate(at, t), nan = std::numeric_limits<double>::quiet_NaN();
    u += (rate >= 0 ? -std::expm1(-rate * dt) : nan) * (force.velocity(at, t) + dt * gravity - u);
  }
  return truncate<Dim>(u) - v;
}

template <int Dim>
bool reaches_liquid(const Layout<Dim>& layout, const CellField<Dim>& phi, const Drop<Dim>& drop) {
  const double depth =
      interpolate_linear<Dim>(layout, phi.data(), index_coordinates<Dim>(layout, drop.place, cell_offset<Dim>()));
  if (!(depth < radius_of_drop<Dim>(drop.volume))) return false;
  const Site cell = layout.site(cell_around(layout.geometry(), drop.place));
  for (int n = 0; n < neighbour_count<Dim>(); ++n)
    if (phi[cell + step_of(layout, neighbour_offset<Dim>(n))] < 0) return true;
  return false;
}

namespace {

constexpr double way_of_a_part = 0.5;  // cells
constexpr double most_parts = 1e4;

// A drop and the parts of its way that are left.
template <int Dim>
struct DropInFlight {
  Drop<Dim> drop;
  double dt;  // of a part, s
  int left;   // parts
};

template <int Dim>
class Flight {
 public:
  Flight(const Domain<Dim>& domain, const Obstacles<Dim>& obstacles, const DropForces<Dim>& forces,
         const CellField<Dim>& phi, double from, double until)
      : domain_(domain), obstacles_(obstacles), forces_(forces), phi_(phi), from_(from), until_(until) {}
  DropsThatLeft left;  // on this rank
  bool is_finite = true;
  std::vector<Drop<Dim>> arrived;

  void set_out(const std::vector<Drop<Dim>>& drops) {
    for (const Drop<Dim>& d : drops) {
      const double span = until_ - from_;
      const Vec<Dim> end = d.velocity + forces_.gain(d.place, d.velocity, 0.5 * (from_ + until_), span);
      const double way =
          span * std::max(d.velocity.template lpNorm<Eigen::Infinity>(), end.template lpNorm<Eigen::Infinity>());
      const int parts = 1 + (way > 0 ? int(std::min(way / (way_of_a_part * domain_.layout.h()), most_parts)) : 0);
      under_way_.push_back({d, span / parts, parts});
    }
  }
  // Flies all drops as far as this rank's cells go, and sends them on. Collective. False once all have arrived.
  bool go_on() {
    std::vector<std::vector<double>> to(domain_.blocks.size());
    for (DropInFlight<Dim>& f : under_way_) {
      const int owner = fly_here(f);
      if (owner < 0) continue;
      if (owner == domain_.ranks.rank()) {
        arrived.push_back(f.drop);
        continue;
      }
      std::vector<double>& numbers = to[std::size_t(owner)];
      for (const double x : pack_drops<Dim>({f.drop})) numbers.push_back(x);
      numbers.insert(numbers.end(), {f.dt, double(f.left)});
    }
    under_way_.clear();
    if (domain_.ranks.size() > 1) receive(to);
    return domain_.ranks.any(!under_way_.empty());
  }

 private:
  // The rank that owns the drop's cell after it flew through those of this rank; -1: it has left.
  int fly_here(DropInFlight<Dim>& f) {
    for (;;) {
      const int owner = owner_of(cell_around(domain_.layout.geometry(), f.drop.place));
      if (owner != domain_.ranks.rank() || f.left == 0) return owner;
      advance(f);
      if (!obstacles_.has_left(f.drop.place)) {
        obstacles_.keep_out(f.drop);
        continue;
      }
      left.volume += f.drop.volume;
      left.energy += 0.5 * f.drop.volume * f.drop.velocity.squaredNorm();
      return -1;
    }
  }
  void advance(DropInFlight<Dim>& f) {
    const double t = until_ - (f.left - 0.5) * f.dt;
    Drop<Dim>& d = f.drop;
    const bool stays = reaches_liquid(domain_.layout, phi_, d);
    const Vec<Dim> gain = forces_.gain(d.place + 0.5 * f.dt * d.velocity, d.velocity, t, f.dt);
    --f.left;
    is_finite = is_finite && gain.allFinite();
    if (!gain.allFinite()) return;
    if (!stays) d.place += f.dt * (d.velocity + 0.5 * gain);
    d.velocity += gain;
  }
  int owner_of(const IVec<Dim>& cell) const {
    const int own = domain_.ranks.rank();
    if (domain_.blocks[std::size_t(own)].contains(cell)) return own;
    for (std::size_t r = 0; r < domain_.blocks.size(); ++r)
      if (domain_.blocks[r].contains(cell)) return int(r);
    return own;
  }
  void receive(const std::vector<std::vector<double>>& to) {
    std::vector<std::string> texts;
    for (const std::vector<double>& v : to)
      texts.emplace_back(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(double));
    for (const std::string& text : domain_.ranks.exchange(texts)) {
      constexpr std::size_t of_drop = 2 * Dim + 2, count = of_drop + 2;
      std::vector<double> v(text.size() / sizeof(double));
      if (!v.empty()) std::memcpy(v.data(), text.data(), text.size());
      for (auto at = v.begin(); at != v.end(); at += count)
        under_way_.push_back({unpack_drops<Dim>({at, at + of_drop}).front(), at[of_drop], int(at[of_drop + 1])});
    }
  }

  const Domain<Dim>& domain_;
  const Obstacles<Dim>& obstacles_;
  const DropForces<Dim>& forces_;
  const CellField<Dim>& phi_;
  double from_, until_;
  std::vector<DropInFlight<Dim>> under_way_;
};

}  // namespace

template <int Dim>
DropsThatLeft fly(const Domain<Dim>& domain, const Obstacles<Dim>& obstacles, const DropForces<Dim>& forces,
                  const CellField<Dim>& phi, double from, double until, std::vector<Drop<Dim>>& drops) {
  if (!(until > from) || !domain.ranks.any(!drops.empty())) return {};
  Flight<Dim> flight(domain, obstacles, forces, phi, from, until);
  flight.set_out(drops);
  while (flight.go_on()) {
  }
  drops = std::move(flight.arrived);
  sort_drops(drops);
  std::array<double, 2> sums{flight.left.volume, flight.left.energy};
  domain.ranks.global_sum(sums);
  return {sums[0], sums[1], !domain.ranks.any(!flight.is_finite)};
}

template <int Dim>
void merge_drops(const Layout<Dim>& layout, std::vector<Drop<Dim>>& drops) {
  std::vector<std::pair<Site, std::size_t>> order;
  for (std::size_t n = 0; n < drops.size(); ++n)
    order.emplace_back(layout.site(cell_around(layout.geometry(), drops[n].place)), n);
  std::sort(order.begin(), order.end());
  std::vector<Drop<Dim>> merged;
  for (std::size_t n = 0; n < order.size(); ++n) {
    const Drop<Dim>& d = drops[order[n].second];
    if (n == 0 || order[n].first != order[n - 1].first) {
      merged.push_back(d);
      continue;
    }
    Drop<Dim>& all = merged.back();
    const double part = d.volume / (all.volume + d.volume);
    if (d.volume > all.volume) all.id = d.id;
    all.place += part * (d.place - all.place);
    all.velocity += part * (d.velocity - all.velocity);
    all.volume += d.volume;
  }
  drops = std::move(merged);
  sort_drops(drops);
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template struct DropForces<D>;                                                                                  \
  template bool reaches_liquid<D>(const Layout<D>&, const CellField<D>&, const Drop<D>&);                         \
  template DropsThatLeft fly<D>(const Domain<D>&, const Obstacles<D>&, const DropForces<D>&, const CellField<D>&, \
                                double, double, std::vector<Drop<D>>&);                                           \
  template void merge_drops<D>(const Layout<D>&, std::vector<Drop<D>>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
