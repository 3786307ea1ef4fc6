#include "solid/contact/pair_impulses.h"

#include "solid/contact/barrier.h"

namespace seiche::contact {
namespace {

template <int Dim>
bool is_rigid(const Scene<Dim>& scene, const Candidate& pair) {
  return !scene.deforms(pair.first) && (pair.kind == PairKind::point_wall || !scene.deforms(pair.second));
}

}  // namespace

template <int Dim>
std::vector<PairImpulse> pair_impulses(const Scene<Dim>& scene, const Placement<Dim>& at,
                                       const std::vector<Candidate>& pairs, const Weights& w) {
  std::vector<PairImpulse> impulses;
  for (const Candidate& pair : pairs) {
    if (!is_rigid<Dim>(scene, pair)) continue;
    const PairPoints<Dim> x = gather<Dim>(pair, at.points);
    const Separation<Dim> apart = separate<Dim>(scene, pair, x);
    if (apart.distance >= pair.reach(w.reach)) continue;
    const PairEnergy<Dim> e =
        pair_energy<Dim>(pair.kind, x, apart, pair.reach(w.reach), w.stiffness, pair.edges_at_rest);
    Vec<Dim> force = Vec<Dim>::Zero(), middle = -0.5 * apart.distance * apart.normal;
    for (int i = 0; i < points_of_first(pair.kind); ++i) {
      force -= e.gradient.col(i);
      middle += apart.weight[std::size_t(i)] * x[std::size_t(i)];
    }
    const int second = pair.kind == PairKind::point_wall ? -1 - pair.second : pair.second;
    impulses.push_back({pair.first, second, extend<Dim>(middle), extend<Dim>(Vec<Dim>(w.dt * force))});
  }
  return impulses;
}

#define SEICHE_INSTANTIATE(D)                                                                           \
  template std::vector<PairImpulse> pair_impulses<D>(const ContactScene<D>::Data&, const Placement<D>&, \
                                                     const std::vector<Candidate>&, const Weights&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)
#undef SEICHE_INSTANTIATE

}  // namespace seiche::contact
