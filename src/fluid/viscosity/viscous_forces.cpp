#include "fluid/viscosity/load_sums.h"
#include "fluid/viscosity/viscous_terms.h"

namespace seiche {
namespace {

template <int Dim>
double value_of(const AffineVelocity& s, const Slot& slot, const FaceField<Dim>& u, const Eigen::VectorXd& v) {
  double sum = s.known + (s.row >= 0 ? u.at(slot.axis, slot.face) : 0);
  for (const auto& [column, weight] : s.columns) sum += weight * v[column];
  return sum;
}

// Velocities of a term's slots relative to its frame, m/s.
template <int Dim>
using SlotValues = std::array<double, ViscousTerm<Dim>::most>;

template <int Dim>
SlotValues<Dim> values_of(const ViscousTerms<Dim>& terms, const ViscousTerm<Dim>& t, const ViscousMotion<Dim>& z) {
  SlotValues<Dim> s;
  for (int i = 0; i < t.slots; ++i) s[i] = value_of(terms.relative_velocity(t, i), t.slot[i], z.u, z.v);
  return s;
}

// 1/2 d(s'Qs)/ds_i
template <int Dim>
double slope(const ViscousTerm<Dim>& t, const SlotValues<Dim>& s, int i) {
  double sum = 0;
  for (int j = 0; j < t.slots; ++j) sum += t.Q[i][j] * s[j];
  return sum;
}

}  // namespace

// The force on body k is minus the derivative of half the dissipation rate with respect to its rigid motion. Slots that
// read the body move with it; in terms with the body's frame, all other slots move against it.
template <int Dim>
std::vector<SolidLoad> viscous_forces(const ViscousInput<Dim>& in, const ViscousSystem<Dim>& system,
                                      const FaceField<Dim>& u, const Eigen::VectorXd& v,
                                      const std::vector<Vec3>& about) {
  LoadSums sums(about);
  const ViscousTerms<Dim> terms(in, *system.samples);
  terms.for_each_owned([&](const ViscousTerm<Dim>& t) {
    const SlotValues<Dim> s = values_of(terms, t, {u, v});
    const auto push = [&](int k, const Slot& slot, double force) {
      sums.add(k, terms.position(slot), force * Vec3::Unit(slot.axis));
    };
    for (int i = 0; i < t.slots; ++i) {
      const int k = terms.solid(t.slot[i]);
      if (k == t.frame) continue;
      const double force = slope(t, s, i);
      if (k >= 0) push(k, t.slot[i], -force);
      if (t.frame >= 0) push(t.frame, t.slot[i], force);
    }
  });
  return sums.total(in.ranks);
}

// A slot without row and solid reads a side. The side pushes the fluid with the slope of the term.
template <int Dim>
ViscousPower viscous_power(const ViscousInput<Dim>& in, const ViscousSystem<Dim>& system,
                           const ViscousMotion<Dim>& strained, const ViscousMotion<Dim>& z,
                           const ViscousMotion<Dim>& before) {
  std::vector<double> sum(3);
  const ViscousTerms<Dim> terms(in, *system.samples);
  terms.for_each_owned([&](const ViscousTerm<Dim>& t) {
    const SlotValues<Dim> s = values_of(terms, t, strained), moved = values_of(terms, t, z),
                          earlier = values_of(terms, t, before);
    for (int i = 0; i < t.slots; ++i) {
      const Slot& slot = t.slot[i];
      const double force = slope(t, s, i);
      sum[0] += moved[i] * force;
      sum[2] += earlier[i] * force;
      if (terms.row(slot) < 0 && terms.solid(slot) < 0)
        sum[1] += system.samples->given.at(slot.axis, slot.face) * force;
    }
  });
  in.ranks.global_sum(sum);
  return {sum[0], sum[1], sum[2]};
}

#define SEICHE_INSTANTIATE(D)                                                                                      \
  template std::vector<SolidLoad> viscous_forces<D>(const ViscousInput<D>&, const ViscousSystem<D>&,               \
                                                    const FaceField<D>&, const Eigen::VectorXd&,                   \
                                                    const std::vector<Vec3>&);                                     \
  template ViscousPower viscous_power<D>(const ViscousInput<D>&, const ViscousSystem<D>&, const ViscousMotion<D>&, \
                                         const ViscousMotion<D>&, const ViscousMotion<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
