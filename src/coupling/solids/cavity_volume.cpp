#include "coupling/solids/cavity_volume.h"

#include <algorithm>

#include "coupling/solids/cavity_walls.h"
#include "coupling/state/setup.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "solid/elastic/surface_patches.h"

namespace seiche {
namespace {

// Nodes of a wall that the constraint applies to: all of a closed patch, the free ones of an open patch.
template <int Dim>
std::vector<int> nodes_of_wall(const WallPatch<Dim>& wall) {
  const std::vector<int> patch = patches_of_nodes(*wall.solid);
  std::vector<char> left_out(patch.size());
  for (const PinnedNodes& pin : wall.solid->pins)
    for (const int n : pin.nodes) left_out[std::size_t(n)] = !wall.solid->patches[std::size_t(wall.patch)].is_closed();
  std::vector<int> nodes;
  for (const int n : wall.solid->surface.nodes)
    if (patch[std::size_t(n)] == wall.patch && !left_out[std::size_t(n)]) nodes.push_back(n);
  return nodes;
}

template <int Dim>
LinkGraph graph_of_wall(const WallPatch<Dim>& wall, const std::set<Link>& links, const Communicator& ranks) {
  LinkGraph graph(gather_links(links, ranks));
  graph.complete(nodes_of_wall(wall));
  return graph;
}

// Corrects the entries of wall n. Collective.
template <int Dim>
void correct_wall(const Domain<Dim>& domain, const PressureRows<Dim>& rows, const LinkGraph& graph,
                  const CavityConstraint<Dim>& cavity, std::size_t n, std::vector<FluxEntry>& entries) {
  const Eigen::VectorXd all = lacking_flux(cavity.gradient[n], cavity.face_area, entries, domain.ranks);
  const MinimumNormFlux least(graph);
  for (int axis = 0; axis < Dim; ++axis) {
    Eigen::VectorXd wanted(graph.nodes());
    for (const auto& [node, number] : graph.node_numbers()) wanted[number] = all[Dim * node + axis];
    const std::vector<double> d = least.solve(wanted);
    for (std::size_t i = 0; i < d.size(); ++i) {
      const auto [row, node] = graph.links()[i];
      if (rows.owns(row)) entries.push_back({int(row - rows.first), Dim * int(node) + axis, d[i]});
    }
  }
}

// -A_f times the sums of the columns of J of the wall's nodes. Collective.
template <int Dim>
Eigen::VectorXd swept_gradient(const Domain<Dim>& domain, const WallPatch<Dim>& wall,
                               const std::vector<FluxEntry>& entries) {
  const double face_area = domain.layout.geometry().face_area();
  const Eigen::VectorXd all =
      lacking_flux(Eigen::VectorXd::Zero(wall.solid->body.size()), face_area, entries, domain.ranks);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(all.size());
  for (const int n : nodes_of_wall(wall)) gradient.segment<Dim>(Dim * n) = face_area * all.segment<Dim>(Dim * n);
  return gradient;
}

// This rank's part of the rows, with shares in proportion to the open parts of their cells' faces. Collective.
template <int Dim>
std::vector<TouchedRow> rows_by_openness(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces,
                                         const PressureRows<Dim>& rows, const std::set<std::int64_t>& touched) {
  std::vector<TouchedRow> mine;
  std::array<double, 1> sum{};
  for (const std::int64_t row : touched) {
    if (!rows.owns(row)) continue;
    const int n = int(row - rows.first);
    double open = 0;
    for_each_face_of(domain.layout, rows.cells[std::size_t(n)],
                     [&](int a, Site f, int, Site) { open += faces.is_unknown(a, f) ? faces.open.at(a, f) : 0; });
    mine.push_back({n, open});
    sum[0] += open;
  }
  domain.ranks.global_sum(sum);
  for (TouchedRow& r : mine) r.share /= sum[0];
  return mine;
}

// Volume that the walls keep: that of the earlier cavity with the same walls, else the volume they enclose now.
template <int Dim>
double volume_to_keep(const CavityWalls<Dim>& walls, const ElasticMotions& motions,
                      const std::vector<CavityWalls<Dim>>& kept, const std::vector<Eigen::VectorXd>& u) {
  const auto same = [](const WallPatch<Dim>& a, const WallPatch<Dim>& b) {
    return a.body == b.body && a.patch == b.patch;
  };
  for (const CavityWalls<Dim>& before : kept)
    if (std::is_permutation(walls.begin(), walls.end(), before.begin(), before.end(), same))
      return motions[std::size_t(walls[0].body)]->kept_volume[walls[0].patch];
  return enclosed_volume(walls, u);
}

template <int Dim>
CavityConstraint<Dim> make_cavity(const Domain<Dim>& domain, const FoundCavity<Dim>& found,
                                  const ElasticMotions& motions, const std::vector<BodyEntries>& bodies,
                                  double horizon) {
  CavityConstraint<Dim> cavity;
  cavity.walls = found.walls;
  cavity.horizon = horizon;
  cavity.face_area = domain.layout.geometry().face_area();
  for (std::size_t n = 0; n < found.walls.size(); ++n) {
    const ElasticMotion& motion = *motions[std::size_t(found.walls[n].body)];
    cavity.u.push_back(motion.state.u);
    const Eigen::VectorXd middle = motion.state.u + 0.5 * horizon * motion.velocity;
    for (const BodyEntries& b : bodies) {
      if (b.body != found.walls[n].body) continue;
      cavity.first.push_back(b.first);
      cavity.gradient.push_back(found.surrounds ? swept_gradient(domain, found.walls[n], b.entries)
                                                : enclosed_volume_gradient(found.walls, n, middle));
    }
  }
  return cavity;
}

}  // namespace

Eigen::VectorXd lacking_flux(const Eigen::VectorXd& gradient, double face_area, const std::vector<FluxEntry>& entries,
                             const Communicator& ranks) {
  std::vector<double> sums(std::size_t(gradient.size()));
  for (const FluxEntry& e : entries) sums[std::size_t(e.column)] += e.value;
  ranks.global_sum(sums);
  return -gradient / face_area - Eigen::Map<const Eigen::VectorXd>(sums.data(), gradient.size());
}

// -gradient w + A_f (prescribed + flux) = -(V(u + H w) - volume)/H, solved for the flux.
template <int Dim>
double CavityConstraint<Dim>::missing_flux(const Eigen::VectorXd& w) const {
  double linear = 0;
  std::vector<Eigen::VectorXd> end;
  for (std::size_t n = 0; n < walls.size(); ++n) {
    const Eigen::VectorXd mine = w.segment(first[n], u[n].size());
    linear += gradient[n].dot(mine);
    end.push_back(u[n] + horizon * mine);
  }
  const double net = linear - (enclosed_volume(walls, end) - volume) / horizon;
  return net / face_area - prescribed;
}

template <int Dim>
std::vector<CavityConstraint<Dim>> constrain_cavity_volumes(const CoupledStep<Dim>& step, const ElasticMotions& motions,
                                                            std::vector<BodyEntries>& bodies) {
  const Setup<Dim>& s = step.setup;
  const PressureRows<Dim>& rows = step.rows;
  std::vector<CavityConstraint<Dim>> cavities;
  const auto kept = kept_cavities(s.solids.bodies, motions);
  for (const FoundCavity<Dim>& found :
       find_cavities(s.domain, s.solids, step.geometry, rows, step.closed, motions, bodies)) {
    CavityConstraint<Dim> cavity = make_cavity(s.domain, found, motions, bodies, step.horizon);
    cavity.volume = volume_to_keep(cavity.walls, motions, kept, cavity.u);
    std::set<std::int64_t> touched;
    for (std::size_t n = 0; n < cavity.walls.size(); ++n)
      for (BodyEntries& b : bodies) {
        if (b.body != cavity.walls[n].body) continue;
        const LinkGraph graph = graph_of_wall(cavity.walls[n], found.links[n], s.domain.ranks);
        if (!found.surrounds) correct_wall(s.domain, rows, graph, cavity, n, b.entries);
        for (const auto& [row, number] : graph.row_numbers()) touched.insert(row);
      }
    cavity.rows = rows_by_openness(s.domain, step.geometry.faces, rows, touched);
    const bool open = has_open_wall(cavity.walls);
    for (std::size_t n = 0; n < rows.cells.size() && open; ++n)
      if (found.components.contains(step.closed.component[n])) cavity.cells.push_back(int(n));
    cavities.push_back(std::move(cavity));
  }
  return cavities;
}

template <int Dim>
void take_prescribed_fluxes(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const PressureRows<Dim>& rows,
                            std::vector<CavityConstraint<Dim>>& cavities) {
  if (cavities.empty()) return;
  std::vector<double> sums;
  for (const CavityConstraint<Dim>& cavity : cavities) {
    double& sum = sums.emplace_back(0);
    for (const int n : cavity.cells) {
      const Site c = rows.cells[std::size_t(n)];
      sum += g.faces.cell_flux[c];
      for (int a = 0; a < Dim; ++a)
        sum += g.faces.closed_flux.at(a, c + domain.layout.stride(a)) - g.faces.closed_flux.at(a, c);
    }
  }
  domain.ranks.global_sum(sums);
  for (std::size_t n = 0; n < cavities.size(); ++n) cavities[n].prescribed = sums[n];
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template struct CavityConstraint<D>;                                                                                \
  template std::vector<CavityConstraint<D>> constrain_cavity_volumes<D>(const CoupledStep<D>&, const ElasticMotions&, \
                                                                        std::vector<BodyEntries>&);                   \
  template void take_prescribed_fluxes<D>(const Domain<D>&, const StepGeometry<D>&, const PressureRows<D>&,           \
                                          std::vector<CavityConstraint<D>>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
