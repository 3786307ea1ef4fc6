#include "fluid/pressure.h"

#include "grid/loops.h"

namespace seiche {

double surface_distance(double phi_liquid, double phi_air) {
  return std::max(phi_liquid / (phi_liquid - phi_air), 1e-8);
}

template <int Dim>
double link_lightness(const ProjectionInput<Dim>& in, Site cell, Site across) {
  if (in.is_parted(cell) || in.is_parted(across)) return 1;
  if (in.is_liquid(cell) == in.is_liquid(across)) return in.is_liquid(cell) ? 1 : in.density / in.gas_density;
  const double theta = in.is_liquid(cell) ? surface_distance(in.phi[cell], in.phi[across])
                                          : surface_distance(in.phi[across], in.phi[cell]);
  return 1 / (theta + (1 - theta) * in.gas_density / in.density);
}

template <int Dim>
double cell_lightness(const ProjectionInput<Dim>& in, Site cell) {
  return in.has_gas() && !in.is_liquid(cell) ? in.density / in.gas_density : 1;
}

template <int Dim>
double jump_over(const ProjectionInput<Dim>& in, int axis, Site face) {
  const bool low = in.is_liquid(face - in.layout.stride(axis)), high = in.is_liquid(face);
  if (!in.surface_jump || low == high) return 0;
  return (low ? 1 : -1) * in.surface_jump->at(axis, face);
}

namespace {

template <int Dim>
bool touches_unknown(const ProjectionInput<Dim>& in, Site cell) {
  bool any = false;
  for_each_face_of(in.layout, cell, [&](int a, Site f, int, Site) { any = any || in.faces.is_unknown(a, f); });
  return any;
}

// w rho/rho_f of a face with an unknown velocity, seen from the row's cell, and what the cell's pressure is above that
// across where both balance; `fixed_pressure` is set where no row is across.
struct Link {
  double weight = 0, jump = 0;
  bool fixed_pressure = false;
};

template <int Dim>
Link link_across(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, int axis, Site face, Site cell,
                 Site across) {
  const double w = in.faces.open.at(axis, face);
  if (in.faces.kind_at(axis, face) == FaceKind::outflow) return {w / 0.5 * cell_lightness(in, cell), 0, true};
  return {w * link_lightness(in, cell, across), (cell == face ? -1 : 1) * jump_over(in, axis, face),
          rows.row[across] < 0};
}

// Net volume flux out of a cell a unit of face area.
template <int Dim>
double net_flux(const ProjectionInput<Dim>& in, Site cell, const FaceField<Dim>& u) {
  double sum = in.faces.cell_flux[cell];
  for_each_face_of(in.layout, cell, [&](int a, Site f, int sign, Site) {
    const bool given = in.faces.kind_at(a, f) == FaceKind::prescribed;
    const double v = given ? in.faces.prescribed.at(a, f) : u.at(a, f);
    sum += sign * (in.faces.open.at(a, f) * v + in.faces.closed_flux.at(a, f));
  });
  return sum;
}

}  // namespace

template <int Dim>
PressureRows<Dim> number_rows(const ProjectionInput<Dim>& in) {
  PressureRows<Dim> rows;
  rows.row = CellField<Dim, std::int64_t>(in.layout, -1);
  std::int64_t isolated = 0;
  for_each_index_in_order(in.layout, in.layout.cells(), [&](Site s, const IVec<Dim>&) {
    if (!(in.is_liquid(s) || in.has_gas()) || in.is_parted(s)) return;
    if (touches_unknown(in, s))
      rows.cells.push_back(s);
    else if (in.is_liquid(s))
      ++isolated;
  });
  const std::int64_t count = std::int64_t(rows.cells.size());
  rows.first = in.ranks.exclusive_prefix_sum(count);
  rows.global = in.ranks.global_sum(count);
  rows.isolated = in.ranks.global_sum(isolated);
  for (std::int64_t n = 0; n < count; ++n) rows.row[rows.cells[n]] = rows.first + n;
  in.halo.fill_ghosts({rows.row.data()});
  return rows;
}

template <int Dim>
DistributedMatrix assemble_pressure_matrix(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows) {
  DistributedMatrix m;
  m.first_row = rows.first;
  m.global_rows = rows.global;
  m.column.reserve(rows.cells.size() * (2 * Dim + 1));
  m.value.reserve(rows.cells.size() * (2 * Dim + 1));
  for (Site cell : rows.cells) {
    const std::size_t diagonal = m.value.size();
    m.column.push_back(rows.row[cell]);
    m.value.push_back(0);
    for_each_face_of(in.layout, cell, [&](int a, Site f, int, Site across) {
      if (!in.faces.is_unknown(a, f)) return;
      const Link link = link_across(in, rows, a, f, cell, across);
      m.value[diagonal] += link.weight;
      if (link.fixed_pressure) return;
      m.column.push_back(rows.row[across]);
      m.value.push_back(-link.weight);
    });
    m.row_start.push_back(int(m.value.size()));
  }
  return m;
}

template <int Dim>
std::vector<double> pressure_right_side(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                        const FaceField<Dim>& u) {
  const double scale = in.density * in.layout.h() / in.dt;
  std::vector<double> b(rows.cells.size());
  for (std::size_t n = 0; n < b.size(); ++n) {
    const Site cell = rows.cells[n];
    b[n] = -scale * (net_flux(in, cell, u) + in.missing_flux(cell));
    for_each_face_of(in.layout, cell, [&](int a, Site f, int, Site across) {
      if (!in.faces.is_unknown(a, f)) return;
      const Link link = link_across(in, rows, a, f, cell, across);
      const bool leaves = in.faces.kind_at(a, f) == FaceKind::outflow;
      b[n] += link.weight * (link.jump + (leaves ? in.faces.side_pressure.at(a, f) : 0));
    });
  }
  return b;
}

template <int Dim>
double face_pressure_slope(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                           const CellField<Dim>& pressure, int axis, Site face) {
  const Site low = face - in.layout.stride(axis), high = face;
  const double scale = 1 / (in.density * in.layout.h());
  const bool has_low = rows.row[low] >= 0, has_high = rows.row[high] >= 0;
  if (!has_low && !has_high) return 0;
  const double p_low = has_low ? pressure[low] : 0, p_high = has_high ? pressure[high] : 0;
  if (in.faces.kind_at(axis, face) == FaceKind::outflow) {
    const double beyond = in.faces.side_pressure.at(axis, face), over = scale / 0.5;
    return has_low ? over * cell_lightness(in, low) * (beyond - p_low)
                   : over * cell_lightness(in, high) * (p_high - beyond);
  }
  return scale * link_lightness(in, low, high) * (p_high - p_low + jump_over(in, axis, face));
}

template <int Dim>
RowGrid row_grid(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows) {
  RowGrid g;
  g.dimension = Dim;
  for (int a = 0; a < Dim; ++a) {
    g.lower[a] = in.layout.cells().lower[a];
    g.upper[a] = in.layout.cells().upper[a];
    g.periodic[a] = in.layout.geometry().periodic[a] ? in.layout.geometry().cells[a] : 0;
  }
  g.row_of_cell.reserve(std::size_t(in.layout.cells().size()));
  for_each_index_in_order(in.layout, in.layout.cells(), [&](Site s, const IVec<Dim>&) {
    g.row_of_cell.push_back(rows.row[s] < 0 ? -1 : int(rows.row[s] - rows.first));
  });
  return g;
}

template <int Dim>
double max_divergence(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& u) {
  double largest = 0;
  for (Site cell : rows.cells) largest = std::max(largest, std::abs(net_flux(in, cell, u) + in.missing_flux(cell)));
  return in.ranks.global_max(largest) / in.layout.h();
}

template <int Dim>
VolumeMismatch worst_mismatch(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const NullSpace& closed) {
  std::vector<double> net(closed.count), scale(closed.count);
  const FaceField<Dim> still(in.layout);
  for (std::size_t n = 0; n < rows.cells.size(); ++n) {
    const int c = closed.component[n];
    if (c < 0) continue;
    net[c] += net_flux(in, rows.cells[n], still);
    for_each_face_of(in.layout, rows.cells[n], [&](int a, Site f, int, Site) {
      const double given = in.faces.open.at(a, f) * in.faces.prescribed.at(a, f) + in.faces.closed_flux.at(a, f);
      scale[c] += std::abs(given);
    });
  }
  in.ranks.global_sum(net);
  in.ranks.global_sum(scale);
  VolumeMismatch worst;
  for (int c = 0; c < closed.count; ++c)
    if (std::abs(net[c]) * std::max(worst.scale, 1e-300) >= std::abs(worst.net) * scale[c] && std::abs(net[c]) > 0)
      worst = {net[c], scale[c]};
  const double area = in.layout.geometry().face_area();
  return {worst.net * area, worst.scale * area};
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template double link_lightness<D>(const ProjectionInput<D>&, Site, Site);                                           \
  template double cell_lightness<D>(const ProjectionInput<D>&, Site);                                                 \
  template double jump_over<D>(const ProjectionInput<D>&, int, Site);                                                 \
  template PressureRows<D> number_rows<D>(const ProjectionInput<D>&);                                                 \
  template DistributedMatrix assemble_pressure_matrix<D>(const ProjectionInput<D>&, const PressureRows<D>&);          \
  template std::vector<double> pressure_right_side<D>(const ProjectionInput<D>&, const PressureRows<D>&,              \
                                                      const FaceField<D>&);                                           \
  template double face_pressure_slope<D>(const ProjectionInput<D>&, const PressureRows<D>&, const CellField<D>&, int, \
                                         Site);                                                                       \
  template RowGrid row_grid<D>(const ProjectionInput<D>&, const PressureRows<D>&);                                    \
  template double max_divergence<D>(const ProjectionInput<D>&, const PressureRows<D>&, const FaceField<D>&);          \
  template VolumeMismatch worst_mismatch<D>(const ProjectionInput<D>&, const PressureRows<D>&, const NullSpace&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
