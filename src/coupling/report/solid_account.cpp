#include "coupling/report/solid_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/domain_spec.h"
#include "coupling/state/fluids.h"
#include "geometry/mesh/clipped_volume.h"

namespace seiche {
namespace {

constexpr double lost_share = 1e-3;     // of a solid's volume outside of the domain, from which on it is told
constexpr double within_domain = 1e-6;  // share from which on a solid counts as within the domain

template <int Dim>
const char* a_metre() {
  return Dim == 2 ? "/m" : "";
}

// The surface of a solid at the start.
template <int Dim>
SurfaceMesh surface_at_start(const Body<Dim>& body) {
  SurfaceMesh mesh = body.contact_surface();
  const Pose pose = body.pose(0);
  for (Vec3& x : mesh.points) x = pose.apply(x);
  return mesh;
}

// Radical inverse of n in a base: van der Corput's sequence, whose first points fill [0, 1) evenly.
double radical_inverse(int n, int base) {
  double sum = 0, digit = 1.0 / base;
  for (; n > 0; n /= base, digit /= base) sum += n % base * digit;
  return sum;
}

// Volume within the domain where a solid's formula is negative, by Halton's points (1960).
template <int Dim>
double sampled_volume(const DomainSpec& extent, const Body<Dim>& body) {
  constexpr int points = 100'000;
  constexpr std::array<int, 3> bases{2, 3, 5};
  const Pose pose = body.pose(0);
  const Vec<Dim> lower = truncate<Dim>(extent.lower), size = truncate<Dim>(extent.upper) - lower;
  int inside = 0;
  for (int n = 1; n <= points; ++n) {
    Vec<Dim> x = lower;
    for (int a = 0; a < Dim; ++a) x[a] += size[a] * radical_inverse(n, bases[a]);
    inside += body.distance_in(pose, x) < 0;
  }
  return size.prod() * inside / points;
}

// A formula is known at the grid's points only: parts thinner than a cell can slip through between them.
template <int Dim>
void warn_of_missed_parts(const DomainSpec& extent, const Body<Dim>& body, double found,
                          std::vector<std::string>& warnings) {
  constexpr double notable = 0.2;  // the contour of a disc of one cell's radius is 10 % too small
  if (body.spec().shape.kind != "expression" || body.deforms()) return;
  const double there = sampled_volume(extent, body);
  if (found > (1 - notable) * there) return;
  warnings.push_back(fmt::format(
      "{}: solid '{}' has parts thinner than a cell of {:g} m, which its formula hides from the grid: it finds {} "
      "of {}, and liquid passes through the rest; take smaller cells, or a shape that has distances (box, capsule, "
      "mesh)",
      body.spec().shape.where, body.spec().name, extent.cell_size, volume_text<Dim>(found), volume_text<Dim>(there)));
}

template <int Dim>
SolidAtStart account_solid(const DomainSpec& extent, const Body<Dim>& body, bool samples,
                           std::vector<std::string>& warnings) {
  const SolidSpec& spec = body.spec();
  SolidAtStart solid;
  solid.name = spec.name;
  solid.kind = spec.kind.name;
  if (spec.shape.invert || spec.shape.kind == "plane" || spec.shape.kind == "height_map") {
    solid.extent = spec.shape.invert ? SolidAtStart::Extent::hole : SolidAtStart::Extent::half_space;
    return solid;
  }
  const SurfaceMesh mesh = surface_at_start(body);
  const double within = clipped_volume<Dim>(mesh, extent.lower, extent.upper);
  if (samples) warn_of_missed_parts(extent, body, within, warnings);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.points) box.extend(x);
  if (box.isEmpty()) return solid;
  const MassProperties bare = mass_of_surface<Dim>(mesh, 1);
  solid.lower = box.min();
  solid.upper = box.max();
  solid.volume = body.is_free() && body.mass().volume > 0 ? body.mass().volume : bare.volume;
  solid.center = body.is_free() ? body.mass().center : bare.center;
  solid.mass = body.is_free() ? body.mass().mass : 0;
  const double share = bare.volume > 0 ? within / bare.volume : 1;
  solid.outside = share < 1 - lost_share ? 1 - share : 0;
  if (share < within_domain && !spec.kind.is_prescribed())
    warnings.push_back(fmt::format("{}: solid '{}' lies outside of the domain, from {} to {} m", spec.shape.where,
                                   spec.name, rounded_place<Dim>(box.min()), rounded_place<Dim>(box.max())));
  return solid;
}

// True if nothing but liquid, gravity and contact moves the body.
template <int Dim>
bool floats_freely(const Body<Dim>& body) {
  const SolidSpec& spec = body.spec();
  if (spec.kind == SolidKind::elastic) return spec.elastic.pinned.empty();
  if (!(spec.kind == SolidKind::rigid)) return false;
  const auto any = [](const std::array<bool, 3>& axes) { return std::find(axes.begin(), axes.end(), true); };
  return any(spec.rigid.fixed_position) == spec.rigid.fixed_position.end();
}

// Turns the points so that the direction `down` becomes -y. 2D: about z.
template <int Dim>
void turn_upright(const Vec3& down, std::vector<Vec3>& points) {
  Eigen::Matrix3d turn;
  if (Dim == 2)
    turn = Eigen::AngleAxisd(std::atan2(-1.0, 0.0) - std::atan2(down.y(), down.x()), Vec3::UnitZ());
  else
    turn = Eigen::Quaterniond::FromTwoVectors(down, -Vec3::UnitY());
  for (Vec3& x : points) x = turn * x;
}

// Draught of a body at which the liquid below the surface, and gas above it, weigh as much as the body: bisection of
// the height of the surface, to 1e-9 of the body's height.
template <int Dim>
Floating equilibrium(SurfaceMesh mesh, const MassProperties& body, const Fluids& fluids, const Vec3& down) {
  constexpr int halvings = 30;
  turn_upright<Dim>(down, mesh.points);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.points) box.extend(x);
  const Vec3 margin = Vec3::Constant(box.sizes().maxCoeff());
  const double gas = fluids.gas_density(), volume = mass_of_surface<Dim>(mesh, 1).volume;
  const double density = body.mass / (body.volume > 0 ? body.volume : volume);
  const double needed = volume * (density - gas) / (fluids.density() - gas);  // below the surface, of the mesh
  if (needed >= volume) return {true, 0};
  double low = box.min().y(), high = box.max().y();
  for (int n = 0; n < halvings; ++n) {
    Vec3 top = box.max() + margin;
    top.y() = (low + high) / 2;
    (clipped_volume<Dim>(mesh, box.min() - margin, top) < needed ? low : high) = top.y();
  }
  return {false, std::max(0.0, (low + high) / 2 - box.min().y())};
}

}  // namespace

template <int Dim>
std::string rounded_place(const Vec3& x) {
  const Vec<Dim> v = truncate<Dim>(x);
  return fmt::format("({:.4g})", fmt::join(v.begin(), v.end(), ", "));
}

template <int Dim>
std::string volume_text(double volume) {
  return fmt::format("{:.5g} m^{}", volume, Dim);
}

template <int Dim>
std::vector<SolidAtStart> account_solids(const Solids<Dim>& solids, const DomainSpec& extent,
                                         std::vector<std::string>& warnings) {
  std::vector<SolidAtStart> all;
  constexpr std::size_t most_sampled = 20;  // each costs 100,000 values of a formula
  for (const Body<Dim>& body : solids.bodies)
    all.push_back(account_solid(extent, body, all.size() < most_sampled, warnings));
  return all;
}

template <int Dim>
std::string line_of(const SolidAtStart& solid) {
  std::string line = fmt::format("solid   '{}', {}", solid.name, solid.kind);
  if (solid.extent != SolidAtStart::Extent::body)
    return line + (solid.extent == SolidAtStart::Extent::hole ? ": all but a hole" : ": a half-space");
  line += fmt::format(": {}", volume_text<Dim>(solid.volume));
  if (solid.mass > 0)
    line +=
        fmt::format(", {:.5g} kg{}, centre of mass {}", solid.mass, a_metre<Dim>(), rounded_place<Dim>(solid.center));
  line += fmt::format(", from {} to {} m", rounded_place<Dim>(solid.lower), rounded_place<Dim>(solid.upper));
  if (solid.outside > 0) line += fmt::format("; {:.3g} % of it lies outside of the domain", 100 * solid.outside);
  return line;
}

template <int Dim>
std::vector<std::optional<Floating>> floating_of(const Solids<Dim>& solids, const Fluids& fluids) {
  std::vector<std::optional<Floating>> all(solids.bodies.size());
  const Vec3 gravity = fluids.gravity.at(0);
  if (!(gravity.norm() > 0) || fluids.has_prescribed_flow()) return all;
  std::vector<bool> jointed(all.size(), false);
  for (const Joint& joint : solids.joints.list)
    for (const int k : joint.solids)
      if (k >= 0) jointed[std::size_t(k)] = true;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Body<Dim>& body = solids.bodies[k];
    if (jointed[k] || !floats_freely(body) || !(body.mass().mass > 0)) continue;
    all[k] = equilibrium<Dim>(surface_at_start(body), body.mass(), fluids, gravity.normalized());
  }
  return all;
}

#define SEICHE_INSTANTIATE(Dim)                                                                 \
  template std::string rounded_place<Dim>(const Vec3&);                                         \
  template std::string volume_text<Dim>(double);                                                \
  template std::vector<SolidAtStart> account_solids<Dim>(const Solids<Dim>&, const DomainSpec&, \
                                                         std::vector<std::string>&);            \
  template std::string line_of<Dim>(const SolidAtStart&);                                       \
  template std::vector<std::optional<Floating>> floating_of<Dim>(const Solids<Dim>&, const Fluids&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)
#undef SEICHE_INSTANTIATE

}  // namespace seiche
