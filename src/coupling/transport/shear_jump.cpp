#include "coupling/transport/shear_jump.h"

#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/transport/restore.h"
#include "fluid/boundary/domain.h"
#include "fluid/pressure/pressure.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// One fluid: density (kg/m^3), viscosity (Pa s) and viscous acceleration n of the last step.
template <int Dim>
struct OneFluid {
  double density = 0, viscosity = 0;
  FaceField<Dim> n;  // m/s^2, halo filled
  const TimeLevel<Dim>& level;

  bool knows(int axis, Site f) const { return level.valid.at(axis, f) == face_solved; }
};

template <int Dim>
OneFluid<Dim> make_fluid(const Domain<Dim>& domain, const TimeLevel<Dim>& level, double density, double viscosity) {
  OneFluid<Dim> fluid{density, viscosity, level.n, level};
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, fluid.n);
  return fluid;
}

// Both fluids around the surface phi.
template <int Dim>
struct BothFluids {
  const Layout<Dim>& layout;
  const CellField<Dim>& phi;
  OneFluid<Dim> liquid, gas;

  double at_face(int axis, Site f) const { return 0.5 * (phi[f] + phi[f - layout.stride(axis)]); }
  const OneFluid<Dim>& of_face(int axis, Site f) const { return at_face(axis, f) < 0 ? liquid : gas; }
  // Density of the link across a face, kg/m^3.
  double density(int axis, Site f) const {
    const double theta = liquid_part(phi[f - layout.stride(axis)], phi[f]);
    return theta * liquid.density + (1 - theta) * gas.density;
  }
  // n_d^2 at the middle of the link between a face and the one above it along d.
  double along_normal(int axis, Site low, int d) const {
    Vec<Dim> g;
    for (int b = 0; b < Dim; ++b) {
      const Site db = layout.stride(b), high = low + layout.stride(d);
      g[b] = b == d ? 2 * (at_face(axis, high) - at_face(axis, low))
                    : 0.5 * (at_face(axis, low + db) - at_face(axis, low - db) + at_face(axis, high + db) -
                             at_face(axis, high - db));
    }
    return g.squaredNorm() > 0 ? g[d] * g[d] / g.squaredNorm() : 0;
  }

  // value: rho n/mu of the fluid at face f, extrapolated linearly from the face `behind` it to the surface, `way` links
  // beyond f. share: change of the value per epsilon/h.
  struct Bend {
    double value = 0, share = 0;
  };
  Bend bend(int axis, Site f, Site behind, double way) const {
    const OneFluid<Dim>& fluid = of_face(axis, f);
    const bool straight = &fluid == &of_face(axis, behind) && fluid.knows(axis, behind);
    const double r = straight ? way : 0, scale = fluid.density / fluid.viscosity;
    return {scale * ((1 + r) * fluid.n.at(axis, f) - r * fluid.n.at(axis, behind)), (1 + r) / fluid.viscosity};
  }

  // epsilon/h, N/m^3, on the link between a face and the one above it along d; 0 if the surface does not cross it.
  double excess(int axis, Site low, int d) const {
    const Site step = layout.stride(d), high = low + step;
    const double at_low = at_face(axis, low), at_high = at_face(axis, high);
    if ((at_low < 0) == (at_high < 0)) return 0;
    const OneFluid<Dim>&below = of_face(axis, low), &above = of_face(axis, high);
    if (!below.knows(axis, low) || !above.knows(axis, high)) return 0;
    const double t = at_low / (at_low - at_high), mu = 2 / (1 / below.viscosity + 1 / above.viscosity);
    const double c = 0.125 * std::pow(1 - std::abs(2 * t - 1), 2) * along_normal(axis, low, d) * mu;
    const Bend under = bend(axis, low, low - step, t), over = bend(axis, high, high + step, 1 - t);
    return c * (over.value - under.value) / (1 - c * (over.share + under.share));
  }
};

}  // namespace

template <int Dim>
void add_shear_jump(const Domain<Dim>& domain, const Fluids& fluids, const Features& features, const State<Dim>& state,
                    const CellField<Dim>& phi, double dt, FaceField<Dim>& u) {
  if (!fluids.is_viscous() || !features.has(Feature::shear_jump)) return;
  const double liquid = *fluids.constant_viscosity(), gas = fluids.gas_viscosity();
  const BothFluids<Dim> both{domain.layout, phi, make_fluid(domain, *state.now, fluids.density(), liquid),
                             make_fluid(domain, *state.exterior->flow.now, fluids.gas_density(), gas)};
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      double force = 0;
      for (int d = 0; d < Dim; ++d)
        if (d != a) force += both.excess(a, f - domain.layout.stride(d), d) - both.excess(a, f, d);
      if (force != 0) u.at(a, f) += dt * force / both.density(a, f);
    });
}

template void add_shear_jump<2>(const Domain<2>&, const Fluids&, const Features&, const State<2>&, const CellField<2>&,
                                double, FaceField<2>&);
template void add_shear_jump<3>(const Domain<3>&, const Fluids&, const Features&, const State<3>&, const CellField<3>&,
                                double, FaceField<3>&);

}  // namespace seiche
