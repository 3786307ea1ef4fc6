#include "coupling/report/scene_account.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "base/domain_spec.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/transport/transport.h"
#include "fluid/boundary/domain.h"
#include "geometry/mesh/clipped_volume.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

constexpr std::size_t most_lines = 20;        // of solids, and of joints
constexpr double nothing = 1e-6, all = 1e-3;  // tolerances as shares of a volume: for none, and for losses

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
NodeField<Dim> no_solids(const Domain<Dim>& domain) {
  return NodeField<Dim>(domain.layout, 1e30);
}

// The level set of one region, clamped to the band.
template <int Dim>
CellField<Dim> level_set_of(const Domain<Dim>& domain, const ShapeSpec& spec) {
  const auto shape = make_shape<Dim>(spec, {domain.layout.h(), nullptr});
  CellField<Dim> phi(domain.layout, domain.band());
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    phi[c] = std::clamp((*shape)(domain.layout.position(i, cell_offset<Dim>())), -domain.band(), domain.band());
  });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  return phi;
}

// True if phi is negative at the centre of a cell. Collective.
template <int Dim>
bool holds_centre(const Domain<Dim>& domain, const CellField<Dim>& phi) {
  const auto depth = [&](Site c) { return -phi[c]; };
  return domain.ranks.global_max(local_max(domain.layout, domain.layout.cells(), 0.0, depth)) > 0;
}

// Warns if none of a shape lies in the room for liquid, or if it holds no cell's centre but needs one. `name`:
// liquid.region.2, say; `lack`: what follows from it.
template <int Dim>
void account_shape(const Domain<Dim>& domain, const ShapeSpec& spec, const std::string& name, const char* lack,
                   bool needs_centre, const NodeField<Dim>& psi, SceneAccount& account) {
  const CellField<Dim> phi = level_set_of(domain, spec);
  const double whole = liquid_volume(domain, phi, no_solids(domain)), wet = liquid_volume(domain, phi, psi);
  if (whole <= nothing * domain.layout.geometry().cell_volume())
    account.warnings.push_back(
        fmt::format("{}: {} {}: it lies outside of the domain or is far smaller than a cell", spec.where, name, lack));
  else if (needs_centre && !holds_centre(domain, phi))
    account.warnings.push_back(fmt::format("{}: {} {}: it holds no cell's centre; make it wider, or the cells smaller",
                                           spec.where, name, lack));
  else if (wet < all * whole)
    account.warnings.push_back(
        fmt::format("{}: {} {}: all of its {} lies inside solids (a container is a solid with invert = true)",
                    spec.where, name, lack, volume_text<Dim>(whole)));
}

template <int Dim>
void account_liquid(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, const NodeField<Dim>& psi,
                    SceneAccount& account) {
  const double wet = liquid_volume(domain, state.phi, psi), whole = liquid_volume(domain, state.phi, no_solids(domain));
  std::string line =
      fmt::format("liquid  {}, {:.5g} kg{}", volume_text<Dim>(wet), wet * fluids.density(), Dim == 2 ? "/m" : "");
  if (whole - wet > all * whole)
    line += fmt::format("; {} of its regions lies inside solids", volume_text<Dim>(whole - wet));
  account.lines.push_back(line);
  constexpr std::size_t most = 20;  // each costs a loop over the whole grid
  const LiquidSpec& liquid = fluids.liquid;
  const bool needs_centre = liquid.volume != VolumeKeeping::in_cells && !fluids.has_prescribed_flow();
  for (std::size_t k = 0; k < std::min(most, liquid.regions.size()); ++k)
    account_shape(domain, liquid.regions[k].shape, fmt::format("liquid.region.{}", k), "holds no liquid", false, psi,
                  account);
  for (std::size_t k = 0; k < std::min(most, liquid.sources.size()); ++k)
    account_shape(domain, liquid.sources[k].shape, fmt::format("liquid.source.{}", k), "has no room at the start",
                  needs_centre && !liquid.sources[k].rate, psi, account);
  for (std::size_t k = 0; k < std::min(most, liquid.drains.size()); ++k)
    account_shape(domain, liquid.drains[k].shape, fmt::format("liquid.drain.{}", k), "takes nothing",
                  needs_centre && !liquid.drains[k].rate, psi, account);
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
void warn_of_missed_parts(const DomainSpec& extent, const Body<Dim>& body, double found, SceneAccount& account) {
  constexpr double notable = 0.2;  // the contour of a disc of one cell's radius is 10 % too small
  if (body.spec().shape.kind != "expression" || body.deforms()) return;
  const double there = sampled_volume(extent, body);
  if (found > (1 - notable) * there) return;
  account.warnings.push_back(fmt::format(
      "{}: solid '{}' has parts thinner than a cell of {:g} m, which its formula hides from the grid: it finds {} "
      "of {}, and liquid passes through the rest; take smaller cells, or a shape that has distances (box, capsule, "
      "mesh)",
      body.spec().shape.where, body.spec().name, extent.cell_size, volume_text<Dim>(found), volume_text<Dim>(there)));
}

template <int Dim>
void account_solid(const DomainSpec& extent, const Body<Dim>& body, SceneAccount& account) {
  const SolidSpec& spec = body.spec();
  const std::string name = fmt::format("solid   '{}', {}", spec.name, spec.kind.name);
  if (spec.shape.invert || spec.shape.kind == "plane" || spec.shape.kind == "height_map") {
    account.lines.push_back(name + (spec.shape.invert ? ": all but a hole" : ": a half-space"));
    return;
  }
  const SurfaceMesh mesh = surface_at_start(body);
  const double within = clipped_volume<Dim>(mesh, extent.lower, extent.upper);
  warn_of_missed_parts(extent, body, within, account);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.points) box.extend(x);
  if (box.isEmpty()) return;
  const double volume = mass_of_surface<Dim>(mesh, 1).volume;
  const double share = volume > 0 ? within / volume : 1;
  std::string line = fmt::format("{}: {}", name, volume_text<Dim>(volume));
  if (body.is_free())
    line += fmt::format(", {:.5g} kg{}, centre of mass {}", body.mass().mass, Dim == 2 ? "/m" : "",
                        rounded_place<Dim>(body.mass().center));
  line += fmt::format(", from {} to {} m", rounded_place<Dim>(box.min()), rounded_place<Dim>(box.max()));
  if (share < 1 - all) line += fmt::format("; {:.3g} % of it lies outside of the domain", 100 * (1 - share));
  account.lines.push_back(line);
  if (share < nothing && !spec.kind.is_prescribed())
    account.warnings.push_back(fmt::format("{}: solid '{}' lies outside of the domain, from {} to {} m",
                                           spec.shape.where, spec.name, rounded_place<Dim>(box.min()),
                                           rounded_place<Dim>(box.max())));
}

// Names what acts along the joint's coordinate, for its line.
std::string forces_text(const JointSpec& spec) {
  const std::vector<std::pair<const char*, bool>> all{
      {"limits", spec.limits.has_value()}, {"spring", spec.spring.has_value()}, {"motor", spec.motor.has_value()},
      {"drive", spec.drive.has_value()},   {"friction", spec.friction > 0},     {"breaks", spec.breaks_at.has_value()}};
  std::string text;
  for (const auto& [name, given] : all)
    if (given) text += std::string(", ") + name;
  return text;
}

template <int Dim>
void account_joint(const Solids<Dim>& solids, const Joint& joint, SceneAccount& account) {
  constexpr double far_off = 10;  // of the body's size
  const JointSpec& spec = joint.spec;
  const bool gear = spec.kind == JointKind::gear;
  account.lines.push_back(fmt::format(
      "joint   '{}', {}: '{}' and '{}'{}{}", spec.name, name_of(spec.kind), spec.between[0], spec.between[1],
      gear ? "" : fmt::format(", at {} m", rounded_place<Dim>(spec.at)), forces_text(spec)));
  if (gear) return;
  double nearest = std::numeric_limits<double>::infinity();
  for (const int k : joint.solids) {
    if (k < 0) continue;  // the world
    const Body<Dim>& body = solids.bodies[std::size_t(k)];
    if (body.radius() > 0) nearest = std::min(nearest, (spec.at - body.mass().center).norm() / body.radius());
  }
  if (std::isfinite(nearest) && nearest > far_off)
    account.warnings.push_back(fmt::format("{}: joint '{}' is {:.0f} times the size of its solids away from them",
                                           spec.where, spec.name, nearest));
}

}  // namespace

template <int Dim>
SceneAccount account_scene(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                           const DomainSpec& extent, const State<Dim>& state, const NodeField<Dim>& psi) {
  SceneAccount account;
  account_liquid(domain, fluids, state, psi, account);
  const std::size_t count = solids.bodies.size();
  for (std::size_t k = 0; k < std::min(count, most_lines); ++k) account_solid(extent, solids.bodies[k], account);
  if (count > most_lines) account.lines.push_back(fmt::format("        and {} more solids", count - most_lines));
  const std::vector<Joint>& joints = solids.joints.list;
  for (std::size_t j = 0; j < std::min(joints.size(), most_lines); ++j) account_joint(solids, joints[j], account);
  if (joints.size() > most_lines)
    account.lines.push_back(fmt::format("        and {} more joints", joints.size() - most_lines));
  return account;
}

template SceneAccount account_scene<2>(const Domain<2>&, const Fluids&, const Solids<2>&, const DomainSpec&,
                                       const State<2>&, const NodeField<2>&);
template SceneAccount account_scene<3>(const Domain<3>&, const Fluids&, const Solids<3>&, const DomainSpec&,
                                       const State<3>&, const NodeField<3>&);

}  // namespace seiche
