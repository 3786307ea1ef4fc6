#include "fluid/viscosity/viscous_terms.h"

namespace seiche {
namespace {

template <int Dim>
double value_of(const AffineVelocity& s, const Slot& slot, const FaceField<Dim>& u, const Eigen::VectorXd& v) {
  double sum = s.known + (s.row >= 0 ? u.at(slot.axis, slot.face) : 0);
  for (const auto& [column, weight] : s.columns) sum += weight * v[column];
  return sum;
}

// Calls visit(terms, term, s) for this rank's terms; s: velocities of the term's slots relative to its frame.
template <int Dim, class Visit>
void for_each_valued(const ViscousInput<Dim>& in, const ViscousSystem<Dim>& system, const FaceField<Dim>& u,
                     const Eigen::VectorXd& v, const Visit& visit) {
  const ViscousTerms<Dim> terms(in, *system.samples);
  std::array<double, ViscousTerm<Dim>::most> s;
  terms.for_each_owned([&](const ViscousTerm<Dim>& t) {
    for (int i = 0; i < t.slots; ++i) s[i] = value_of(terms.relative_velocity(t, i), t.slot[i], u, v);
    visit(terms, t, s);
  });
}

// 1/2 d(s'Qs)/ds_i
template <int Dim>
double slope(const ViscousTerm<Dim>& t, const std::array<double, ViscousTerm<Dim>::most>& s, int i) {
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
  std::vector<double> sum(6 * in.solids.size());
  for_each_valued(in, system, u, v, [&](const auto& terms, const ViscousTerm<Dim>& t, const auto& s) {
    const auto push = [&](int k, const Slot& slot, double force) {
      const Vec3 f = force * Vec3::Unit(slot.axis), moment = (terms.position(slot) - about[k]).cross(f);
      for (int c = 0; c < 3; ++c) sum[6 * k + c] += f[c], sum[6 * k + 3 + c] += moment[c];
    };
    for (int i = 0; i < t.slots; ++i) {
      const int k = terms.solid(t.slot[i]);
      if (k == t.frame) continue;
      const double force = slope(t, s, i);
      if (k >= 0) push(k, t.slot[i], -force);
      if (t.frame >= 0) push(t.frame, t.slot[i], force);
    }
  });
  in.ranks.global_sum(sum);
  std::vector<SolidLoad> loads(in.solids.size());
  for (std::size_t k = 0; k < loads.size(); ++k)
    for (int c = 0; c < 3; ++c) loads[k].force[c] = sum[6 * k + c], loads[k].torque[c] = sum[6 * k + 3 + c];
  return loads;
}

// A slot without row and solid reads a side. The side pushes the fluid with the slope of the term.
template <int Dim>
ViscousPower viscous_power(const ViscousInput<Dim>& in, const ViscousSystem<Dim>& system, const FaceField<Dim>& u,
                           const Eigen::VectorXd& v) {
  std::vector<double> sum(2);
  for_each_valued(in, system, u, v, [&](const auto& terms, const ViscousTerm<Dim>& t, const auto& s) {
    for (int i = 0; i < t.slots; ++i) {
      const Slot& slot = t.slot[i];
      const double force = slope(t, s, i);
      sum[0] += s[i] * force;
      if (terms.row(slot) < 0 && terms.solid(slot) < 0)
        sum[1] += system.samples->given.at(slot.axis, slot.face) * force;
    }
  });
  in.ranks.global_sum(sum);
  return {sum[0], sum[1]};
}

#define SEICHE_INSTANTIATE(D)                                                                                  \
  template std::vector<SolidLoad> viscous_forces<D>(const ViscousInput<D>&, const ViscousSystem<D>&,           \
                                                    const FaceField<D>&, const Eigen::VectorXd&,               \
                                                    const std::vector<Vec3>&);                                 \
  template ViscousPower viscous_power<D>(const ViscousInput<D>&, const ViscousSystem<D>&, const FaceField<D>&, \
                                         const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
