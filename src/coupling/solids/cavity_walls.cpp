#include "coupling/solids/cavity_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "solid/elastic/surface_patches.h"

namespace seiche {
namespace {

template <int Dim>
using Components = CellField<Dim, std::int64_t>;

// Closed component of each cell with a row, enclosed air included; -1: no row, or an open component. Ghosts filled.
// Collective.
template <int Dim>
Components<Dim> components_of_cells(const Domain<Dim>& domain, const PressureRows<Dim>& rows, const NullSpace& closed) {
  Components<Dim> component(domain.layout, -1);
  for (std::size_t n = 0; n < rows.cells.size(); ++n) component[rows.cells[n]] = closed.component[n];
  std::vector<double> of_region(rows.air_row.size());
  for (std::size_t n = rows.liquid; n < rows.cells.size(); ++n)
    of_region[std::size_t(rows.region(rows.cells[n]))] = closed.component[n];
  if (!of_region.empty()) {
    domain.ranks.global_sum(of_region);
    for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
      if (const std::int64_t k = rows.region(c); k >= 0) component[c] = std::int64_t(of_region[std::size_t(k)]);
    });
  }
  domain.halo.fill_ghosts({component.data()});
  return component;
}

// Liquid that a patch touches.
struct Touched {
  bool open = false;         // liquid with a given pressure or a free surface
  std::set<int> components;  // closed components
  std::set<Link> links;      // found on this rank
  double link_count = 0;     // of face shares, over all ranks; links found on two ranks count twice
};

// Finds the liquid that the patches of one elastic body touch.
template <int Dim>
struct TouchedBody {
  const Domain<Dim>& domain;
  const PressureRows<Dim>& rows;
  const NullSpace& closed;
  const Components<Dim>& component;
  const ElasticSolid<Dim>& solid;
  std::vector<int> patch_of_node = {};
  std::vector<char> held = {};  // pinned, one a node of the mesh
  std::vector<Touched> patches = {};

  void start() {
    patch_of_node = patches_of_nodes(solid);
    held.resize(patch_of_node.size());
    for (const PinnedNodes& pin : solid.pins)
      for (const int n : pin.nodes) held[std::size_t(n)] = 1;
    patches.resize(solid.patches.size());
  }

  // Open patches leave out pinned nodes, whose flux is prescribed and whose facets may face other liquid. The
  // constraint of a closed patch includes all its nodes.
  bool leaves_out(int patch, int node) const {
    return held[std::size_t(node)] && !solid.patches[std::size_t(patch)].is_closed();
  }
  void link(int patch, std::int64_t row, int node) {
    if (!leaves_out(patch, node)) patches[std::size_t(patch)].links.insert({row, node});
  }

  // Skips entries that cancel: some are taken back by a later entry.
  void add_entries(const std::vector<FluxEntry>& entries) {
    std::map<std::pair<int, int>, std::pair<double, double>> sums;  // sum, and sum of absolute values
    for (const FluxEntry& e : entries) {
      auto& [sum, size] = sums[{e.row, e.column}];
      sum += e.value, size += std::abs(e.value);
    }
    for (const FluxEntry& e : entries) {
      const auto& [sum, size] = sums[{e.row, e.column}];
      const int patch = patch_of_node[std::size_t(e.column / Dim)];
      if (patch < 0 || leaves_out(patch, e.column / Dim) || std::abs(sum) <= 1e-12 * size) continue;
      const int component = closed.component[std::size_t(e.row)];
      if (component < 0)
        patches[std::size_t(patch)].open = true;
      else
        patches[std::size_t(patch)].components.insert(component);
      link(patch, rows.first + e.row, e.column / Dim);
    }
  }

  // Row of the patch's liquid nearest to the point x of the patch: of x's cell and its neighbours, not behind the
  // patch. -1: none.
  std::int64_t row_before(const Touched& patch, const Vec<Dim>& x, const Vec<Dim>& outward,
                          const IVec<Dim>& cell) const {
    constexpr int neighbours = Dim == 2 ? 9 : 27;
    constexpr double deepest = 0.75;  // cells: the centre of a cut cell may lie up to this far behind the surface
    std::int64_t best = -1;
    double least = 1e300;
    for (int n = 0; n < neighbours; ++n) {
      IVec<Dim> i = cell;
      for (int a = 0, left = n; a < Dim; ++a, left /= 3) i[a] += left % 3 - 1;
      const Vec<Dim> away = domain.layout.position(i, cell_offset<Dim>()) - x;
      const Site c = domain.layout.site(i);
      if (rows.row[c] < 0 || !patch.components.contains(int(component[c]))) continue;
      if (away.dot(outward) < -deepest * domain.layout.h() || away.norm() >= least) continue;
      best = rows.row[c], least = away.norm();
    }
    return best;
  }

  // Links the nodes of a facet to the liquid in front of it. Facets without attached face shares displace liquid, too.
  void add_facet(int patch, const std::array<int, Dim>& corners, const std::vector<Vec<Dim>>& points) {
    const auto node = [&](int p) { return solid.surface.nodes[std::size_t(p)]; };
    const Touched& touched = patches[std::size_t(patch)];
    if (touched.open || std::all_of(corners.begin(), corners.end(), [&](int p) { return held[std::size_t(node(p))]; }))
      return;
    Vec<Dim> x = Vec<Dim>::Zero();
    for (const int c : corners) x += points[std::size_t(c)] / Dim;
    IVec<Dim> cell;
    for (int a = 0; a < Dim; ++a)
      cell[a] = int(std::floor((x[a] - domain.layout.geometry().lower[a]) / domain.layout.h()));
    if (!domain.layout.cells().contains(cell)) return;
    const std::int64_t row = row_before(touched, x, outward_normal(corners, points), cell);
    if (row < 0) return;
    for (const int c : corners) link(patch, row, node(c));
  }

  static Vec<Dim> outward_normal(const std::array<int, Dim>& c, const std::vector<Vec<Dim>>& points) {
    const auto p = [&](int i) { return points[std::size_t(c[std::size_t(i)])]; };
    if constexpr (Dim == 2) {
      const Vec<2> along = p(1) - p(0);
      return Vec<2>(along[1], -along[0]).normalized();
    } else {
      return Vec3((p(1) - p(0)).cross(p(2) - p(0))).normalized();
    }
  }

  // Combines the findings of all ranks on a patch. Collective.
  void agree(Touched& patch) const {
    std::vector<double> facts(2 + std::size_t(closed.count));
    facts[0] = patch.open;
    facts[1] = double(patch.links.size());
    for (const int c : patch.components) facts[2 + std::size_t(c)] = 1;
    domain.ranks.global_sum(facts);
    patch.open = facts[0] > 0;
    patch.link_count = facts[1];
    for (int c = 0; c < closed.count; ++c)
      if (facts[2 + std::size_t(c)] > 0) patch.components.insert(c);
  }

  void look(const std::vector<FluxEntry>& entries, const Eigen::VectorXd& u) {
    start();
    add_entries(entries);
    for (Touched& patch : patches) agree(patch);
    const std::vector<Vec<Dim>> points = surface_points(solid, u);
    for (std::size_t p = 0; p < patches.size(); ++p)
      for (const auto& facet : solid.patches[p].facets) add_facet(int(p), facet, points);
  }
};

// True if the prescribed body k has a net flux into liquid of these components. Collective.
template <int Dim>
bool feeds(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const Components<Dim>& component,
           const std::set<int>& components, std::size_t k) {
  constexpr double rounding = 1e-9;
  std::array<double, 2> sums{};  // net flux, and sum of absolute values
  const auto add = [&](Site cell, const IVec<Dim>& i, double flux) {
    if (!domain.layout.cells().contains(i) || !components.contains(int(component[cell]))) return;
    sums[0] += flux, sums[1] += std::abs(flux);
  };
  for (const FaceShare& share : *g.shares[k]) {
    const IVec<Dim> i = domain.layout.index(share.face);
    IVec<Dim> low = i;
    low[share.axis] -= 1;
    const Vec3 x = extend<Dim>(domain.layout.position(i, face_offset<Dim>(share.axis)));
    const double flux = share.closed * g.placed[k].twist.at(x)[share.axis];
    add(share.face, i, -flux);
    add(share.face - domain.layout.stride(share.axis), low, flux);
  }
  domain.ranks.global_sum(sums);
  return std::abs(sums[0]) > rounding * sums[1];
}

template <int Dim>
bool ends_at(const CavityWalls<Dim>& walls, const MotionSpec& motion) {
  for (const WallPatch<Dim>& wall : walls)
    for (const auto& closing : wall.solid->patches[std::size_t(wall.patch)].closings)
      if (same_motion(wall.solid->pins[std::size_t(closing.pin)].motion, motion)) return true;
  return false;
}

// True if the cavity holds enclosed air, or if anything but its walls changes its volume of liquid. Collective.
template <int Dim>
bool is_fed(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
            const PressureRows<Dim>& rows, const Components<Dim>& component, const FoundCavity<Dim>& cavity) {
  bool fed = false;
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    if (!cavity.components.contains(int(component[c]))) return;
    fed = fed || rows.region(c) >= 0;
    for (int a = 0; a < Dim; ++a)
      for (const Site f : {c, c + domain.layout.stride(a)})
        fed = fed || (g.faces.kind_at(a, f) == FaceKind::prescribed && g.faces.prescribed.at(a, f) != 0);
  });
  fed = domain.ranks.any(fed);
  for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
    const Body<Dim>& body = solids.bodies[k];
    if (!body.is_prescribed()) continue;
    const bool leads_walls = !body.deforms() && ends_at(cavity.walls, body.spec().motion);
    fed = fed || (!leads_walls && feeds(domain, g, component, cavity.components, k));
  }
  return fed;
}

bool shares(const std::set<int>& a, const std::set<int>& b) {
  return std::any_of(a.begin(), a.end(), [&](int c) { return b.contains(c); });
}

// Adds `found` to the list, merged with the cavities that share liquid with it.
template <int Dim>
void join(FoundCavity<Dim> found, std::vector<FoundCavity<Dim>>& list) {
  for (std::size_t n = 0; n < list.size();) {
    FoundCavity<Dim>& other = list[n];
    if (!shares(other.components, found.components)) {
      ++n;
      continue;
    }
    other.walls.insert(other.walls.end(), found.walls.begin(), found.walls.end());
    other.links.insert(other.links.end(), found.links.begin(), found.links.end());
    other.components.insert(found.components.begin(), found.components.end());
    found = std::move(other);
    list.erase(list.begin() + std::ptrdiff_t(n));
  }
  list.push_back(std::move(found));
}

// Patch of a body that touches closed and open liquid. It changes the volume of the closed one by some of its motion.
struct HalfOpenPatch {
  int body;
  std::set<int> components;
};

template <int Dim>
bool is_moved_by(const FoundCavity<Dim>& cavity, const HalfOpenPatch& patch) {
  return shares(cavity.components, patch.components) &&
         std::none_of(cavity.walls.begin(), cavity.walls.end(), [&](const auto& w) { return w.body == patch.body; });
}

// True if a closed wall has pinned nodes, whose flux is prescribed.
template <int Dim>
bool has_pinned_closed_wall(const CavityWalls<Dim>& walls) {
  return std::any_of(walls.begin(), walls.end(), [](const WallPatch<Dim>& wall) {
    if (!is_closed(wall)) return false;
    const std::vector<int> patch = patches_of_nodes(*wall.solid);
    for (const PinnedNodes& pin : wall.solid->pins)
      if (std::any_of(pin.nodes.begin(), pin.nodes.end(), [&](int n) { return patch[std::size_t(n)] == wall.patch; }))
        return true;
    return false;
  });
}

// True if one of the closed walls lies around the liquid.
template <int Dim>
bool has_vessel(const CavityWalls<Dim>& walls, const ElasticMotions& motions) {
  return std::any_of(walls.begin(), walls.end(), [&](const WallPatch<Dim>& wall) {
    return is_closed(wall) && is_vessel(wall, motions[std::size_t(wall.body)]->state.u);
  });
}

// True if J w = -(dV/du) w/A_f but for this share, for all w that are linear in the place. Columns of single nodes
// differ more: shape functions of second order weigh a facet's middle otherwise than V does. Collective.
template <int Dim>
bool is_wet_all_over(const Domain<Dim>& domain, const WallPatch<Dim>& wall, const Eigen::VectorXd& u,
                     const std::vector<FluxEntry>& entries) {
  constexpr double share = 0.005;
  const std::vector<Vec<Dim>>& rest = wall.solid->body.mesh.nodes;
  const Eigen::VectorXd gradient = enclosed_volume_gradient<Dim>({wall}, 0, u);
  const Eigen::VectorXd lack = lacking_flux(gradient, domain.layout.geometry().face_area(), entries, domain.ranks);
  const std::vector<int> patch = patches_of_nodes(*wall.solid);
  const int first = wall.solid->surface.nodes[std::size_t(wall.solid->patches[std::size_t(wall.patch)].facets[0][0])];
  Eigen::Matrix<double, Dim, Dim + 1> sums = Eigen::Matrix<double, Dim, Dim + 1>::Zero();
  double area = 0, size = 0;
  for (const int n : wall.solid->surface.nodes) {
    if (patch[std::size_t(n)] != wall.patch) continue;
    const Vec<Dim> arm = rest[std::size_t(n)] - rest[std::size_t(first)];
    sums.col(0) += lack.segment<Dim>(Dim * n);
    sums.template rightCols<Dim>() += lack.segment<Dim>(Dim * n) * arm.transpose();
    area += gradient.segment<Dim>(Dim * n).norm();
    size = std::max(size, arm.norm());
  }
  sums.template rightCols<Dim>() /= size;
  return sums.cwiseAbs().maxCoeff() * domain.layout.geometry().face_area() <= share * area;
}

// True if liquid lies around all walls. Bodies that stand on a side, that touch others or that are thin do not show all
// of their surface. Collective.
template <int Dim>
bool are_wet_all_over(const Domain<Dim>& domain, const Solids<Dim>& solids, const CavityWalls<Dim>& walls,
                      const ElasticMotions& motions, const std::vector<BodyEntries>& bodies) {
  bool wet = true;
  for (const WallPatch<Dim>& wall : walls)
    for (const BodyEntries& b : bodies)
      if (b.body == wall.body && wet)
        wet = !solids.bodies[std::size_t(b.body)].is_thin() &&
              is_wet_all_over(domain, wall, motions[std::size_t(b.body)]->state.u, b.entries);
  return wet;
}

}  // namespace

template <int Dim>
std::vector<FoundCavity<Dim>> find_cavities(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                            const StepGeometry<Dim>& g, const PressureRows<Dim>& rows,
                                            const NullSpace& closed, const ElasticMotions& motions,
                                            const std::vector<BodyEntries>& bodies) {
  std::vector<FoundCavity<Dim>> joined;
  std::vector<HalfOpenPatch> half_open;
  if (closed.count == 0 || bodies.empty()) return joined;
  const Components<Dim> component = components_of_cells(domain, rows, closed);
  for (const BodyEntries& b : bodies) {
    if (!motions[std::size_t(b.body)]) continue;  // it follows meshes
    const ElasticSolid<Dim>& solid = solids.bodies[std::size_t(b.body)].elastic();
    TouchedBody<Dim> body{domain, rows, closed, component, solid};
    body.look(b.entries, motions[std::size_t(b.body)]->state.u);
    for (std::size_t p = 0; p < body.patches.size(); ++p) {
      Touched& patch = body.patches[p];
      if (patch.components.empty() || patch.link_count == 0) continue;
      if (patch.open)
        half_open.push_back({b.body, patch.components});
      else
        join({{{&solid, b.body, int(p)}}, {std::move(patch.links)}, patch.components}, joined);
    }
  }
  for (FoundCavity<Dim>& found : joined)
    found.surrounds = !has_open_wall(found.walls) && !has_vessel(found.walls, motions);
  std::erase_if(joined, [&](const FoundCavity<Dim>& found) {
    if (std::any_of(half_open.begin(), half_open.end(), [&](const auto& p) { return is_moved_by(found, p); }))
      return true;
    const bool open = has_open_wall(found.walls);
    if (!open && !found.surrounds) return false;
    if (open ? has_pinned_closed_wall(found.walls) || !can_be_closed(found.walls)
             : !are_wet_all_over(domain, solids, found.walls, motions, bodies))
      return true;
    return is_fed(domain, solids, g, rows, component, found);
  });
  return joined;
}

#define SEICHE_INSTANTIATE(D)                                                                                       \
  template std::vector<FoundCavity<D>> find_cavities<D>(const Domain<D>&, const Solids<D>&, const StepGeometry<D>&, \
                                                        const PressureRows<D>&, const NullSpace&,                   \
                                                        const ElasticMotions&, const std::vector<BodyEntries>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
