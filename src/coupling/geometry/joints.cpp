#include "coupling/geometry/joints.h"

#include "geometry/mesh/facets.h"
#include "grid/loops.h"
#include "solid/body/elastic_motion.h"

namespace seiche {
namespace {

template <int Dim>
bool moves_alike(const Body<Dim>& other, const MotionSpec& pins) {
  return !other.is_free() && same_motion(other.spec().motion, pins);
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

}  // namespace

template <int Dim>
std::vector<JoinedFacet<Dim>> find_joints(const std::vector<Body<Dim>>& bodies, double clearance) {
  std::vector<JoinedFacet<Dim>> joints;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies[k].deforms()) continue;
    const ElasticSolid<Dim>& solid = bodies[k].elastic();
    for (const PinnedNodes& pins : solid.pins)
      for (const Body<Dim>& other : bodies) {
        if (!moves_alike(other, pins.motion)) continue;
        const std::vector<char> joined = joined_points(solid, pins, other, clearance);
        for (const auto& facet : facets_of<Dim>(solid.surface.facets))
          if (std::all_of(facet.begin(), facet.end(), [&](int p) { return joined[std::size_t(p)]; }))
            joints.push_back({int(k), facet});
      }
  }
  return joints;
}

template <int Dim>
NodeField<Dim, char> mark_joints(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                 const std::vector<JoinedFacet<Dim>>& joints, const std::vector<Placement>& placed) {
  NodeField<Dim, char> marked;
  if (joints.empty()) return marked;
  marked = NodeField<Dim, char>(layout);
  for (const JoinedFacet<Dim>& joint : joints) {
    const ElasticSolid<Dim>& solid = bodies[std::size_t(joint.body)].elastic();
    const Eigen::VectorXd& u = placed[std::size_t(joint.body)].displacement;
    Eigen::AlignedBox<double, Dim> box;
    for (const int p : joint.points) {
      const int node = solid.surface.nodes[std::size_t(p)];
      box.extend(solid.body.mesh.nodes[std::size_t(node)] + u.segment<Dim>(Dim * node));
    }
    Box<Dim> cells;
    for (int a = 0; a < Dim; ++a) {
      cells.lower[a] = int(std::floor((box.min()[a] - layout.geometry().lower[a]) / layout.h())) - 1;
      cells.upper[a] = int(std::floor((box.max()[a] - layout.geometry().lower[a]) / layout.h())) + 2;
    }
    for_each_site(layout, cells.cut(layout.padded()), [&](Site s) { marked[s] = 1; });
  }
  return marked;
}

#define SEICHE_INSTANTIATE(D)                                                               \
  template std::vector<JoinedFacet<D>> find_joints<D>(const std::vector<Body<D>>&, double); \
  template NodeField<D, char> mark_joints<D>(const Layout<D>&, const std::vector<Body<D>>&, \
                                             const std::vector<JoinedFacet<D>>&, const std::vector<Placement>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
