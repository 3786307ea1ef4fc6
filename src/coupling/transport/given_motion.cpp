#include "coupling/transport/given_motion.h"

#include "base/time_spec.h"
#include "coupling/state/source.h"
#include "coupling/transport/sources.h"
#include "fluid/boundary/domain.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Largest velocity component given by a side, m/s. Tangential components count only if liquid sticks to the side or
// enters through it.
template <int Dim>
double fastest_of_side(const Domain<Dim>& domain, int axis, int side, double t) {
  const SideType type = domain.sides.type(axis, side);
  if (type != SideType::inflow && type != SideType::moving_wall && type != SideType::waves) return 0;
  double fastest = 0;
  for_each_index_in_order(domain.layout, faces_of_side(domain.layout, axis, side), [&](Site, const IVec<Dim>& i) {
    const Vec<Dim> x = domain.layout.position(i, face_offset<Dim>(axis));
    const bool along = domain.sides.sticks(axis, side) || domain.sides.inward_speed(axis, side, x, t) > 0;
    for (int b = 0; b < Dim; ++b)
      if (b == axis || along) fastest = std::max(fastest, std::abs(domain.sides.velocity(axis, side, b, x, t)));
  });
  return fastest;
}

// Largest velocity component in the cells of this rank that the source fills, m/s.
template <int Dim>
double fastest_of_source(const Domain<Dim>& domain, const Source<Dim>& source, double t) {
  if (source.is_uniform()) return truncate<Dim>(source.velocity(Vec3::Zero(), t)).cwiseAbs().maxCoeff();
  double fastest = 0;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site, const IVec<Dim>& i) {
    const Vec<Dim> x = domain.layout.position(i, cell_offset<Dim>());
    if (source.distance(x) > 0) return;
    const Vec<Dim> v = truncate<Dim>(source.velocity(extend<Dim>(x), t));
    if (v.allFinite()) fastest = std::max(fastest, v.cwiseAbs().maxCoeff());
  });
  return fastest;
}

template <int Dim>
double fastest_given(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources, double t0, double t1,
                     double t) {
  double fastest = 0;
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) fastest = std::max(fastest, fastest_of_side(domain, a, side, t));
  for (const Source<Dim>& source : sources)
    if (const auto open = open_in_step(source.spec, t0, t1))
      fastest = std::max(fastest, fastest_of_source(domain, source, std::clamp(t, open->begin, open->end)));
  return domain.ranks.global_max(std::isfinite(fastest) ? fastest : 0);
}

}  // namespace

// The sample times are such that motions over whole or half periods are not zero at all of them.
template <int Dim>
double fastest_given_flow(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources, double t, double dt) {
  double fastest = 0;
  for (const double part : {0.0, 0.29, 0.5, 1.0})
    fastest = std::max(fastest, fastest_given(domain, sources, t, t + dt, t + part * dt));
  return fastest;
}

template <int Dim>
double limit_of_given_flow(const Domain<Dim>& domain, const TimeSpec& time, const std::vector<Source<Dim>>& sources,
                           double t, double dt) {
  constexpr int most_looks = 20;
  const double reach = time.cfl * domain.layout.h();
  for (int n = 0; n < most_looks; ++n) {
    const double fastest = fastest_given_flow(domain, sources, t, dt);
    if (fastest * dt <= reach) break;
    dt = reach / fastest;
  }
  return dt;
}

template <int Dim>
double limit_of_given_velocity(const State<Dim>& start, double dt) {
  for (std::size_t k = 0; k < start.solids.size(); ++k) dt = start.solids[k].limit_of_start(dt);
  return dt;
}

#define SEICHE_INSTANTIATE(D)                                                                                      \
  template double fastest_given_flow<D>(const Domain<D>&, const std::vector<Source<D>>&, double, double);          \
  template double limit_of_given_flow<D>(const Domain<D>&, const TimeSpec&, const std::vector<Source<D>>&, double, \
                                         double);                                                                  \
  template double limit_of_given_velocity<D>(const State<D>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
