#include "coupling/tension/tension_balance.h"

#include <cmath>
#include <cstring>
#include <map>

#include "coupling/tension/surface_graph.h"
#include "fluid/boundary/domain.h"
#include "fluid/pressure/pressure.h"
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

constexpr int turns(int dim) {
  return dim == 2 ? 1 : 3;
}
// Three of force or two, then three of torque or one.
template <int Dim>
using Motions = Eigen::Matrix<double, Dim + turns(Dim), 1>;

// Motions of a link along `axis`, `r` cells from a piece's centre: unit vector, then its moments about that centre.
template <int Dim>
Motions<Dim> motions_at(int axis, const Vec<Dim>& r) {
  const Vec3 moment = extend<Dim>(r).cross(Vec3::Unit(axis));
  Motions<Dim> m = Motions<Dim>::Unit(axis);
  m.template tail<turns(Dim)>() = moment.template tail<turns(Dim)>();
  return m;
}

// Cells and links of a piece. `places`: sum of the links' places from the labelling cell, cells.
template <int Dim>
struct Extent {
  double held = 0;    // number of cells next to a wall, solid or open side
  double astray = 0;  // number of links too far for a piece that ends within half a period
  double links = 0;
  Vec<Dim> places = Vec<Dim>::Zero();

  Vec<Dim> centre() const { return links > 0 ? Vec<Dim>(places / links) : Vec<Dim>::Zero(); }
  static constexpr int count = 3 + Dim;
  void save(double* v) const { v[0] = held, v[1] = astray, v[2] = links, std::copy_n(places.data(), Dim, v + 3); }
  void add(const double* v) {
    held += v[0], astray += v[1], links += v[2];
    for (int a = 0; a < Dim; ++a) places[a] += v[3 + a];
  }
};

// Sums over a piece's links: force = sum of +-kappa g, response = sum of +-g m', for the motions g of a link and the
// corrections m. The sign is + if the link runs from liquid to air along its axis.
template <int Dim>
struct Balance {
  static constexpr int size = Dim + turns(Dim), count = size + size * size;
  Motions<Dim> force = Motions<Dim>::Zero();
  Eigen::Matrix<double, size, size> response = Eigen::Matrix<double, size, size>::Zero();

  void save(double* v) const {
    std::copy_n(force.data(), size, v);
    std::copy_n(response.data(), size * size, v + size);
  }
  void add(const double* v) {
    for (int k = 0; k < size; ++k) force[k] += v[k];
    for (int k = 0; k < size * size; ++k) response.data()[k] += v[size + k];
  }
  // c with response c = force; zero if the system has no finite solution.
  Motions<Dim> shift(bool may_turn) const {
    const int rows = may_turn ? size : Dim;
    Motions<Dim> c = Motions<Dim>::Zero();
    c.head(rows) = least_squares(response.topLeftCorner(rows, rows), force.head(rows));
    return c.allFinite() ? c : Motions<Dim>::Zero();
  }
};

template <class Sums>
using Pieces = std::map<std::int64_t, Sums>;

// Sums over all ranks, in the order of the ranks. Collective.
template <class Sums>
Pieces<Sums> sum_over_ranks(const Pieces<Sums>& mine, const Communicator& ranks) {
  std::string bytes;
  std::array<double, Sums::count> values;
  for (const auto& [label, piece] : mine) {
    piece.save(values.data());
    bytes.append(reinterpret_cast<const char*>(&label), sizeof label);
    bytes.append(reinterpret_cast<const char*>(values.data()), sizeof values);
  }
  Pieces<Sums> all;
  for (const std::string& part : ranks.all_gather(bytes)) {
    std::int64_t label;
    for (std::size_t k = 0; k < part.size(); k += sizeof label + sizeof values) {
      std::memcpy(&label, part.data() + k, sizeof label);
      std::memcpy(values.data(), part.data() + k + sizeof label, sizeof values);
      all[label].add(values.data());
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

// Cells from a piece's labelling cell to a cell, the short way round periodic axes.
template <int Dim>
IVec<Dim> from_label(const Layout<Dim>& layout, Site cell, std::int64_t label) {
  IVec<Dim> d = layout.index(cell);
  for (int a = 0; a < Dim; ++a) {
    const int n = layout.geometry().cells[a];
    d[a] -= int(label % n);
    label /= n;
    if (layout.geometry().periodic[a]) d[a] -= n * int(std::floor(double(d[a]) / n + 0.5));
  }
  return d;
}

// True if a link this far from the labelling cell may belong to a piece that goes round a periodic axis.
template <int Dim>
bool is_astray(const Layout<Dim>& layout, const IVec<Dim>& d) {
  bool astray = false;
  for (int a = 0; a < Dim; ++a)
    astray = astray || (layout.geometry().periodic[a] && 2 * std::abs(d[a]) >= layout.geometry().cells[a] - 4);
  return astray;
}

// The surface's closed pieces, and their corrections.
template <int Dim>
class ClosedPieces {
 public:
  ClosedPieces(const Domain<Dim>& domain, const Fluids& fluids, const FaceGeometry<Dim>& faces,
               const CellField<Dim>& phi, const FaceField<Dim, char>& crossed)
      : domain_(domain),
        gas_(fluids.gas_density() / fluids.density()),
        phi_(phi),
        crossed_(crossed),
        graph_(domain, crossed),
        label_(label_pieces(domain, graph_)) {
    Pieces<Extent<Dim>> mine;
    for (Site c : graph_.cells()) mine[label_[c]].held += is_held(domain.layout, faces, c);
    for_each_link([&](int a, Site f) {
      Extent<Dim>& extent = mine[label_[f]];
      extent.places += place(a, f);
      ++extent.links;
      extent.astray += is_astray<Dim>(domain_.layout, from_label<Dim>(domain_.layout, f, label_[f]));
    });
    extents_ = sum_over_ranks(mine, domain.ranks);
  }

  void balance(FaceField<Dim>& kappa) const {
    Pieces<Balance<Dim>> mine;
    for_each_free_link([&](int a, Site f, const Extent<Dim>& extent) {
      Balance<Dim>& sums = mine[label_[f]];
      const Motions<Dim> g = sign(f) * motions_at<Dim>(a, place(a, f) - extent.centre());
      sums.force += kappa.at(a, f) * g;
      sums.response += g * correction(a, f, extent).transpose();
    });
    std::map<std::int64_t, Motions<Dim>> shift;
    for (const auto& [piece, sums] : sum_over_ranks(mine, domain_.ranks))
      if (mine.count(piece)) shift[piece] = sums.shift(extents_.at(piece).astray == 0);
    for_each_free_link([&](int a, Site f, const Extent<Dim>& extent) {
      kappa.at(a, f) -= shift.at(label_[f]).dot(correction(a, f, extent));
    });
  }

 private:
  // Visits each link once: at the cell above it, if this rank owns that cell.
  template <class Visit>
  void for_each_link(const Visit& visit) const {
    for (Site c : graph_.cells())
      for (int a = 0; a < Dim; ++a)
        if (crossed_.at(a, c)) visit(a, c);
  }
  template <class Visit>
  void for_each_free_link(const Visit& visit) const {
    for_each_link([&](int a, Site f) {
      const Extent<Dim>& extent = extents_.at(label_[f]);
      if (extent.held == 0) visit(a, f, extent);
    });
  }
  double sign(Site f) const { return phi_[f] < 0 ? -1 : 1; }
  // The middle of a link from the labelling cell's centre, cells.
  Vec<Dim> place(int axis, Site f) const {
    return from_label<Dim>(domain_.layout, f, label_[f]).template cast<double>() - 0.5 * Vec<Dim>::Unit(axis);
  }
  // The normal, and the jumps that turn the links' fluid like a rigid body.
  Motions<Dim> correction(int axis, Site f, const Extent<Dim>& extent) const {
    const double theta = liquid_part(phi_[f - domain_.layout.stride(axis)], phi_[f]);
    Motions<Dim> m = (theta + (1 - theta) * gas_) * sign(f) * motions_at<Dim>(axis, place(axis, f) - extent.centre());
    m.template head<Dim>() = normal_at(domain_.layout, phi_, axis, f);
    return m;
  }

  const Domain<Dim>& domain_;
  double gas_;  // density over the liquid's
  const CellField<Dim>& phi_;
  const FaceField<Dim, char>& crossed_;
  SurfaceGraph<Dim> graph_;
  CellField<Dim, std::int64_t> label_;
  Pieces<Extent<Dim>> extents_;
};

}  // namespace

template <int Dim>
void balance_closed_pieces(const Domain<Dim>& domain, const Fluids& fluids, const FaceGeometry<Dim>& faces,
                           const CellField<Dim>& phi, const FaceField<Dim, char>& crossed, FaceField<Dim>& kappa) {
  ClosedPieces<Dim>(domain, fluids, faces, phi, crossed).balance(kappa);
}

template void balance_closed_pieces<2>(const Domain<2>&, const Fluids&, const FaceGeometry<2>&, const CellField<2>&,
                                       const FaceField<2, char>&, FaceField<2>&);
template void balance_closed_pieces<3>(const Domain<3>&, const Fluids&, const FaceGeometry<3>&, const CellField<3>&,
                                       const FaceField<3, char>&, FaceField<3>&);

}  // namespace seiche
