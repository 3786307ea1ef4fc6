#include "fluid/viscosity/no_slip_flux.h"

#include "grid/loops.h"

namespace seiche {
namespace {

// Integrals over the part of a face with psi > 0, per area of the face.
struct OpenPart {
  double area = 0, distance = 0;  // integrals of 1 and of psi
};

// Adds the open part of a simplex of N + 1 <= 3 corners: all of it, the tip at its only open corner, or all but the tip
// at its only closed corner.
template <int N>
void add_simplex(const std::array<double, N + 1>& psi, double measure, OpenPart& part) {
  int positive = 0, last_positive = 0, last_other = 0;
  double sum = 0;
  for (int i = 0; i <= N; ++i) {
    sum += psi[i];
    (psi[i] > 0 ? last_positive : last_other) = i;
    positive += psi[i] > 0;
  }
  if (positive == 0) return;
  const bool tip_is_open = positive == 1;
  if (!tip_is_open) part.area += measure, part.distance += measure * sum / (N + 1);
  if (positive == N + 1) return;
  const int tip = tip_is_open ? last_positive : last_other;
  double share = tip_is_open ? measure : -measure;
  for (int i = 0; i <= N; ++i)
    if (i != tip) share *= psi[tip] / (psi[tip] - psi[i]);
  part.area += share;
  part.distance += share * psi[tip] / (N + 1);
}

OpenPart open_part(const Layout<2>& layout, const NodeField<2>& psi, int axis, Site f) {
  OpenPart part;
  add_simplex<1>({psi[f], psi[f + layout.stride(1 - axis)]}, 1, part);
  return part;
}

// Four triangles around the centre, as for the open fraction.
OpenPart open_part(const Layout<3>& layout, const NodeField<3>& psi, int axis, Site f) {
  const Site p = layout.stride((axis + 1) % 3), q = layout.stride((axis + 2) % 3);
  const std::array<Site, 5> ring{f, f + p, f + p + q, f + q, f};
  double center = 0;
  for (int n = 0; n < 4; ++n) center += psi[ring[n]] / 4;
  OpenPart part;
  for (int n = 0; n < 4; ++n) add_simplex<2>({psi[ring[n]], psi[ring[n + 1]], center}, 0.25, part);
  return part;
}

template <int Dim>
class NoSlipFlux {
 public:
  NoSlipFlux(const ViscousInput<Dim>& in, const ViscousSamples<Dim>& s, const std::vector<RigidField>& motion,
             const FaceField<Dim>& u)
      : in_(in), layout_(in.layout), s_(s), motion_(motion), u_(u) {}

  // w du/dpsi (mean distance of the open part - distance of the centre), with the slope from a sample farther out. A
  // slope from the face's own velocity would feed back, and iterated solves would not converge. Slits, whose centre
  // lies in the solid, have almost no velocity of their own.
  double operator()(int axis, Site f) const {
    const double w = in_.faces.open.at(axis, f);
    const int k = s_.solid.at(axis, f);
    if (w <= 0 || w >= 1 || k < 0 || !in_.solids[k].no_slip || s_.rows.row.at(axis, f) < 0) return 0;
    const OpenPart open = open_part(layout_, in_.psi, axis, f);
    if (open.area <= 0) return 0;
    const double distance = open.distance / open.area, own = s_.psi.at(axis, f);
    const Site from = sample(axis, f);
    if (from < 0) return 0;
    return w * wall_slope(k, axis, f, from) * (distance - std::max(own, 0.0));
  }

 private:
  // The neighbour of the same component that is farthest from the wall, or -1.
  Site sample(int axis, Site f) const {
    Site best = -1;
    // Nearer samples would magnify their errors. Slits without a farther one are less than a twentieth open and have
    // almost no flux.
    double farthest = 0.25 * layout_.h();
    for (int b = 0; b < Dim; ++b)
      for (Site g : {f - layout_.stride(b), f + layout_.stride(b)}) {
        if (s_.kind_at(axis, g) != SampleKind::unknown || s_.psi.at(axis, g) <= farthest) continue;
        best = g;
        farthest = s_.psi.at(axis, g);
      }
    return best;
  }
  // du'/dpsi at the wall beside a face, 1/s, from u' at the distance psi of the sample `from`. u' is linear only as far
  // as viscosity rules: |u'| psi/nu <= 25, the viscous sublayer y+ <= 5 (Pope, Turbulent Flows, 2000, 7.1.4). Beyond it
  // |u'| counts as 25 nu/psi. A fluid without viscosity slips.
  double wall_slope(int k, int axis, Site f, Site from) const {
    constexpr double sublayer = 25;
    const Vec3 x = extend<Dim>(layout_.position(layout_.index(from), face_offset<Dim>(axis)));
    const double relative = u_.at(axis, from) - motion_[k].at(x)[axis], psi = s_.psi.at(axis, from);
    const double most = sublayer * kinematic_viscosity(axis, f) / psi;
    return std::clamp(relative, -most, most) / psi;
  }
  // The smaller one of the two cells, m^2/s.
  double kinematic_viscosity(int axis, Site f) const {
    const auto of_cell = [&](Site c) {
      const bool gas = in_.projection.has_gas() && !in_.projection.is_liquid(c);
      return in_.viscosity[c] / (gas ? in_.projection.gas_density : in_.density);
    };
    return std::min(of_cell(f), of_cell(f - layout_.stride(axis)));
  }

  const ViscousInput<Dim>& in_;
  const Layout<Dim>& layout_;
  const ViscousSamples<Dim>& s_;
  const std::vector<RigidField>& motion_;
  const FaceField<Dim>& u_;
};

}  // namespace

template <int Dim>
void add_no_slip_flux(const ViscousInput<Dim>& in, const ViscousSamples<Dim>& samples,
                      const std::vector<RigidField>& motion, const FaceField<Dim>& u, FaceField<Dim>& closed_flux) {
  const NoSlipFlux<Dim> flux(in, samples, motion, u);
  for (int a = 0; a < Dim; ++a)
    for_each_site(in.layout, in.layout.grown(1), [&](Site f) { closed_flux.at(a, f) += flux(a, f); });
}

template void add_no_slip_flux<2>(const ViscousInput<2>&, const ViscousSamples<2>&, const std::vector<RigidField>&,
                                  const FaceField<2>&, FaceField<2>&);
template void add_no_slip_flux<3>(const ViscousInput<3>&, const ViscousSamples<3>&, const std::vector<RigidField>&,
                                  const FaceField<3>&, FaceField<3>&);

}  // namespace seiche
