#include "coupling/swept_volume.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "coupling/link_graph.h"
#include "grid/loops.h"
#include "solid/enclosed_volume.h"

namespace seiche {
namespace {

// One part of a body's surface while it is looked at.
struct Part {
  bool touches_open = false;  // liquid with a given pressure, or a free surface
  std::set<int> components;   // closed ones
  std::set<Link> links;       // of this rank
};

template <int Dim>
struct Parts {
  const Setup<Dim>& s;
  const PressureRows<Dim>& rows;
  const NullSpace& closed;
  const ElasticSolid<Dim>& solid;
  std::vector<int> part_of_node = {};
  std::vector<Part> parts = {};
  CellField<Dim, std::int64_t> component = {};  // of the rows' cells, -1: none or open; one cell around too

  void start() {
    component = CellField<Dim, std::int64_t>(s.layout, -1);
    for (std::size_t n = 0; n < rows.cells.size(); ++n) component[rows.cells[n]] = closed.component[n];
    set_component_of_air();
    s.halo.fill_ghosts({component.data()});
    part_of_node = parts_of_nodes(solid);
    parts.resize(std::size_t(solid.surface.parts));
  }

  void set_component_of_air() {
    std::vector<double> of_region(rows.air_row.size());
    for (std::size_t n = rows.liquid; n < rows.cells.size(); ++n)
      of_region[std::size_t(rows.region(rows.cells[n]))] = closed.component[n];
    if (of_region.empty()) return;
    s.ranks.global_sum(of_region);
    for_each_site(s.layout, s.layout.cells(), [&](Site c) {
      if (const std::int64_t k = rows.region(c); k >= 0) component[c] = std::int64_t(of_region[std::size_t(k)]);
    });
  }

  // Entries that were taken back do not count.
  void add_entries(const std::vector<FluxEntry>& entries) {
    std::map<std::pair<int, int>, std::pair<double, double>> sums;  // of values, and of their absolute values
    for (const FluxEntry& e : entries) {
      auto& [sum, size] = sums[{e.row, e.column}];
      sum += e.value, size += std::abs(e.value);
    }
    for (const FluxEntry& e : entries) {
      const auto& [sum, size] = sums[{e.row, e.column}];
      if (std::abs(sum) <= 1e-12 * size) continue;
      Part& part = parts[std::size_t(part_of_node[std::size_t(e.column / Dim)])];
      const int component = closed.component[std::size_t(e.row)];
      if (component < 0)
        part.touches_open = true;
      else
        part.components.insert(component);
      part.links.insert({rows.first + e.row, e.column / Dim});
    }
  }

  // The row of the part's liquid that is nearest to a point on it, of its cell and those around, not behind it; -1:
  // none.
  std::int64_t row_before(const Part& part, const Vec<Dim>& x, const Vec<Dim>& outward, const IVec<Dim>& cell) const {
    constexpr int neighbours = Dim == 2 ? 9 : 27;
    constexpr double deepest = 0.75;  // cells behind the surface that the centre of a cut cell may lie, or less
    std::int64_t best = -1;
    double least = 1e300;
    for (int n = 0; n < neighbours; ++n) {
      IVec<Dim> i = cell;
      for (int a = 0, left = n; a < Dim; ++a, left /= 3) i[a] += left % 3 - 1;
      const Vec<Dim> away = s.layout.position(i, cell_offset<Dim>()) - x;
      const Site c = s.layout.site(i);
      if (rows.row[c] < 0 || !part.components.contains(int(component[c]))) continue;
      if (away.dot(outward) < -deepest * s.layout.h() || away.norm() >= least) continue;
      best = rows.row[c], least = away.norm();
    }
    return best;
  }

  // Facets that no face share hangs on push liquid as well.
  void add_facet(const std::array<int, Dim>& corners, const std::vector<Vec<Dim>>& points) {
    Part& part = parts[std::size_t(solid.surface.part[std::size_t(corners[0])])];
    if (part.touches_open || is_held(corners)) return;
    Vec<Dim> x = Vec<Dim>::Zero();
    for (const int c : corners) x += points[std::size_t(c)] / Dim;
    IVec<Dim> cell;
    for (int a = 0; a < Dim; ++a) cell[a] = int(std::floor((x[a] - s.layout.geometry().lower[a]) / s.layout.h()));
    if (!s.layout.cells().contains(cell)) return;
    const std::int64_t row = row_before(part, x, outward_normal(corners, points), cell);
    if (row < 0) return;
    for (const int c : corners) part.links.insert({row, solid.surface.nodes[std::size_t(c)]});
  }

  bool is_held(const std::array<int, Dim>& corners) const {
    return std::all_of(corners.begin(), corners.end(), [&](int c) {
      const int node = solid.surface.nodes[std::size_t(c)];
      return std::any_of(solid.pins.begin(), solid.pins.end(), [&](const PinnedNodes& pin) {
        return std::binary_search(pin.nodes.begin(), pin.nodes.end(), node);
      });
    });
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

  void add_facets(const std::vector<Vec<Dim>>& points) {
    if constexpr (Dim == 2)
      for (const auto& f : solid.surface.facets.segments) add_facet(f, points);
    else
      for (const auto& f : solid.surface.facets.triangles) add_facet(f, points);
  }

  // What the ranks know of a part. Collective.
  void agree(Part& part) const {
    std::vector<double> facts(1 + std::size_t(closed.count));
    facts[0] = part.touches_open;
    for (const int c : part.components) facts[1 + std::size_t(c)] = 1;
    s.ranks.global_sum(facts);
    part.touches_open = facts[0] > 0;
    for (int c = 0; c < closed.count; ++c)
      if (facts[1 + std::size_t(c)] > 0) part.components.insert(c);
  }
};

std::vector<int> nodes_of_part(const ElasticSurface& surface, int part) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < surface.nodes.size(); ++n)
    if (surface.part[n] == part) nodes.push_back(surface.nodes[n]);
  return nodes;
}

// What the columns of J lack to add up to -(dV/du).
template <int Dim>
Eigen::VectorXd lacking(const SweptSurface<Dim>& surface, const std::vector<FluxEntry>& entries,
                        const Communicator& ranks) {
  std::vector<double> sums(std::size_t(surface.u.size()));
  for (const FluxEntry& e : entries) sums[std::size_t(e.column)] += e.value;
  ranks.global_sum(sums);
  return -surface.gradient / surface.face_area - Eigen::Map<const Eigen::VectorXd>(sums.data(), surface.u.size());
}

template <int Dim>
void correct_part(const Setup<Dim>& s, const PressureRows<Dim>& rows, const Part& part, SweptSurface<Dim>& surface,
                  std::vector<FluxEntry>& entries) {
  const Eigen::VectorXd all = lacking(surface, entries, s.ranks);
  LinkGraph graph(gather_links(part.links, s.ranks));
  graph.complete(nodes_of_part(surface.solid->surface, surface.part));
  const LeastFlux least(graph);
  const auto owned = [&](std::int64_t row) { return row >= rows.first && row < rows.first + Row(rows.cells.size()); };
  for (const auto& [row, number] : graph.row_numbers())
    if (owned(row)) surface.rows.push_back(int(row - rows.first));
  surface.row_count = graph.rows();
  for (int axis = 0; axis < Dim; ++axis) {
    Eigen::VectorXd wanted(graph.nodes());
    for (const auto& [node, number] : graph.node_numbers()) wanted[number] = all[Dim * node + axis];
    const std::vector<double> d = least.solve(wanted);
    for (std::size_t n = 0; n < d.size(); ++n) {
      const auto [row, node] = graph.links()[n];
      if (owned(row)) entries.push_back({int(row - rows.first), Dim * int(node) + axis, d[n]});
    }
  }
}

template <int Dim>
SweptSurface<Dim> make_surface(const Setup<Dim>& s, const ElasticMotion& motion, int k, int part, int first,
                               double horizon) {
  const ElasticSolid<Dim>& solid = s.bodies[k].elastic();
  const Eigen::VectorXd& u = motion.state.u;
  const Eigen::VectorXd middle = u + 0.5 * horizon * motion.velocity;
  const double kept = motion.kept_volume[part];
  return {&solid,
          k,
          part,
          first,
          u,
          enclosed_volume_gradient(solid, part, middle),
          horizon,
          std::isfinite(kept) ? kept : enclosed_volume(solid, part, u),
          s.layout.geometry().face_area(),
          {},
          0};
}

}  // namespace

// -(dV/du) w + flux = -(V(u + H w) - volume)/H
template <int Dim>
double SweptSurface<Dim>::missing_flux(const Eigen::VectorXd& w) const {
  const Eigen::VectorXd mine = w.segment(first, u.size());
  const double end = enclosed_volume(*solid, part, Eigen::VectorXd(u + horizon * mine));
  return (gradient.dot(mine) - (end - volume) / horizon) / (face_area * row_count);
}

template <int Dim>
std::vector<SweptSurface<Dim>> correct_swept_volume(const Setup<Dim>& s, const PressureRows<Dim>& rows,
                                                    const NullSpace& closed, const ElasticMotion& motion, int k,
                                                    int first, double horizon, std::vector<FluxEntry>& entries) {
  std::vector<SweptSurface<Dim>> surfaces;
  if (closed.count == 0) return surfaces;
  const ElasticSolid<Dim>& solid = s.bodies[k].elastic();
  Parts<Dim> all{s, rows, closed, solid};
  all.start();
  all.add_entries(entries);
  for (Part& part : all.parts) all.agree(part);
  all.add_facets(surface_points(solid, motion.state.u));
  for (int p = 0; p < solid.surface.parts; ++p) {
    const Part& part = all.parts[std::size_t(p)];
    if (part.touches_open || part.components.empty()) continue;
    if (enclosed_volume(solid, p, motion.state.u) >= 0) continue;  // no cavity
    surfaces.push_back(make_surface(s, motion, k, p, first, horizon));
    correct_part(s, rows, part, surfaces.back(), entries);
  }
  return surfaces;
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template struct SweptSurface<D>;                                                                                \
  template std::vector<SweptSurface<D>> correct_swept_volume<D>(const Setup<D>&, const PressureRows<D>&,          \
                                                                const NullSpace&, const ElasticMotion&, int, int, \
                                                                double, std::vector<FluxEntry>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
