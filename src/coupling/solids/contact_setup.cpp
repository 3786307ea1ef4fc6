#include "coupling/solids/contact_setup.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/domain_spec.h"
#include "base/error.h"
#include "base/time_spec.h"
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"

namespace seiche {
namespace {

// Contact forces act below this distance, in cells: far less than the grid resolves, far more than round-off.
constexpr double reach_of_contact = 0.05;
// Smallest gap at the start, as a share of the reach. Gaps that narrow are still open on the grid, which closes those
// below 1e-3 cells.
constexpr double clearance = 0.05;

template <int Dim>
std::vector<ContactWall> closed_sides(const DomainSpec& d) {
  std::vector<ContactWall> walls;
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      const SideType type = d.sides[a][side].type;
      if (type == SideType::periodic || type == SideType::outflow) continue;
      ContactWall wall{side == 0 ? d.lower : d.upper, Vec3::Zero()};
      wall.normal[a] = side == 0 ? 1 : -1;
      walls.push_back(wall);
    }
  return walls;
}

}  // namespace

template <int Dim>
ContactScene<Dim> make_contact_scene(const DomainSpec& extent, const Participants<Dim>& solids,
                                     std::vector<std::array<int, 2>> apart, PairCoefficients friction,
                                     const OperatorPerturbation& perturbation) {
  std::vector<ContactBody> contact;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const Body<Dim>& body = solids[k].body();
    ContactBody& c = contact.emplace_back();
    c.surface = body.contact_surface();
    solids[k].describe_contact(c);
    c.friction = body.spec().friction;
    if (c.friction) *c.friction *= perturbation.friction;
    c.name = body.spec().name;
  }
  for (auto& [pair, mu] : friction) mu *= perturbation.friction;
  return {contact, closed_sides<Dim>(extent), std::move(apart), std::move(friction)};
}

template <int Dim>
std::vector<ContactMotion> contact_motions(const State<Dim>& state, double horizon) {
  std::vector<ContactMotion> motions;
  for (std::size_t k = 0; k < state.solids.size(); ++k)
    motions.push_back(state.solids[k].contact_motion(state.time, horizon));
  return motions;
}

// Stiffness scales with weight under the largest gravity of the run, speeds with a free fall through one cell. Neither
// depends on the step: a growing stiffness would throw bodies at rest upwards. Without gravity, an acceleration that
// crosses the domain in about ten frames replaces it.
template <int Dim>
ContactOptions contact_options(const Domain<Dim>& domain, const DomainSpec& extent, const TimeSpec& time,
                               const Gravity& gravity, const OperatorPerturbation& perturbation) {
  const double length = (extent.upper - extent.lower).norm(), rate = 0.1 * time.frame_rate;
  const double h = domain.layout.h(), weight = gravity.largest(0, time.end),
               g = weight > 0 ? weight : length * rate * rate;
  ContactOptions o;
  o.reach = reach_of_contact * h;
  o.acceleration = perturbation.contact * g;
  o.usual_speed = std::sqrt(g * h);
  o.creep_speed = 1e-4 * o.usual_speed;
  o.speed_tolerance = 0.01 * o.creep_speed;
  return o;
}

template <int Dim>
std::string other_name(const Solids<Dim>& solids, const DomainSpec& extent, const Overlap& o) {
  if (o.with == Overlap::With::body) return "'" + solids.bodies[o.other].spec().name + "'";
  const Vec3 normal = closed_sides<Dim>(extent)[std::size_t(o.other)].normal;
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return fmt::format("the side {}_{}", "xyz"[axis], normal[axis] > 0 ? "lower" : "upper");
}

// Pinned solids are often meant to stand on something.
template <int Dim>
std::string remedy(const Solids<Dim>& solids, const Overlap& o) {
  const bool moves = o.with == Overlap::With::body && solids.at_start[std::size_t(o.other)].unknowns() > 0;
  if (!solids.at_start[std::size_t(o.body)].is_pinned() || moves) return "move them apart";
  return "move them apart, or let the part that is pinned end at the other's surface";
}

// Surface points of body k as placed.
template <int Dim>
std::vector<Vec3> surface_of(const State<Dim>& state, std::size_t k) {
  const Participant<Dim>& solid = state.solids[k];
  std::vector<Vec3> points = solid.body().contact_surface().points;
  solid.place_points(solid.place(state.time, state.time, state.time), points);
  return points;
}

// Names of the periodic sides across an axis that body k crosses or is within `near` cells of.
template <int Dim>
std::vector<std::string> sides_reached(const Domain<Dim>& domain, const State<Dim>& state, std::size_t k, int axis,
                                       double near) {
  const Geometry<Dim>& g = domain.layout.geometry();
  std::vector<std::string> sides;
  if (!g.periodic[axis]) return sides;
  const std::vector<Vec3> points = surface_of(state, k);
  for (const int side : {0, 1}) {
    const double at = g.lower[axis] + side * g.h * g.cells[axis];
    const auto reaches = [&](const Vec3& x) { return (side ? x[axis] - at : at - x[axis]) > -near * g.h; };
    if (std::any_of(points.begin(), points.end(), reaches))
      sides.push_back(fmt::format("{}_{}", "xyz"[axis], side ? "upper" : "lower"));
  }
  return sides;
}

// The same across all axes. Empty if the body has no unknowns.
template <int Dim>
std::vector<std::string> periodic_sides_at(const Domain<Dim>& domain, const State<Dim>& state, std::size_t k,
                                           double near) {
  std::vector<std::string> sides;
  for (int a = 0; a < Dim && state.solids[k].unknowns() > 0; ++a)
    for (std::string& side : sides_reached(domain, state, k, a, near)) sides.push_back(std::move(side));
  return sides;
}

template <int Dim>
std::string solids_at_periodic_sides(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& state) {
  constexpr double near = 0.1;  // cells
  std::string names;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k)
    for (const std::string& side : periodic_sides_at(domain, state, k, near))
      names += fmt::format("{}'{}' and the periodic side {} (solids cannot cross periodic sides)",
                           names.empty() ? "" : ", ", solids.bodies[k].spec().name, side);
  return names;
}

template <int Dim>
std::string prescribed_across_periodic_sides(const Domain<Dim>& domain, const State<Dim>& state,
                                             const std::vector<Placement>& placed) {
  constexpr double beyond = 0.5;  // cells; one that ends at the side is not across it
  for (std::size_t k = 0; k < state.solids.size(); ++k)
    for (int a = 0; a < Dim; ++a) {
      if (!state.solids[k].body().is_prescribed() || placed[k].twist.linear[a] == 0) continue;
      for (const std::string& side : sides_reached(domain, state, k, a, -beyond))
        return fmt::format(
            "solid '{}' moves across the periodic side {}; the liquid does not see its part beyond, and "
            "pictures show it there alone (reported once)",
            state.solids[k].body().spec().name, side);
    }
  return {};
}

template <int Dim>
std::string nearest_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                           const State<Dim>& state) {
  std::string names = solids_at_periodic_sides(domain, solids, state);
  if (!solids.contact) return names;
  const auto motions = contact_motions(state, 0);
  for (const Overlap& o : find_initial_overlaps(*solids.contact, motions, 0.1 * reach_of_contact * domain.layout.h()))
    names += fmt::format("{}'{}' and {}", names.empty() ? "" : ", ", solids.bodies[o.body].spec().name,
                         other_name(solids, extent, o));
  return names;
}

template <int Dim>
std::string corners_text(const Vec3& lower, const Vec3& upper) {
  const Vec<Dim> a = truncate<Dim>(lower), b = truncate<Dim>(upper);
  return fmt::format("[{:.4g}] to [{:.4g}] m", fmt::join(a.begin(), a.end(), ", "),
                     fmt::join(b.begin(), b.end(), ", "));
}

// Message if a body that crosses a side lies wholly outside the domain, or is far larger than it: surely a mistake.
// Else empty.
template <int Dim>
std::string misplacement(const DomainSpec& extent, const Body<Dim>& body) {
  const Vec3 lower = extent.lower, upper = extent.upper;
  Eigen::AlignedBox3d box;
  for (const Vec3& x : body.contact_surface().points) box.extend(x);
  constexpr double far_larger = 10;
  bool outside = false, larger = false;
  for (int a = 0; a < Dim; ++a) {
    outside |= box.max()[a] <= lower[a] || box.min()[a] >= upper[a];
    larger |= box.sizes()[a] > far_larger * (upper[a] - lower[a]);
  }
  if (!outside && !larger) return {};
  return fmt::format("{}: it spans {}, the domain {}; {}",
                     larger ? "is far larger than the domain" : "lies outside of the domain",
                     corners_text<Dim>(box.min(), box.max()), corners_text<Dim>(lower, upper),
                     larger ? "lengths are in metres (from millimetres: scale = 0.001)" : "move it inside");
}

template <int Dim>
std::string fault_of_overlap(const Solids<Dim>& solids, const DomainSpec& extent, const Overlap& o, double least) {
  const std::string name = solids.bodies[o.body].spec().name;
  if (o.with == Overlap::With::body && o.other == o.body)
    return fmt::format(
        "the surface of the elements of solid '{}' crosses itself; take another element_size, or round its edges",
        name);
  const std::string how = o.depth > 0 ? fmt::format("overlap by {:.3g} m", o.depth)
                                      : fmt::format("touch or are closer than {:.3g} m", least);
  return fmt::format("solid '{}' and {} {} at the start; {}", name, other_name(solids, extent, o), how,
                     remedy(solids, o));
}

// Messages for elastic bodies beyond a periodic side, since the liquid does not see that part. A surface may end at the
// side.
template <int Dim>
std::vector<std::string> faults_at_periodic_sides(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                                  const State<Dim>& state) {
  constexpr double rounding = 1e-6;  // cells
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
    if (!solids.bodies[k].deforms()) continue;
    const SolidSpec& spec = solids.bodies[k].spec();
    for (const std::string& side : periodic_sides_at(domain, state, k, -rounding))
      lines.push_back(
          fmt::format("{}: elastic solid '{}' reaches beyond the periodic side {}, but solids cannot cross periodic "
                      "sides; move it inside the domain, or make these sides walls",
                      spec.shape.where, spec.name, side));
  }
  return lines;
}

template <int Dim>
void refuse_overlaps(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                     const State<Dim>& state) {
  if (!solids.contact) return;
  std::vector<std::string> lines = faults_at_periodic_sides(domain, solids, state);
  const double least = clearance * reach_of_contact * domain.layout.h();
  for (const Overlap& o : find_initial_overlaps(*solids.contact, contact_motions(state, 0), least)) {
    const Body<Dim>& body = solids.bodies[o.body];
    const std::string misplaced = o.with == Overlap::With::wall ? misplacement(extent, body) : "";
    const std::string fault = misplaced.empty() ? fault_of_overlap(solids, extent, o, least)
                                                : fmt::format("solid '{}' {}", body.spec().name, misplaced);
    const std::string line = body.spec().shape.where + ": " + fault;
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  if (!lines.empty()) throw Error(ExitCode::bad_input, fmt::format("{}", fmt::join(lines, "\n")));
}

template <int Dim>
double safe_share(const Solids<Dim>& solids, const State<Dim>& state, double dt) {
  if (!solids.contact) return 1;
  return largest_safe_fraction(*solids.contact, contact_motions(state, dt), dt, velocities_over(solids, state, dt));
}

#define SEICHE_INSTANTIATE(D)                                                                                      \
  template ContactScene<D> make_contact_scene<D>(const DomainSpec&, const Participants<D>&,                        \
                                                 std::vector<std::array<int, 2>>, PairCoefficients,                \
                                                 const OperatorPerturbation&);                                     \
  template std::string solids_at_periodic_sides<D>(const Domain<D>&, const Solids<D>&, const State<D>&);           \
  template std::string prescribed_across_periodic_sides<D>(const Domain<D>&, const State<D>&,                      \
                                                           const std::vector<Placement>&);                         \
  template std::string nearest_solids<D>(const Domain<D>&, const Solids<D>&, const DomainSpec&, const State<D>&);  \
  template void refuse_overlaps<D>(const Domain<D>&, const Solids<D>&, const DomainSpec&, const State<D>&);        \
  template std::vector<ContactMotion> contact_motions<D>(const State<D>&, double);                                 \
  template ContactOptions contact_options<D>(const Domain<D>&, const DomainSpec&, const TimeSpec&, const Gravity&, \
                                             const OperatorPerturbation&);                                         \
  template double safe_share<D>(const Solids<D>&, const State<D>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
