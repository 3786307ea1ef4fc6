#include "coupling/transport/carried_acceleration.h"

#include "base/time_spec.h"
#include "coupling/transport/beside_solids.h"
#include "coupling/transport/restore.h"
#include "grid/loops.h"
#include "levelset/minmod.h"

namespace seiche {
namespace {

constexpr double rounding = 1e-9;  // of Courant numbers: scenes with cfl = 1 or 2 must not change by it

template <int Dim>
double courant_number(const Domain<Dim>& domain, const State<Dim>& state, double dt) {
  return fastest_component(domain, state) * dt / domain.layout.h();
}

// One pass of the (1, 2, 1)/4 filter along every axis, on the `reached` sites; f is 0 elsewhere. `scratch` as well.
// Each axis takes one layer of ghosts along it, which are filled once at the end. Outer terms are added first, so that
// both sides of a mirror have the same bits.
template <int Dim>
void smooth(const Domain<Dim>& domain, const CellField<Dim, char>& reached, FaceField<Dim>& f,
            FaceField<Dim>& scratch) {
  for (int axis = 0; axis < Dim; ++axis) {
    std::swap(f, scratch);
    const Site d = domain.layout.stride(axis);
    Box<Dim> inner = domain.layout.padded();
    inner.lower[axis] += 1, inner.upper[axis] -= 1;
    for (int a = 0; a < Dim; ++a)
      for_each_marked(domain.layout, inner, reached.data(), [&](Site c) {
        f.at(a, c) = 0.25 * (scratch.at(a, c - d) + scratch.at(a, c + d) + 2 * scratch.at(a, c));
      });
  }
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, f);
}

// Change of the pressure slope from t - dt_now/2 to t + dt/2, m/s^2. Without a filter, extrapolation amplifies waves
// that the flow carries more than about an eighth of their length a step. Errors obey r^2 = c ((1 + F) r - F), c = (1 -
// exp(-i theta))/2, with F the filter's response. 2 C^2 passes of the filter keep |r| <= 1 up to the Courant number C =
// 2; beyond it the trend is zero.
template <int Dim>
FaceField<Dim> slope_trend(const Domain<Dim>& domain, const State<Dim>& state, const Flow<Dim>& flow,
                           const CellField<Dim, char>& reached, double dt) {
  FaceField<Dim> trend(domain.layout);
  if (!flow.before || state.dt_before == 0 || dt > 2 * state.dt_now || !may_extrapolate(domain, state, dt))
    return trend;
  const double courant = courant_number(domain, state, dt);
  const TimeLevel<Dim>&l0 = *flow.now, &l1 = *flow.before;
  const double ratio = (dt + state.dt_now) / (state.dt_now + state.dt_before);
  for (int a = 0; a < Dim; ++a)
    for_each_marked(domain.layout, domain.layout.faces(a), reached.data(), [&](Site f) {
      if (l0.valid.at(a, f) == face_solved && l1.valid.at(a, f) == face_solved)
        trend.at(a, f) = ratio * (l0.q.at(a, f) - l1.q.at(a, f));
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, trend);
  FaceField<Dim> scratch(domain.layout);
  for (int n = 0; n < std::ceil(2 * courant * courant - 8 * rounding); ++n) smooth(domain, reached, trend, scratch);
  return trend;
}

// Largest |A| that is carried, m/s^2. An impact changes velocity by an amount independent of dt, so its A does not
// predict the next step. |A| dt^2 <= h/4 excludes impacts and leaves resolved flow alone, where A dt^2/h is O(h). Flow
// about a solid of a few cells exceeds it step after step: A of the same sign in the step before allows up to h.
double largest_carried(double acceleration, double before, double h, double dt) {
  const double least = 0.25 * h / (dt * dt);
  return acceleration * before > 0 ? std::clamp(std::abs(before), least, 4 * least) : least;
}

// True if the fluid comes in through this outflow side. q leaves out what brakes it there
// (ProjectionInput::entry_factor), so that g - q is no acceleration.
template <int Dim>
bool enters(const Domain<Dim>& domain, int axis, Site face, double u) {
  if (!domain.sides.any_passes()) return false;
  const int i = domain.layout.index(face)[axis], last = domain.layout.geometry().cells[axis];
  return (i == 0 && u > 0 && domain.sides.is_outflow(axis, 0)) ||
         (i == last && u < 0 && domain.sides.is_outflow(axis, 1));
}

}  // namespace

template <int Dim>
bool may_extrapolate(const Domain<Dim>& domain, const State<Dim>& state, double dt) {
  return courant_number(domain, state, dt) <= 2 + rounding;
}

template <int Dim>
FaceField<Dim> carried_acceleration(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                                    const OperatorPerturbation& perturbation, const State<Dim>& state,
                                    const Flow<Dim>& flow, const CellField<Dim, char>& reached,
                                    const FaceField<Dim, char>& deep, double dt) {
  FaceField<Dim> acc(domain.layout);
  if (state.dt_now == 0 || time.scheme == TimeScheme::first_order) return acc;
  const FaceField<Dim> trend = slope_trend(domain, state, flow, reached, dt);
  const TimeLevel<Dim>& level = *flow.now;
  const Vec3 g = perturbation.gravity * fluids.gravity.of_step(state.time + dt, dt);
  FaceField<Dim, char> known(domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_marked(domain.layout, domain.layout.faces(a), reached.data(), [&](Site f) {
      known.at(a, f) = level.valid.at(a, f) == face_prescribed;
      if (level.valid.at(a, f) != face_solved || enters(domain, a, f, level.u.at(a, f))) return;
      const bool knows_before = flow.before && flow.before->valid.at(a, f) == face_solved;
      const double now = g[a] - level.q.at(a, f) - trend.at(a, f);
      const double before = knows_before ? g[a] - flow.before->q.at(a, f) : 0;
      const double most = largest_carried(now, before, domain.layout.h(), dt);
      const double limited = std::clamp(now, -most, most);
      acc.at(a, f) = deep.at(a, f) ? limited : minmod(limited, before);
      known.at(a, f) = deep.at(a, f) || knows_before;
    });
  continue_beyond(domain, known, acc);
  return acc;
}

#define SEICHE_INSTANTIATE(D)                                                                                 \
  template bool may_extrapolate<D>(const Domain<D>&, const State<D>&, double);                                \
  template FaceField<D> carried_acceleration<D>(const Domain<D>&, const Fluids&, const TimeSpec&,             \
                                                const OperatorPerturbation&, const State<D>&, const Flow<D>&, \
                                                const CellField<D, char>&, const FaceField<D, char>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
