#include "coupling/geometry/seams.h"

#include "geometry/mesh/facets.h"
#include "grid/loops.h"
#include "solid/body/elastic_motion.h"

namespace seiche {
namespace {

template <int Dim>
bool moves_alike(const Body<Dim>& other, const MotionSpec& pins) {
  return !other.is_free() && !other.deforms() && same_motion(other.spec().motion, pins);
}

// One flag per surface point: set if `pins` hold it and, at t = 0, it lies in the other solid or within `clearance` (m)
// of it.
template <int Dim>
std::vector<char> joined_points(const ElasticSolid<Dim>& solid, const PinnedNodes& pins, const Body<Dim>& other,
                                double clearance) {
  std::vector<Eigen::Index> first(solid.body.mesh.nodes.size(), -1);  // first pinned displacement of each node
  const Pins at_start = pins_at(solid, 0);
  for (std::size_t n = 0; n < at_start.dofs.size(); n += Dim)
    first[std::size_t(at_start.dofs[n] / Dim)] = Eigen::Index(n);
  std::vector<char> joined;
  for (const int node : solid.surface.nodes) {
    joined.push_back(0);
    if (!std::binary_search(pins.nodes.begin(), pins.nodes.end(), node)) continue;
    Vec<Dim> x = solid.body.mesh.nodes[std::size_t(node)];
    for (int a = 0; a < Dim; ++a) x[a] += at_start.targets[std::size_t(first[std::size_t(node)] + a)];
    joined.back() = other.distance_in(other.pose(0), x) <= clearance;
  }
  return joined;
}

template <int Dim>
void mark_around(const Layout<Dim>& layout, const Eigen::AlignedBox<double, Dim>& box, NodeField<Dim, char>& marked) {
  Box<Dim> cells;
  for (int a = 0; a < Dim; ++a) {
    cells.lower[a] = int(std::floor((box.min()[a] - layout.geometry().lower[a]) / layout.h())) - 1;
    cells.upper[a] = int(std::floor((box.max()[a] - layout.geometry().lower[a]) / layout.h())) + 2;
  }
  for_each_site(layout, cells.cut(layout.padded()), [&](Site s) { marked[s] = 1; });
}

}  // namespace

template <int Dim>
std::vector<SeamFacet<Dim>> find_seams(const std::vector<Body<Dim>>& bodies, double clearance) {
  std::vector<SeamFacet<Dim>> seams;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies[k].deforms()) continue;
    const ElasticSolid<Dim>& solid = bodies[k].elastic();
    for (const PinnedNodes& pins : solid.pins)
      for (const Body<Dim>& other : bodies) {
        if (!moves_alike(other, pins.motion)) continue;
        const std::vector<char> joined = joined_points(solid, pins, other, clearance);
        for (const auto& facet : facets_of<Dim>(solid.surface.facets))
          if (std::all_of(facet.begin(), facet.end(), [&](int p) { return joined[std::size_t(p)]; }))
            seams.push_back({int(k), facet});
      }
  }
  return seams;
}

template <int Dim>
NodeField<Dim, char> mark_seams(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                const std::vector<SeamFacet<Dim>>& seams, const std::vector<Placement>& placed) {
  NodeField<Dim, char> marked;
  if (seams.empty()) return marked;
  marked = NodeField<Dim, char>(layout);
  for (const SeamFacet<Dim>& facet : seams) {
    const ElasticSolid<Dim>& solid = bodies[std::size_t(facet.body)].elastic();
    const Eigen::VectorXd& u = placed[std::size_t(facet.body)].displacement;
    Eigen::AlignedBox<double, Dim> box;
    for (const int p : facet.points) {
      const int node = solid.surface.nodes[std::size_t(p)];
      box.extend(solid.body.mesh.nodes[std::size_t(node)] + u.segment<Dim>(Dim * node));
    }
    mark_around(layout, box, marked);
  }
  return marked;
}

template <int Dim>
Eigen::AlignedBox<double, Dim> placed_box(const Body<Dim>& body, const Placement& placed) {
  Eigen::AlignedBox<double, Dim> box;
  if (body.deforms())
    for (const Vec<Dim>& x : surface_points(body.elastic(), placed.displacement)) box.extend(x);
  else
    for (const Vec3& x : body.contact_surface().points) box.extend(truncate<Dim>(placed.pose.apply(x)));
  return box;
}

template <int Dim>
NodeField<Dim, char> mark_shared(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                 const SharedPairs& pairs, const std::vector<Placement>& placed) {
  NodeField<Dim, char> marked;
  const auto box = [&](int k) { return placed_box(bodies[std::size_t(k)], placed[std::size_t(k)]); };
  for (const auto& [a, b] : pairs) {
    const Eigen::AlignedBox<double, Dim> both = box(a).intersection(box(b));
    if (both.isEmpty()) continue;
    if (marked.empty()) marked = NodeField<Dim, char>(layout);
    mark_around(layout, both, marked);
  }
  return marked;
}

#define SEICHE_INSTANTIATE(D)                                                              \
  template std::vector<SeamFacet<D>> find_seams<D>(const std::vector<Body<D>>&, double);   \
  template NodeField<D, char> mark_seams<D>(const Layout<D>&, const std::vector<Body<D>>&, \
                                            const std::vector<SeamFacet<D>>&, const std::vector<Placement>&);
template Eigen::AlignedBox<double, 2> placed_box<2>(const Body<2>&, const Placement&);
template Eigen::AlignedBox<double, 3> placed_box<3>(const Body<3>&, const Placement&);
template NodeField<2, char> mark_shared<2>(const Layout<2>&, const std::vector<Body<2>>&, const SharedPairs&,
                                           const std::vector<Placement>&);
template NodeField<3, char> mark_shared<3>(const Layout<3>&, const std::vector<Body<3>>&, const SharedPairs&,
                                           const std::vector<Placement>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
