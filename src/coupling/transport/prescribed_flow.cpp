#include "coupling/transport/prescribed_flow.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/expression.h"
#include "base/time_spec.h"
#include "coupling/state/fluids.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/restore.h"
#include "fluid/boundary/domain.h"
#include "fluid/volume/surface_pieces.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

template <int Dim>
using Mask = CellField<Dim, char>;

// Sets all stored cells within `layers` of a set one along each axis.
template <int Dim>
void grow(const Layout<Dim>& layout, int layers, Mask<Dim>& mask) {
  const Box<Dim> all = layout.padded();
  for (int a = 0; a < Dim; ++a) {
    const Mask<Dim> old = mask;
    for_each_index(layout, all, [&](Site c, const IVec<Dim>& i) {
      const int from = std::max(-layers, all.lower[a] - i[a]), to = std::min(layers, all.upper[a] - 1 - i[a]);
      for (int k = from; k <= to && !mask[c]; ++k) mask[c] = old[c + k * layout.stride(a)];
    });
  }
}

// Marks the cells beside inflow sides, where liquid may begin.
template <int Dim>
void mark_inflow(const Domain<Dim>& domain, Mask<Dim>& mask) {
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1})
      if (domain.sides.type(a, side) == SideType::inflow)
        for_each_site(domain.layout, faces_of_side(domain.layout, a, side),
                      [&](Site f) { mask[side == 0 ? f : f - domain.layout.stride(a)] = 1; });
}

// Cells of the liquid and of the band around it, phi < band or with a share of it, those beside inflow sides, and
// `layers` cells around them; `all` false: |phi| < band or in part full.
template <int Dim>
Mask<Dim> around_surface(const Domain<Dim>& domain, const State<Dim>& state, int layers, bool all = false) {
  const CellField<Dim>&phi = state.phi, &share = state.liquid;
  Mask<Dim> mask(domain.layout);
  for_each_site(domain.layout, domain.layout.padded(), [&](Site c) {
    mask[c] = (all ? phi[c] : std::abs(phi[c])) < domain.band();
    if (!share.empty() && !mask[c]) mask[c] = all ? share[c] != 0 : is_mixed(share[c]);
  });
  mark_inflow(domain, mask);
  grow(domain.layout, layers, mask);
  return mask;
}

// Index shifted into the domain along periodic axes, so that formulas are evaluated only there.
template <int Dim>
IVec<Dim> within_period(const Geometry<Dim>& g, IVec<Dim> i) {
  for (int a = 0; a < Dim; ++a)
    if (g.periodic[a]) i[a] = (i[a] % g.cells[a] + g.cells[a]) % g.cells[a];
  return i;
}

// Mean of a component over the face with centre x: Gauss's rule of three points along each axis of the face. The means
// of a flow without divergence have none on the grid, to (h/L)^6.
template <int Dim>
double face_mean(const VectorExpression& formula, int axis, const Vec<Dim>& x, double h, double t) {
  static const std::array<double, 3> place{-std::sqrt(0.15), 0, std::sqrt(0.15)}, weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (int n = 0; n < (Dim == 3 ? 9 : 3); ++n) {
    Vec<Dim> y = x;
    double w = 1;
    for (int b = 1, rest = n; b < Dim; ++b, rest /= 3) {
      y[(axis + b) % Dim] += place[std::size_t(rest % 3)] * h;
      w *= weight[std::size_t(rest % 3)];
    }
    sum += w * formula.component(axis, extend<Dim>(y), t);
  }
  return sum;
}

// Means of the formulas at time t (s) on the low faces of the masked cells, 0 on others. Throws as prescribed_flow()
// does. Collective.
template <int Dim>
FaceField<Dim> evaluate(const Domain<Dim>& domain, const Fluids& fluids, const Mask<Dim>& where, double t) {
  const VectorFormula& text = *fluids.liquid.prescribed_velocity;
  const VectorExpression formula(text);
  FaceField<Dim> u(domain.layout);
  std::string fault;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(domain.layout, domain.layout.padded(), [&](Site f, const IVec<Dim>& i) {
      if (!where[f]) return;
      const Vec<Dim> x = domain.layout.position(within_period(domain.layout.geometry(), i), face_offset<Dim>(a));
      u.at(a, f) = face_mean<Dim>(formula, a, x, domain.layout.h(), t);
      if (fault.empty() && !std::isfinite(u.at(a, f)))
        fault = not_finite_text<Dim>(fmt::format("liquid.prescribed_velocity[{}]", a), text[a], u.at(a, f), x, t);
    });
  fault = first_text(domain.ranks, fault);
  if (!fault.empty()) throw Error(t > 0 ? ExitCode::cannot_continue : ExitCode::bad_input, fault);
  return u;
}

}  // namespace

template <int Dim>
FaceField<Dim> prescribed_flow(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, double t) {
  FaceField<Dim> u = evaluate(domain, fluids, around_surface(domain, state, domain.layout.halo(), true), t);
  domain.halo.fill_ghosts(u);  // near the halo's end ranks know different parts of the liquid
  return u;
}

template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> prescribed_level(const Domain<Dim>& domain, const Fluids& fluids,
                                                       const State<Dim>& state, double t) {
  const Mask<Dim> wet = around_surface(domain, state, 1, true);
  auto level = std::make_shared<TimeLevel<Dim>>(empty_level(domain.layout, fluids.is_viscous()));
  level->u = evaluate(domain, fluids, wet, t);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (wet[f]) level->valid.at(a, f) = face_prescribed;
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, level->u);
  domain.halo.fill_ghosts(level->valid);
  return level;
}

template <int Dim>
double fastest_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, double t) {
  const FaceField<Dim> u = evaluate(domain, fluids, around_surface(domain, state, 1), t);
  double fastest = 0;
  for (int a = 0; a < Dim; ++a)
    fastest = std::max(
        fastest, local_max(domain.layout, domain.layout.faces(a), 0.0, [&](Site f) { return std::abs(u.at(a, f)); }));
  return domain.ranks.global_max(fastest);
}

// The sample times are such that flows over whole or half periods are not zero at all of them.
template <int Dim>
double limit_of_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                           const State<Dim>& state, double remaining) {
  constexpr int most_looks = 20;
  constexpr double rounding = 1e-9;
  const double reach = time.cfl * domain.layout.h(), now = fastest_prescribed(domain, fluids, state, state.time);
  double dt = state.step > 0 ? std::min(remaining, 2 * state.dt_now) : remaining;
  if (now * dt > reach) dt = reach / now;
  for (int n = 0; n < most_looks; ++n) {
    double fastest = 0;
    for (const double part : {0.29, 0.5, 1.0})
      fastest = std::max(fastest, fastest_prescribed(domain, fluids, state, state.time + part * dt));
    if (fastest * dt <= reach * (1 + rounding)) break;
    dt = reach / fastest;
  }
  return dt;
}

// The flow at the middle of the step transports the surface.
template <int Dim>
std::string fault_of_prescribed(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                                const State<Dim>& state, double dt) {
  const double most = std::ceil(time.cfl);
  const double crossed = fastest_prescribed(domain, fluids, state, state.time + 0.5 * dt) * dt / domain.layout.h();
  if (crossed <= most * (1 + 1e-6)) return {};
  return fmt::format(
      "the prescribed flow crosses {:.3g} cells of {:g} m in a step; at most {:g} are possible at cfl = {:g}", crossed,
      domain.layout.h(), most, time.cfl);
}

template <int Dim>
double largest_divergence(const Domain<Dim>& domain, const CellField<Dim>& phi, const FaceField<Dim>& u) {
  return domain.ranks.global_max(local_max(domain.layout, domain.layout.cells(), 0.0, [&](Site c) {
    double sum = 0;
    for (int a = 0; a < Dim; ++a) sum += u.at(a, c + domain.layout.stride(a)) - u.at(a, c);
    return phi[c] < 0 ? std::abs(sum) / domain.layout.h() : 0.0;
  }));
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template FaceField<D> prescribed_flow<D>(const Domain<D>&, const Fluids&, const State<D>&, double);                \
  template std::shared_ptr<const TimeLevel<D>> prescribed_level<D>(const Domain<D>&, const Fluids&, const State<D>&, \
                                                                   double);                                          \
  template double fastest_prescribed<D>(const Domain<D>&, const Fluids&, const State<D>&, double);                   \
  template double limit_of_prescribed<D>(const Domain<D>&, const Fluids&, const TimeSpec&, const State<D>&, double); \
  template std::string fault_of_prescribed<D>(const Domain<D>&, const Fluids&, const TimeSpec&, const State<D>&,     \
                                              double);                                                               \
  template double largest_divergence<D>(const Domain<D>&, const CellField<D>&, const FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
