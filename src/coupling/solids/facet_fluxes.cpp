#include "coupling/solids/facet_fluxes.h"

#include "base/parallel_range.h"
#include "coupling/solids/exposed_surface.h"
#include "coupling/solids/link_graph.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "solid/body/elastic_motion.h"

namespace seiche {
namespace {

// Number of a cell in the whole grid, the same on all ranks.
template <int Dim>
std::int64_t number_of(const Domain<Dim>& domain, const IVec<Dim>& cell) {
  std::int64_t number = 0;
  for (int a = Dim - 1; a >= 0; --a) number = number * domain.layout.geometry().cells[a] + cell[a];
  return number;
}

template <int Dim>
std::vector<LoadedPiece<Dim>> load_pieces(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u,
                                          const std::vector<ExposedPiece<Dim>>& pieces) {
  std::vector<LoadedPiece<Dim>> loaded(pieces.size());
  parallel_range(0, int(loaded.size()), [&](int i) {
    const ExposedPiece<Dim>& exposed = pieces[std::size_t(i)];
    loaded[std::size_t(i)] = {exposed.cell, load_of_piece(solid, u, exposed.piece)};
  });
  return loaded;
}

// Requirements of D: the flux per cell that unit translations along each axis lack, and the nodes that may carry it.
template <int Dim>
struct Lacking {
  std::map<std::int64_t, Vec<Dim>> flux;  // by number, of this rank's cells
  std::map<std::int64_t, Site> cell;
  std::set<Link> links;

  Vec<Dim>& of(const Domain<Dim>& domain, Site c) {
    const std::int64_t number = number_of(domain, domain.layout.index(c));
    cell[number] = c;
    return flux.try_emplace(number, Vec<Dim>::Zero()).first->second;
  }
};

// Cells without pieces put their lacking flux on the nodes that their face shares are attached to. In a thin wall these
// may lie on the other side, so cells with pieces use only the nodes of their pieces.
template <int Dim>
void add_links_of_shares(const Domain<Dim>& domain, const CellField<Dim, char>& open, const FaceShares& shares,
                         const FaceWeights& face_weights, Lacking<Dim>& lacking) {
  constexpr double rounding = 1e-12;
  const std::set<Link> own = lacking.links;
  const auto has_pieces = [&](std::int64_t number) {
    const auto first = own.lower_bound({number, 0});
    return first != own.end() && first->row == number;
  };
  for (std::size_t n = 0; n < shares.size(); ++n)
    for (const int side : {0, 1}) {
      const Site c = shares[n].face - side * domain.layout.stride(shares[n].axis);
      const IVec<Dim> i = domain.layout.index(c);
      if (!domain.layout.cells().contains(i) || !open[c]) continue;
      const std::int64_t number = number_of(domain, i);
      if (has_pieces(number) || lacking.of(domain, c).norm() <= rounding) continue;
      for (const auto& [weights, weight] : face_weights[n]) lacking.links.insert({number, weights});
    }
}

template <int Dim>
Lacking<Dim> find_lacking(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const CellField<Dim, char>& open,
                          int k, const std::vector<LoadedPiece<Dim>>& pieces) {
  Lacking<Dim> lacking;
  const double area = domain.layout.geometry().face_area();
  for (const LoadedPiece<Dim>& p : pieces) {
    lacking.of(domain, p.cell) += p.load.area.rowwise().sum() / area;
    const std::int64_t number = number_of(domain, domain.layout.index(p.cell));
    for (const int node : p.load.nodes) lacking.links.insert({number, node});
  }
  const FaceShares& shares = *g.shares[std::size_t(k)];
  for (std::size_t n = 0; n < shares.size(); ++n)
    for (const int side : {0, 1}) {
      const Site c = shares[n].face - side * domain.layout.stride(shares[n].axis);
      const IVec<Dim> i = domain.layout.index(c);
      if (!domain.layout.cells().contains(i) || !open[c]) continue;
      lacking.of(domain, c)[shares[n].axis] += (side == 0 ? -1 : 1) * shares[n].closed;
    }
  add_links_of_shares(domain, open, shares, *g.face_weights[std::size_t(k)], lacking);
  return lacking;
}

template <int Dim>
std::vector<char> held_nodes(const ElasticSolid<Dim>& solid, const LinkGraph& graph) {
  std::vector<char> held(std::size_t(graph.nodes()));
  for (const PinnedNodes& pin : solid.pins)
    for (const int n : pin.nodes)
      if (const auto found = graph.node_numbers().find(n); found != graph.node_numbers().end())
        held[std::size_t(found->second)] = 1;
  return held;
}

// Computes D (see FacetFluxes). Collective.
template <int Dim>
CellFluxes balance_translations(const Domain<Dim>& domain, const ElasticSolid<Dim>& solid,
                                const Lacking<Dim>& lacking) {
  LinkGraph graph(gather_links(lacking.links, domain.ranks));
  if (graph.links().empty()) return {};
  graph.number();
  const std::vector<char> held = held_nodes(solid, graph);
  const BalancedMinimumNormFlux least(graph, held);
  CellFluxes balance;
  for (int axis = 0; axis < Dim; ++axis) {
    std::vector<double> wanted(std::size_t(graph.rows()));
    for (const auto& [number, flux] : lacking.flux)
      if (const auto row = graph.row_numbers().find(number); row != graph.row_numbers().end())
        wanted[std::size_t(row->second)] = flux[axis];
    domain.ranks.global_sum(wanted);
    const std::vector<double> d = least.solve(Eigen::Map<const Eigen::VectorXd>(wanted.data(), graph.rows()));
    for (std::size_t n = 0; n < d.size(); ++n)
      if (const auto cell = lacking.cell.find(graph.links()[n].row); cell != lacking.cell.end() && d[n] != 0)
        balance.push_back({cell->second, Dim * int(graph.links()[n].node) + axis, d[n]});
  }
  return balance;
}

}  // namespace

template <int Dim>
FacetFluxes<Dim> facet_fluxes(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
                              const CellField<Dim, char>& open, int k, const Eigen::VectorXd& u) {
  const ElasticSolid<Dim>& solid = solids.bodies[std::size_t(k)].elastic();
  FacetFluxes<Dim> fluxes;
  fluxes.pieces = load_pieces(solid, u,
                              exposed_pieces(domain, open, solid.surface.facets, surface_points(solid, u),
                                             JointedNeighbours<Dim>(domain, solids, g, k)));
  fluxes.balance = balance_translations(domain, solid, find_lacking(domain, g, open, k, fluxes.pieces));
  return fluxes;
}

template <int Dim>
CellFluxes entries_of(const Domain<Dim>& domain, const FacetFluxes<Dim>& fluxes) {
  CellFluxes entries;
  const double area = domain.layout.geometry().face_area();
  for (const LoadedPiece<Dim>& p : fluxes.pieces)
    for (std::size_t i = 0; i < p.load.nodes.size(); ++i)
      for (int a = 0; a < Dim; ++a)
        entries.push_back({p.cell, Dim * p.load.nodes[i] + a, -p.load.area(a, Eigen::Index(i)) / area});
  entries.insert(entries.end(), fluxes.balance.begin(), fluxes.balance.end());
  return entries;
}

template <int Dim>
Eigen::VectorXd missing_buoyancy(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                 const PressureRows<Dim>& rows, const CellField<Dim>& phi, int k,
                                 const Eigen::VectorXd& u, const FacetFluxes<Dim>& fluxes, const Vec<Dim>& gravity) {
  const ElasticSolid<Dim>& solid = solids.bodies[std::size_t(k)].elastic();
  const auto center = [&](Site c) { return domain.layout.position(domain.layout.index(c), cell_offset<Dim>()); };
  const auto density = [&](Site c) { return density_beside(fluids, rows, phi, c); };
  std::vector<double> force(std::size_t(u.size()));
  for (const LoadedPiece<Dim>& p : fluxes.pieces)
    for (std::size_t i = 0; i < p.load.nodes.size(); ++i) {
      // int (x - x_c).g N_i n dA
      const Vec<Dim> load = p.load.moment[i] * gravity - p.load.area.col(Eigen::Index(i)) * center(p.cell).dot(gravity);
      for (int a = 0; a < Dim; ++a) force[std::size_t(Dim * p.load.nodes[i] + a)] -= density(p.cell) * load[a];
    }
  for (const CellFlux& d : fluxes.balance) {
    const int n = d.column / Dim;
    const Vec<Dim> x = solid.body.mesh.nodes[std::size_t(n)] + u.template segment<Dim>(Dim * n);
    force[std::size_t(d.column)] -=
        domain.layout.geometry().face_area() * d.value * density(d.cell) * gravity.dot(center(d.cell) - x);
  }
  domain.ranks.global_sum(force);
  return Eigen::Map<const Eigen::VectorXd>(force.data(), u.size());
}

#define SEICHE_INSTANTIATE(D)                                                                         \
  template FacetFluxes<D> facet_fluxes<D>(const Domain<D>&, const Solids<D>&, const StepGeometry<D>&, \
                                          const CellField<D, char>&, int, const Eigen::VectorXd&);    \
  template CellFluxes entries_of<D>(const Domain<D>&, const FacetFluxes<D>&);                         \
  template Eigen::VectorXd missing_buoyancy<D>(const Domain<D>&, const Fluids&, const Solids<D>&,     \
                                               const PressureRows<D>&, const CellField<D>&, int,      \
                                               const Eigen::VectorXd&, const FacetFluxes<D>&, const Vec<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
