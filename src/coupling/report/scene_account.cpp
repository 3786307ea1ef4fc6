#include "coupling/report/scene_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "coupling/report/liquid_fall.h"
#include "coupling/report/solid_account.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/transport/transport.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "levelset/redistance.h"
#include "solid/body/mass_properties.h"

namespace seiche {
namespace {

constexpr std::size_t most_lines = 20;        // of solids, and of joints
constexpr std::size_t most_shapes = 20;       // of regions and sources looked at: each costs a loop over the whole grid
constexpr double nothing = 1e-6, all = 1e-3;  // tolerances as shares of a volume: for none, and for losses

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

// Name of a table of shapes in a scene, and what follows where it has no room.
struct ShapeUse {
  std::string name;  // liquid.region.2, say
  const char* lack;
  bool needs_centre;  // it has no effect without the centre of a cell
};

// Warns if none of a shape lies in the room for liquid, or if it holds no cell's centre but needs one. phi: its level
// set; whole: its volume within the domain. True if it warned.
template <int Dim>
bool warn_of_shape(const Domain<Dim>& domain, const ShapeSpec& spec, const ShapeUse& use, const CellField<Dim>& phi,
                   double whole, const NodeField<Dim>& psi, std::vector<std::string>& warnings) {
  const std::string start = fmt::format("{}: {} {}: ", spec.where, use.name, use.lack);
  const std::size_t before = warnings.size();
  if (whole <= nothing * domain.layout.geometry().cell_volume())
    warnings.push_back(start + "it lies outside of the domain or is far smaller than a cell");
  else if (use.needs_centre && !holds_centre(domain, phi))
    warnings.push_back(start + "it holds no cell's centre; make it wider, or the cells smaller");
  else if (liquid_volume(domain, phi, psi) < all * whole)
    warnings.push_back(start + fmt::format("all of its {} lies inside solids (a container is a solid with invert = "
                                           "true)",
                                           volume_text<Dim>(whole)));
  return warnings.size() > before;
}

// True if a shape goes on beyond a side of the domain, as looked up a quarter of a cell beyond the cells at it.
template <int Dim>
bool passes_sides(const Domain<Dim>& domain, const ShapeSpec& spec) {
  constexpr double beyond = 0.75;  // cells from the centre of a cell
  const auto shape = make_shape<Dim>(spec, {domain.layout.h(), nullptr});
  const Layout<Dim>& l = domain.layout;
  bool any = false;
  for_each_index_in_order(l, l.cells(), [&](Site, const IVec<Dim>& i) {
    for (int a = 0; a < Dim; ++a)
      for (const int way : {-1, 1}) {
        if (i[a] != (way < 0 ? 0 : l.geometry().cells[a] - 1)) continue;
        const Vec<Dim> x = l.position(i, cell_offset<Dim>()) + way * beyond * l.h() * Vec<Dim>::Unit(a);
        any = any || (*shape)(x) < 0;
      }
  });
  return domain.ranks.any(any);
}

// Line on a region that lies partly outside of the domain, or "". The grid knows its volume to some percent only, so
// that small parts are not told. whole: its volume within the domain. Collective.
template <int Dim>
std::string loss_of_region(const Domain<Dim>& domain, const ShapeSpec& spec, const std::string& name, double whole) {
  constexpr double notable = 0.05;
  constexpr std::array<std::string_view, 6> exact{"box", "sphere", "cylinder", "capsule", "polygon", "mesh"};
  if (spec.invert || std::find(exact.begin(), exact.end(), spec.kind) == exact.end()) return {};
  const auto& geometry = domain.layout.geometry();
  const Vec<Dim> size = geometry.cells.template cast<double>() * domain.layout.h();
  const double volume =
      mass_properties<Dim>(spec, 1, {domain.layout.h(), nullptr}, geometry.lower, geometry.lower + size).volume;
  if (whole > (1 - notable) * volume || !passes_sides(domain, spec)) return {};
  return fmt::format("{}: about {:.2g} % of its {} lies outside of the domain", name, 100 * (1 - whole / volume),
                     volume_text<Dim>(volume));
}

template <int Dim>
void account_regions(const Domain<Dim>& domain, const LiquidSpec& liquid, const NodeField<Dim>& psi,
                     SceneAccount& account) {
  for (std::size_t k = 0; k < std::min(most_shapes, liquid.regions.size()); ++k) {
    const ShapeSpec& spec = liquid.regions[k].shape;
    const CellField<Dim> phi = level_set_of(domain, spec);
    const double whole = liquid_volume(domain, phi, no_solids(domain));
    const ShapeUse use{fmt::format("liquid.region.{}", k), "holds no liquid", false};
    if (warn_of_shape(domain, spec, use, phi, whole, psi, account.warnings)) continue;
    if (std::string line = loss_of_region(domain, spec, use.name, whole); !line.empty())
      account.start.losses.push_back(std::move(line));
  }
}

// Volume that two level sets share, outside of solids. Collective.
template <int Dim>
double common_volume(const Domain<Dim>& domain, CellField<Dim> phi, const CellField<Dim>& other,
                     const NodeField<Dim>& psi) {
  for (Site c = 0; c < Site(domain.layout.size()); ++c) phi[c] = std::max(phi[c], other[c]);
  return liquid_volume(domain, phi, psi);
}

// A source keeps its shape full: within liquid it adds next to nothing. The time of its start is only known here if
// that is the scene's.
template <int Dim>
void account_sources(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                     const NodeField<Dim>& psi, SceneAccount& account) {
  constexpr double full = 0.99;  // share of the shape; corners of the surface are cut off within their cells
  const LiquidSpec& liquid = fluids.liquid;
  const bool needs_centre = state.liquid.empty() && !fluids.has_prescribed_flow();
  for (std::size_t k = 0; k < std::min(most_shapes, liquid.sources.size()); ++k) {
    const ShapeSpec& spec = liquid.sources[k].shape;
    const CellField<Dim> phi = level_set_of(domain, spec);
    const double whole = liquid_volume(domain, phi, no_solids(domain));
    const bool by_rate = liquid.sources[k].rate.has_value();
    const ShapeUse use{fmt::format("liquid.source.{}", k), "has no room at the start", needs_centre && !by_rate};
    if (warn_of_shape(domain, spec, use, phi, whole, psi, account.warnings) || by_rate) continue;
    if (liquid.sources[k].from > 0 ||
        common_volume(domain, phi, state.phi, psi) < full * liquid_volume(domain, phi, psi))
      continue;
    account.warnings.push_back(fmt::format(
        "{}: {} lies wholly inside the liquid at the start, where it adds next to nothing: a source keeps its shape "
        "full, and this one is full already; give it a rate, or place it above the surface",
        spec.where, use.name));
  }
}

template <int Dim>
void account_drains(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, const NodeField<Dim>& psi,
                    SceneAccount& account) {
  const LiquidSpec& liquid = fluids.liquid;
  const bool needs_centre = state.liquid.empty() && !fluids.has_prescribed_flow();
  for (std::size_t k = 0; k < std::min(most_shapes, liquid.drains.size()); ++k) {
    const ShapeSpec& spec = liquid.drains[k].shape;
    const CellField<Dim> phi = level_set_of(domain, spec);
    const ShapeUse use{fmt::format("liquid.drain.{}", k), "takes nothing", needs_centre && !liquid.drains[k].rate};
    warn_of_shape(domain, spec, use, phi, liquid_volume(domain, phi, no_solids(domain)), psi, account.warnings);
  }
}

template <int Dim>
void account_liquid(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const State<Dim>& state,
                    const StepGeometry<Dim>& geometry, SceneAccount& account) {
  const NodeField<Dim>& psi = geometry.psi;
  LiquidAtStart& liquid = account.start.liquid;
  const double whole = liquid_volume(domain, state.phi, no_solids(domain));
  liquid.volume = liquid_volume(domain, state.phi, psi);
  liquid.mass = liquid.volume * fluids.density();
  liquid.fall = fall_of_liquid(domain, fluids, solids, state, geometry);
  if (whole - liquid.volume > all * whole) liquid.in_solids = whole - liquid.volume;
  account_regions(domain, fluids.liquid, psi, account);
  account_sources(domain, fluids, state, psi, account);
  account_drains(domain, fluids, state, psi, account);
}

template <int Dim>
std::string line_of(const LiquidAtStart& liquid) {
  std::string line =
      fmt::format("liquid  {}, {:.5g} kg{}", volume_text<Dim>(liquid.volume), liquid.mass, Dim == 2 ? "/m" : "");
  if (liquid.in_solids > 0)
    line += fmt::format("; {} of its regions lies inside solids", volume_text<Dim>(liquid.in_solids));
  return line;
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

// Distance of a solid's farthest point from its centre of mass, m.
template <int Dim>
double extent_of(const Body<Dim>& body) {
  if (!body.deforms()) return body.radius();
  double largest = 0;
  for (const Vec<Dim>& x : body.elastic().body.mesh.nodes)
    largest = std::max(largest, (extend<Dim>(x) - body.mass().center).norm());
  return largest;
}

template <int Dim>
std::string line_of_joint(const JointSpec& spec) {
  const bool gear = spec.kind == JointKind::gear;
  return fmt::format("joint   '{}', {}: '{}' and '{}'{}{}", spec.name, name_of(spec.kind), spec.between[0],
                     spec.between[1], gear ? "" : fmt::format(", at {} m", rounded_place<Dim>(spec.at)),
                     forces_text(spec));
}

template <int Dim>
void warn_of_far_joint(const Solids<Dim>& solids, const Joint& joint, SceneAccount& account) {
  constexpr double far_off = 10;  // of the body's size
  const JointSpec& spec = joint.spec;
  if (spec.kind == JointKind::gear) return;
  double nearest = std::numeric_limits<double>::infinity();
  for (const int k : joint.solids) {
    if (k < 0) continue;  // the world
    const Body<Dim>& body = solids.bodies[std::size_t(k)];
    const double size = extent_of(body);
    if (size > 0) nearest = std::min(nearest, (spec.at - body.mass().center).norm() / size);
  }
  if (std::isfinite(nearest) && nearest > far_off)
    account.warnings.push_back(fmt::format("{}: joint '{}' is {:.0f} times the size of its solids away from them",
                                           spec.where, spec.name, nearest));
}

}  // namespace

template <int Dim>
SceneAccount account_scene(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                           const DomainSpec& extent, const State<Dim>& state, const StepGeometry<Dim>& geometry) {
  SceneAccount account;
  account_liquid(domain, fluids, solids, state, geometry, account);
  account.start.solids = account_solids(solids, extent, account.warnings);
  const std::vector<Joint>& joints = solids.joints.list;
  for (const Joint& joint : joints) warn_of_far_joint(solids, joint, account);
  for (std::size_t j = 0; j < std::min(joints.size(), most_lines); ++j)
    account.start.others.push_back(line_of_joint<Dim>(joints[j].spec));
  if (joints.size() > most_lines)
    account.start.others.push_back(fmt::format("        and {} more joints", joints.size() - most_lines));
  return account;
}

template <int Dim>
std::vector<std::string> lines_of(const StartAccount& start) {
  std::vector<std::string> lines{line_of<Dim>(start.liquid)};
  lines.insert(lines.end(), start.losses.begin(), start.losses.end());
  const std::size_t count = start.solids.size();
  for (std::size_t k = 0; k < std::min(count, most_lines); ++k) lines.push_back(line_of<Dim>(start.solids[k]));
  if (count > most_lines) lines.push_back(fmt::format("        and {} more solids", count - most_lines));
  lines.insert(lines.end(), start.others.begin(), start.others.end());
  return lines;
}

template SceneAccount account_scene<2>(const Domain<2>&, const Fluids&, const Solids<2>&, const DomainSpec&,
                                       const State<2>&, const StepGeometry<2>&);
template SceneAccount account_scene<3>(const Domain<3>&, const Fluids&, const Solids<3>&, const DomainSpec&,
                                       const State<3>&, const StepGeometry<3>&);
template std::vector<std::string> lines_of<2>(const StartAccount&);
template std::vector<std::string> lines_of<3>(const StartAccount&);

}  // namespace seiche
