#include "coupling/tension/tension_balance.h"

#include <cstring>
#include <map>

#include "coupling/tension/surface_graph.h"
#include "fluid/boundary/domain.h"
#include "linalg/core/dense_factors.h"

namespace seiche {
namespace {

// Number of a cell in the whole grid, equal on all ranks.
template <int Dim>
std::int64_t global_number(const Layout<Dim>& layout, Site cell) {
  const IVec<Dim> i = layout.index(cell);
  std::int64_t n = 0;
  for (int a = Dim - 1; a >= 0; --a) n = n * layout.geometry().cells[a] + i[a];
  return n;
}

// Per cell of the graph: the least global number in its connected piece. Labels spread along the list of cells,
// backwards, and between ranks until nothing changes. Collective.
template <int Dim>
CellField<Dim, std::int64_t> label_pieces(const Domain<Dim>& domain, const SurfaceGraph<Dim>& graph) {
  CellField<Dim, std::int64_t> label(domain.layout, -1);
  const std::vector<Site>& cells = graph.cells();
  for (Site c : cells) label[c] = global_number(domain.layout, c);
  bool changed = true;
  const auto adopt = [&](Site c) {
    graph.for_each_neighbour(c, [&](Site across) {
      if (label[across] < 0 || label[across] >= label[c]) return;
      label[c] = label[across];
      changed = true;
    });
  };
  do {
    domain.halo.fill_ghosts({label.data()});
    changed = false;
    for (Site c : cells) adopt(c);
    for (auto c = cells.rbegin(); c != cells.rend(); ++c) adopt(*c);
  } while (domain.ranks.any(changed));
  return label;
}

// Sums over a piece: force_a = sum of +-kappa over the links along a, response_ab = sum of +-n_b. The sign is + if the
// link runs from liquid to air along a.
template <int Dim>
struct Piece {
  double held = 0;  // number of cells next to a wall, solid or open side
  Vec<Dim> force = Vec<Dim>::Zero();
  Eigen::Matrix<double, Dim, Dim> response = Eigen::Matrix<double, Dim, Dim>::Zero();

  void add(const Piece& other) {
    held += other.held;
    force += other.force;
    response += other.response;
  }
  // c with response c = force; zero if the piece is held or the system has no finite solution.
  Vec<Dim> shift() const {
    if (held > 0) return Vec<Dim>::Zero();
    const Vec<Dim> c = least_squares(response, force);
    return c.allFinite() ? c : Vec<Dim>::Zero();
  }
};

template <int Dim>
using Pieces = std::map<std::int64_t, Piece<Dim>>;

// Sums over all ranks, in the order of the ranks. Collective.
template <int Dim>
Pieces<Dim> sum_over_ranks(const Pieces<Dim>& mine, const Communicator& ranks) {
  std::string bytes;
  for (const auto& [label, piece] : mine) {
    std::array<double, 1 + Dim + Dim * Dim> values{piece.held};
    std::copy_n(piece.force.data(), Dim, values.begin() + 1);
    std::copy_n(piece.response.data(), Dim * Dim, values.begin() + 1 + Dim);
    bytes.append(reinterpret_cast<const char*>(&label), sizeof label);
    bytes.append(reinterpret_cast<const char*>(values.data()), sizeof values);
  }
  Pieces<Dim> all;
  for (const std::string& part : ranks.all_gather(bytes)) {
    std::array<double, 1 + Dim + Dim * Dim> values;
    std::int64_t label;
    for (std::size_t k = 0; k < part.size(); k += sizeof label + sizeof values) {
      std::memcpy(&label, part.data() + k, sizeof label);
      std::memcpy(values.data(), part.data() + k + sizeof label, sizeof values);
      Piece<Dim> piece;
      piece.held = values[0];
      std::copy_n(values.begin() + 1, Dim, piece.force.data());
      std::copy_n(values.begin() + 1 + Dim, Dim * Dim, piece.response.data());
      all[label].add(piece);
    }
  }
  return all;
}

// Unit normal out of the liquid where the surface crosses the link of face f.
template <int Dim>
Vec<Dim> normal_at(const Layout<Dim>& layout, const CellField<Dim>& phi, int axis, Site f) {
  const Site low = f - layout.stride(axis);
  const double t = phi[low] / (phi[low] - phi[f]);
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) {
    const Site d = layout.stride(a);
    g[a] = (1 - t) * (phi[low + d] - phi[low - d]) + t * (phi[f + d] - phi[f - d]);
  }
  const double norm = g.norm();
  return norm > 0 ? Vec<Dim>(g / norm) : Vec<Dim>(std::copysign(1.0, phi[f] - phi[low]) * Vec<Dim>::Unit(axis));
}

template <int Dim>
bool is_held(const Layout<Dim>& layout, const FaceGeometry<Dim>& faces, Site cell) {
  bool held = false;
  for_each_face_of(layout, cell, [&](int a, Site f, int, Site) {
    held = held || faces.kind_at(a, f) != FaceKind::open || faces.open.at(a, f) < 1;
  });
  return held;
}

}  // namespace

template <int Dim>
void balance_closed_pieces(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const CellField<Dim>& phi,
                           const FaceField<Dim, char>& crossed, FaceField<Dim>& kappa) {
  const SurfaceGraph<Dim> graph(domain, crossed);
  const CellField<Dim, std::int64_t> label = label_pieces(domain, graph);
  Pieces<Dim> mine;
  for (Site c : graph.cells()) mine[label[c]].held += is_held(domain.layout, faces, c);
  // Visits each link once: at the cell above it, if this rank owns that cell.
  const auto for_each_link = [&](const auto& visit) {
    for (Site c : graph.cells())
      for (int a = 0; a < Dim; ++a)
        if (crossed.at(a, c)) visit(a, c, normal_at(domain.layout, phi, a, c));
  };
  for_each_link([&](int a, Site f, const Vec<Dim>& n) {
    Piece<Dim>& piece = mine[label[f]];
    const double sign = phi[f] < 0 ? -1 : 1;
    piece.force[a] += sign * kappa.at(a, f);
    piece.response.row(a) += sign * n.transpose();
  });
  const Pieces<Dim> all = sum_over_ranks(mine, domain.ranks);
  std::map<std::int64_t, Vec<Dim>> shift;
  for (const auto& [piece, sums] : all)
    if (mine.count(piece)) shift[piece] = sums.shift();
  for_each_link([&](int a, Site f, const Vec<Dim>& n) { kappa.at(a, f) -= shift.at(label[f]).dot(n); });
}

template void balance_closed_pieces<2>(const Domain<2>&, const FaceGeometry<2>&, const CellField<2>&,
                                       const FaceField<2, char>&, FaceField<2>&);
template void balance_closed_pieces<3>(const Domain<3>&, const FaceGeometry<3>&, const CellField<3>&,
                                       const FaceField<3, char>&, FaceField<3>&);

}  // namespace seiche
