#include "fluid/viscosity/viscosity.h"

#include <algorithm>
#include <cstring>

#include "base/parallel_range.h"
#include "fluid/viscosity/viscous_terms.h"
#include "grid/loops.h"
#include "linalg/core/matrix_entries.h"

namespace seiche {
namespace {

using Entries = std::vector<std::pair<Row, double>>;
using Columns = std::vector<std::pair<int, double>>;

// dt/2 d(z'Vz)/du_f: the contributions of face f to its rows of F, G and f.
struct RowParts {
  Entries entries;  // the diagonal is the first
  Columns columns;
  double known = 0;
};

template <class Index>
void merge(std::vector<std::pair<Index, double>>& v, std::size_t begin) {
  std::sort(v.begin() + std::ptrdiff_t(begin), v.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  std::size_t last = begin;
  for (std::size_t n = begin; n < v.size(); ++n) {
    if (last > begin && v[last - 1].first == v[n].first)
      v[last - 1].second += v[n].second;
    else
      v[last++] = v[n];
  }
  v.resize(last);
}

template <int Dim>
class RowAssembly {
 public:
  RowAssembly(const ViscousInput<Dim>& in, const ViscousSamples<Dim>& samples)
      : in_(in), layout_(in.layout), s_(samples), terms_(in, samples) {}

  RowParts operator()(int axis, Site f) const { return is_plain(axis, f) ? plain_row(axis, f) : general_row(axis, f); }

 private:
  Row row(int axis, Site f) const { return s_.rows.row.at(axis, f); }
  bool all_unknown(int axis, Site f, Site step) const {
    return s_.kind_at(axis, f) == SampleKind::unknown && s_.kind_at(axis, f + step) == SampleKind::unknown;
  }

  // True if all cells and edges that touch the face are full and only have unknown velocities.
  bool is_plain(int axis, Site f) const {
    if (!in_.uniform_viscosity) return false;
    for (Site cell : {f - layout_.stride(axis), f}) {
      if (s_.share.cell[cell] != 1) return false;
      for (int a = 0; a < Dim; ++a)
        if (!all_unknown(a, cell, layout_.stride(a)) || in_.faces.open.at(a, cell) < 1 ||
            in_.faces.open.at(a, cell + layout_.stride(a)) < 1)
          return false;
    }
    for (int p = 0; p < planes<Dim>; ++p) {
      const auto [a, b] = plane_axes<Dim>(p);
      if (a != axis && b != axis) continue;
      for (Site e : {f, f + layout_.stride(a == axis ? b : a)})
        if (s_.share.edge[p][std::size_t(e)] != 1 || !all_unknown(a, e, -layout_.stride(b)) ||
            !all_unknown(b, e, -layout_.stride(a)) || on_side(a, b, e))
          return false;
    }
    return true;
  }

  // True if the edge lies on an outflow side, whose faces are unknowns. Edges on other sides have given velocities.
  bool on_side(int a, int b, Site e) const {
    return in_.faces.kind_at(a, e) == FaceKind::outflow || in_.faces.kind_at(b, e) == FaceKind::outflow;
  }

  // dt mu h^(Dim-2) times (2 Dim u - sum of neighbours), and the kappa (div u)^2 terms of the two cells.
  RowParts plain_row(int axis, Site f) const {
    const double c = in_.dt * terms_.coefficient(f), kappa = c * terms_.interior_kappa();
    RowParts r;
    r.entries.emplace_back(row(axis, f), 2 * Dim * c);
    for (int b = 0; b < Dim; ++b) {
      r.entries.emplace_back(row(axis, f - layout_.stride(b)), -c);
      r.entries.emplace_back(row(axis, f + layout_.stride(b)), -c);
    }
    for (int n = 0; kappa > 0 && n < 2; ++n) {
      const Site cell = n == 0 ? f - layout_.stride(axis) : f;
      const double mine = n == 0 ? kappa : -kappa;
      for_each_face_of(layout_, cell, [&](int a, Site g, int sign, Site) {
        if (a == axis && g == f)
          r.entries[0].second += mine * sign;
        else
          r.entries.emplace_back(row(a, g), mine * sign);
      });
    }
    merge(r.entries, 1);
    return r;
  }

  RowParts general_row(int axis, Site f) const {
    RowParts r;
    const Row mine = row(axis, f);
    r.entries.emplace_back(mine, 0);
    terms_.for_each_of_row(axis, f, [&](const ViscousTerm<Dim>& t) {
      for (int i = 0; i < t.slots; ++i)
        if (terms_.row(t.slot[i]) == mine) add(t, i, r);
    });
    merge(r.entries, 1);
    merge(r.columns, 0);
    drop_round_off(r);
    return r;
  }

  void add(const ViscousTerm<Dim>& t, int i, RowParts& r) const {
    for (int j = 0; j < t.slots; ++j) {
      const double c = in_.dt * t.Q[i][j];
      if (c == 0) continue;
      const AffineVelocity s = terms_.relative_velocity(t, j);
      if (s.row == r.entries[0].first)
        r.entries[0].second += c;
      else if (s.row >= 0)
        r.entries.emplace_back(s.row, c);
      for (const auto& [column, weight] : s.columns) r.columns.emplace_back(column, c * weight);
      r.known -= c * s.known;
    }
  }

  // Removes the round-off of terms that cancel. The limit is the same for all rows, so that F stays symmetric.
  void drop_round_off(RowParts& r) const {
    const double least =
        in_.uniform_viscosity ? 1e-14 * in_.dt * terms_.coefficient(layout_.site(layout_.cells().lower)) : 0;
    const auto small = [&](const auto& e) { return std::abs(e.second) <= least; };
    r.entries.erase(std::remove_if(r.entries.begin() + 1, r.entries.end(), small), r.entries.end());
  }

  const ViscousInput<Dim>& in_;
  const Layout<Dim>& layout_;
  const ViscousSamples<Dim>& s_;
  ViscousTerms<Dim> terms_;
};

// Mass rho_f w h^Dim of a face, as in the projection. Pressure-free faces follow the stress and get a thousandth of a
// full face's mass, which is enough to keep velocities without stress at u*.
template <int Dim>
double face_mass(const ViscousInput<Dim>& in, int axis, Site f) {
  constexpr double follower = 1e-3;
  const double full = in.density * in.layout.geometry().cell_volume();
  const Site low = f - in.layout.stride(axis);
  const bool has_low = in.rows.has_pressure(low);
  const double w = in.faces.open.at(axis, f);
  if (!in.faces.is_unknown(axis, f) || w == 0 || !in.rows.touch_pressure(low, f)) return follower * full;
  if (in.faces.kind_at(axis, f) == FaceKind::outflow)
    return 0.5 * w * full /
           (in.projection.entry_factor(axis, f) * inverse_density_ratio_of_cell(in.projection, has_low ? low : f));
  return w * full / inverse_density_ratio_of_link(in.projection, low, f);
}

// Impulse of given pressures on a face. Outflow sides: +dt w h^(Dim-1) p if the face's upper cell has a pressure, -dt w
// h^(Dim-1) p if the lower one has. Faces that the surface crosses: -dt w h^(Dim-1) (p_low - p_high).
template <int Dim>
double given_impulse(const ViscousInput<Dim>& in, int axis, Site f) {
  const double area = in.dt * in.faces.open.at(axis, f) * in.layout.geometry().face_area();
  if (in.faces.kind_at(axis, f) != FaceKind::outflow) return -area * jump_over(in.projection, axis, f);
  const double push = area * in.faces.side_pressure.at(axis, f);
  if (in.rows.has_pressure(f)) return push;
  return in.rows.has_pressure(f - in.layout.stride(axis)) ? -push : 0;
}

// The bodies with unknowns, in the order of their unknowns.
template <int Dim>
std::vector<int> free_bodies(const ViscousInput<Dim>& in) {
  std::vector<int> bodies;
  for (std::size_t k = 0; k < in.solids.size(); ++k)
    if (in.solids[k].moves_freely()) bodies.push_back(int(k));
  std::sort(bodies.begin(), bodies.end(),
            [&](int i, int j) { return in.solids[i].first_unknown < in.solids[j].first_unknown; });
  return bodies;
}

template <int Dim>
BlockColumns empty_blocks(const ViscousInput<Dim>& in, const std::vector<int>& bodies) {
  BlockColumns G;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const int end = b + 1 < bodies.size() ? in.solids[bodies[b + 1]].first_unknown : in.unknowns;
    G.blocks.emplace_back();
    G.blocks.back().width = end - in.solids[bodies[b]].first_unknown;
  }
  return G;
}

template <int Dim>
void take_columns(const ViscousInput<Dim>& in, const std::vector<int>& bodies, int row, const Columns& columns,
                  BlockColumns& G) {
  for (const auto& [column, value] : columns) {
    std::size_t b = bodies.size() - 1;
    while (in.solids[bodies[b]].first_unknown > column) --b;
    G.blocks[b].add(row, column - in.solids[bodies[b]].first_unknown, value);
  }
}

template <int Dim>
FaceField<Dim> assemble_rows(const ViscousInput<Dim>& in, ViscousSystem<Dim>& r) {
  FaceField<Dim> drag(in.layout);
  const RowAssembly<Dim> row_of(in, *r.samples);
  std::vector<RowParts> parts(r.rows.faces.size());
  parallel_range_in_tasks(parts.size(), 512,
                          [&](std::size_t n) { parts[n] = row_of(r.rows.faces[n].first, r.rows.faces[n].second); });
  r.F.first_row = r.rows.first;
  r.F.global_rows = r.rows.global;
  const std::vector<int> bodies = free_bodies(in);
  r.G = empty_blocks(in, bodies);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const auto [axis, f] = r.rows.faces[n];
    r.mass.push_back(face_mass(in, axis, f));
    r.f.push_back(r.mass[n] * in.u_star.at(axis, f) + given_impulse(in, axis, f) + parts[n].known);
    drag.at(axis, f) = parts[n].entries[0].second;
    parts[n].entries[0].second += r.mass[n];
    for (const auto& [column, value] : parts[n].entries) r.F.column.push_back(column), r.F.value.push_back(value);
    r.F.row_start.push_back(int(r.F.value.size()));
    take_columns(in, bodies, int(n), parts[n].columns, r.G);
  }
  in.halo.fill_ghosts(drag);
  return drag;
}

// This rank's part of Hvv (row, column, value) and of g.
template <int Dim>
std::vector<Eigen::Triplet<double>> body_terms(const ViscousInput<Dim>& in, const ViscousTerms<Dim>& terms,
                                               Eigen::VectorXd& g) {
  std::vector<Eigen::Triplet<double>> H;
  std::vector<AffineVelocity> s;
  terms.for_each_owned([&](const ViscousTerm<Dim>& t) {
    bool any = false;
    const auto is_free = [&](int k) { return k >= 0 && in.solids[k].moves_freely(); };
    for (int i = 0; i < t.slots; ++i) any = any || is_free(terms.solid(t.slot[i]));
    if (!any && !is_free(t.frame)) return;
    s.clear();
    for (int i = 0; i < t.slots; ++i) s.push_back(terms.relative_velocity(t, i));
    for (int i = 0; i < t.slots; ++i)
      for (int j = 0; j < t.slots; ++j)
        for (const auto& [k, weight] : s[i].columns) {
          const double c = in.dt * t.Q[i][j] * weight;
          g[k] -= c * s[j].known;
          for (const auto& [l, other] : s[j].columns)
            if (c != 0) H.emplace_back(k, l, c * other);
        }
  });
  return H;
}

template <int Dim>
void assemble_bodies(const ViscousInput<Dim>& in, ViscousSystem<Dim>& r) {
  r.g = Eigen::VectorXd::Zero(in.unknowns);
  r.Hvv = Eigen::SparseMatrix<double>(in.unknowns, in.unknowns);
  if (in.unknowns == 0) return;
  const auto mine = body_terms(in, ViscousTerms<Dim>(in, *r.samples), r.g);
  Eigen::SparseMatrix<double> H(in.unknowns, in.unknowns);
  H.setFromTriplets(mine.begin(), mine.end());
  in.ranks.global_sum({r.g.data(), std::size_t(r.g.size())});
  std::string bytes;
  for (int k = 0; k < H.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(H, k); it; ++it) {
      const double entry[3] = {double(it.row()), double(it.col()), it.value()};
      bytes.append(reinterpret_cast<const char*>(entry), sizeof entry);
    }
  std::vector<Eigen::Triplet<double>> all;
  for (const std::string& part : in.ranks.all_gather(bytes))
    for (std::size_t n = 0; n < part.size(); n += 3 * sizeof(double)) {
      double entry[3];
      std::memcpy(entry, part.data() + n, sizeof entry);
      all.emplace_back(int(entry[0]), int(entry[1]), entry[2]);
    }
  r.Hvv.setFromTriplets(all.begin(), all.end());
}

// Appends a row with its columns in ascending order.
void append_row(Entries& entries, DistributedMatrix& m) {
  std::sort(entries.begin(), entries.end());
  for (const auto& [column, value] : entries) m.column.push_back(column), m.value.push_back(value);
  m.row_start.push_back(int(m.value.size()));
}

// Appends the rows of regions of air to D and schur_mass.
template <int Dim>
void append_air_rows(const ViscousInput<Dim>& in, const std::vector<MatrixEntry>& entries,
                     std::vector<double>& mobility, ViscousSystem<Dim>& r) {
  const auto home = send_to_owner(entries, in.rows.first, in.rows.cells.size(), in.ranks);
  in.ranks.global_sum(mobility);
  auto next = home.begin();
  for (std::size_t n = in.rows.liquid; n < in.rows.cells.size(); ++n) {
    Entries row;
    for (; next != home.end() && next->row == in.rows.first + Row(n); ++next)
      row.emplace_back(next->column, next->value);
    append_row(row, r.D);
    const double m = mobility[std::size_t(in.rows.region(in.rows.cells[n]))];
    r.schur_mass.push_back(m > 0 ? 1 / m : 0);
  }
}

// D_cf = +- w h^(Dim-1); known fluxes go to q. schur_mass is the inverse of the diagonal of D diag(dt V)^-1 D', the
// viscous part of the Schur complement. That diagonal is about h^Dim/(dt mu) in full cells, and much smaller in cells
// whose faces are held by walls.
template <int Dim>
void assemble_divergence(const ViscousInput<Dim>& in, const FaceField<Dim>& drag, ViscousSystem<Dim>& r) {
  const double area = in.layout.geometry().face_area();
  r.D.first_row = in.rows.first, r.D.global_rows = in.rows.global;
  Entries entries;
  r.q = net_over_rows(
      in.layout, in.ranks, in.rows, [&](Site c) { return in.faces.cell_flux[c]; },
      [&](int a, Site f) {
        const bool given = in.faces.kind_at(a, f) == FaceKind::prescribed;
        return in.faces.closed_flux.at(a, f) + (given ? in.faces.open.at(a, f) * in.faces.prescribed.at(a, f) : 0);
      });
  for (std::size_t n = 0; n < in.rows.liquid; ++n) {
    const Site cell = in.rows.cells[n];
    double mobility = 0;
    entries.clear();
    for_each_face_of(in.layout, cell, [&](int a, Site f, int sign, Site) {
      const double w = in.faces.open.at(a, f);
      if (!in.faces.is_unknown(a, f) || w == 0) return;
      entries.emplace_back(r.rows.row.at(a, f), sign * w * area);
      mobility += w * w * area * area / drag.at(a, f);
    });
    r.q[n] += in.projection.missing_flux(cell);
    r.schur_mass.push_back(mobility > 0 ? 1 / mobility : 0);
    append_row(entries, r.D);
  }
  for (std::size_t n = in.rows.liquid; n < r.q.size(); ++n) r.q[n] += missing_flux(in.projection, in.rows, n);
  for (double& known : r.q) known *= -area;
}

// Assembles Dt, and from it the rows of D that belong to regions of air.
template <int Dim>
void assemble_gradient(const ViscousInput<Dim>& in, const FaceField<Dim>& drag, ViscousSystem<Dim>& r) {
  const double area = in.layout.geometry().face_area();
  r.Dt.first_row = r.rows.first, r.Dt.global_rows = r.rows.global;
  Entries entries;
  std::vector<MatrixEntry> of_air;
  std::vector<double> mobility(in.rows.air_row.size());
  for (std::size_t n = 0; n < r.rows.faces.size(); ++n) {
    const auto [axis, f] = r.rows.faces[n];
    entries.clear();
    const Site below = f - in.layout.stride(axis);
    const bool counts = in.faces.is_unknown(axis, f) && in.rows.touch_pressure(below, f);
    const double w = counts ? in.faces.open.at(axis, f) : 0;
    for (const Site cell : {below, f}) {
      if (w == 0 || in.rows.row[cell] < 0) continue;
      const double entry = (cell == f ? -1 : 1) * w * area;
      entries.emplace_back(in.rows.row[cell], entry);
      if (const std::int64_t k = in.rows.region(cell); k >= 0) {
        of_air.push_back({in.rows.row[cell], r.rows.first + Row(n), entry});
        mobility[std::size_t(k)] += entry * entry / drag.at(axis, f);
      }
    }
    append_row(entries, r.Dt);
  }
  if (in.rows.air) append_air_rows(in, of_air, mobility, r);
}

}  // namespace

template <int Dim>
ViscousSystem<Dim> assemble_viscosity(const ViscousInput<Dim>& in) {
  ViscousSystem<Dim> r;
  r.samples = std::make_shared<const ViscousSamples<Dim>>(sample_faces(in));
  r.rows = r.samples->rows;
  const FaceField<Dim> drag = assemble_rows(in, r);
  assemble_bodies(in, r);
  assemble_divergence(in, drag, r);
  assemble_gradient(in, drag, r);
  return r;
}

template ViscousSystem<2> assemble_viscosity<2>(const ViscousInput<2>&);
template ViscousSystem<3> assemble_viscosity<3>(const ViscousInput<3>&);

}  // namespace seiche
