#include "coupling/solids/end_of_step.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "grid/interpolation.h"

namespace seiche {
namespace {

template <int Dim>
bool moves_freely(const Body<Dim>& body) {
  return body.is_free() && !body.deforms();
}

// Placements with the known velocities, one a solid.
template <int Dim>
std::vector<Placement> with_velocities(const State<Dim>& known, std::vector<Placement> placed) {
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const Vec3 about = placed[k].twist.about;
    known.solids[k].set_velocity(placed[k]);
    placed[k].twist.about = about;
  }
  return placed;
}

// Placements at the end, reached from half-way by the known velocities.
template <int Dim>
std::vector<Placement> placed_ahead(const State<Dim>& known, const State<Dim>& next) {
  Participants<Dim> solids = next.solids;
  std::vector<Placement> placed;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    solids[k].go_on(known.solids[k], next.since_solve);
    placed.push_back(solids[k].place(next.time - next.dt_now, next.time, next.time));
  }
  return with_velocities(known, std::move(placed));
}

// v turned by the angle that a twist makes in dt.
Vec3 turned_by(const Twist& twist, double dt, const Vec3& v) {
  const double rate = twist.angular.norm();
  if (rate == 0) return v;
  return Eigen::AngleAxisd(dt * rate, twist.angular / rate) * v;
}

// Component along `axis` at x of the flow u, m/s, as a solid has carried and turned it for dt.
template <int Dim>
double carried_flow(const Layout<Dim>& layout, const FaceField<Dim>& u, const Twist& twist, double dt, int axis,
                    const Vec3& x) {
  const Vec<Dim> from = truncate<Dim>(x - dt * twist.at(x));
  Vec<Dim> v;
  for (int b = 0; b < Dim; ++b)
    v[b] = interpolate_linear<Dim>(layout, u[b].data(), index_coordinates<Dim>(layout, from, face_offset<Dim>(b)));
  return turned_by(twist, dt, extend<Dim>(v))[axis];
}

// Closed shares of a face by one solid, half-way and at the end.
struct TwoShares {
  double half = 0, end = 0;
};

template <int Dim>
std::array<std::unordered_map<Site, TwoShares>, Dim> both_shares(const FaceShares& half, const FaceShares& end) {
  std::array<std::unordered_map<Site, TwoShares>, Dim> faces;
  for (const FaceShare& s : half) faces[std::size_t(s.axis)][s.face].half = s.closed;
  for (const FaceShare& s : end) faces[std::size_t(s.axis)][s.face].end = s.closed;
  return faces;
}

// s' v' - s v - (s' - s) u
template <int Dim>
void add_solid(const Layout<Dim>& layout, const FaceField<Dim>& u, const FaceShares& half_shares,
               const FaceShares& end_shares, const Twist& half, const Twist& end, double dt,
               PagedFaceField<Dim>& flux) {
  const auto faces = both_shares<Dim>(half_shares, end_shares);
  for (int a = 0; a < Dim; ++a)
    for (const auto& [face, s] : faces[std::size_t(a)]) {
      const Vec3 x = extend<Dim>(layout.position(layout.index(face), face_offset<Dim>(a)));
      double change = s.end * end.at(x)[a] - s.half * half.at(x)[a];
      if (s.end != s.half) change -= (s.end - s.half) * carried_flow(layout, u, end, dt, a, x);
      flux.add(a, face, change);
    }
}

}  // namespace

template <int Dim>
bool fits_end_of_step(const Fluids& fluids, const Solids<Dim>& solids) {
  return !fluids.is_viscous() && std::any_of(solids.bodies.begin(), solids.bodies.end(), moves_freely<Dim>);
}

template <int Dim>
std::shared_ptr<const EndOfStep<Dim>> end_of_step(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                                  const State<Dim>& known, const State<Dim>& next,
                                                  const StepGeometry<Dim>& half, double dt) {
  const std::vector<Placement> middle = with_velocities(known, half.placed), end = placed_ahead(known, next);
  const auto moves = [&](const Body<Dim>& body) {
    return moves_freely(body) && !end[std::size_t(&body - solids.bodies.data())].twist.at_rest();
  };
  if (std::none_of(solids.bodies.begin(), solids.bodies.end(), moves)) return {};
  auto r = std::make_shared<EndOfStep<Dim>>(
      EndOfStep<Dim>{solids.geometry.measure(end, next.time), PagedFaceField<Dim>(domain.layout)});
  for (std::size_t k = 0; k < solids.bodies.size(); ++k)
    if (moves(solids.bodies[k]))
      add_solid(domain.layout, known.now->u, *half.shares[k], *r->geometry.shares[k], middle[k].twist, end[k].twist, dt,
                r->flux);
  return r;
}

template <int Dim>
void add_flux_of_end(const Domain<Dim>& domain, const PressureRows<Dim>& rows, const NullSpace& closed,
                     const PagedFaceField<Dim>& flux, FaceGeometry<Dim>& faces) {
  std::vector<double> net = net_over_rows(
      domain.layout, domain.ranks, rows, [](Site) { return 0.0; }, [&](int a, Site f) { return flux.at(a, f); });
  std::vector<double> sums(2 * std::size_t(closed.count));  // of the fluxes and of their sizes, a component each
  const auto component = [&](std::size_t n) { return closed.count > 0 ? closed.component[n] : -1; };
  for (std::size_t n = 0; n < net.size(); ++n)
    if (const int c = component(n); c >= 0) {
      sums[2 * std::size_t(c)] += net[n];
      sums[2 * std::size_t(c) + 1] += std::abs(net[n]);
    }
  domain.ranks.global_sum(sums);
  for (std::size_t n = 0; n < net.size(); ++n) {
    const int c = component(n);
    if (c >= 0 && net[n] != 0) net[n] -= std::abs(net[n]) * sums[2 * std::size_t(c)] / sums[2 * std::size_t(c) + 1];
    if (net[n] != 0) faces.cell_flux.add(rows.cells[n], net[n]);
  }
}

template <int Dim>
void place_at(const StepGeometry<Dim>& end, StepGeometry<Dim>& g) {
  g.psi = end.psi;
  g.body = end.body;
  for (std::size_t k = 0; k < g.placed.size(); ++k) {
    g.placed[k].pose = end.placed[k].pose;
    g.placed[k].twist.about = end.placed[k].twist.about;
  }
}

#define SEICHE_INSTANTIATE(D)                                                                                      \
  template bool fits_end_of_step<D>(const Fluids&, const Solids<D>&);                                              \
  template std::shared_ptr<const EndOfStep<D>> end_of_step<D>(const Domain<D>&, const Solids<D>&, const State<D>&, \
                                                              const State<D>&, const StepGeometry<D>&, double);    \
  template void add_flux_of_end<D>(const Domain<D>&, const PressureRows<D>&, const NullSpace&,                     \
                                   const PagedFaceField<D>&, FaceGeometry<D>&);                                    \
  template void place_at<D>(const StepGeometry<D>&, StepGeometry<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
