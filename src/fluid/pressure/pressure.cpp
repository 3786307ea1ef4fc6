#include "fluid/pressure/pressure.h"

#include "linalg/core/matrix_entries.h"

namespace seiche {

double surface_distance(double phi_liquid, double phi_air) {
  return std::max(phi_liquid / (phi_liquid - phi_air), 1e-8);
}

double liquid_part(double phi_low, double phi_high) {
  if ((phi_low < 0) == (phi_high < 0)) return phi_low < 0 ? 1 : 0;
  return phi_low < 0 ? surface_distance(phi_low, phi_high) : surface_distance(phi_high, phi_low);
}

template <int Dim>
double inverse_density_ratio_of_link(const ProjectionInput<Dim>& in, Site cell, Site across) {
  const double theta = liquid_part(in.phi[cell], in.phi[across]);
  return 1 / (theta + (1 - theta) * in.gas_density / in.density);
}

template <int Dim>
double inverse_density_ratio_of_cell(const ProjectionInput<Dim>& in, Site cell) {
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

// Link of a row's cell across a face with unknown velocity.
struct Link {
  double weight = 0, jump = 0;  // w rho/rho_f; pressure of the cell minus that across in equilibrium, Pa
  bool fixed_pressure = false;  // true if there is no row across
};

template <int Dim>
Link link_across(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, int axis, Site face, Site cell,
                 Site across) {
  const double w = in.faces.open.at(axis, face);
  if (in.faces.kind_at(axis, face) == FaceKind::outflow)
    return {w / 0.5 * in.entry_factor(axis, face) * inverse_density_ratio_of_cell(in, cell), 0, true};
  return {w * inverse_density_ratio_of_link(in, cell, across), (cell == face ? -1 : 1) * jump_over(in, axis, face),
          rows.row[across] < 0};
}

// Net volume flux out of each row's cells, per face area (m/s).
template <int Dim>
std::vector<double> net_fluxes(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& u) {
  return net_over_rows(
      in.layout, in.ranks, rows, [&](Site cell) { return in.faces.cell_flux[cell]; },
      [&](int a, Site f) {
        const bool given = in.faces.kind_at(a, f) == FaceKind::prescribed;
        const double v = given ? in.faces.prescribed.at(a, f) : u.at(a, f);
        return in.faces.open.at(a, f) * v + in.faces.closed_flux.at(a, f);
      });
}

// Numbers the rows of the regions of air after those of the cells.
template <int Dim>
void number_air(const ProjectionInput<Dim>& in, PressureRows<Dim>& rows) {
  rows.air = in.air;
  std::vector<double> row(in.air->volume.size());
  for (std::size_t n = 0; n < in.air->home.size(); ++n)
    row[std::size_t(in.air->home[n].first)] = double(rows.first) + double(rows.liquid + n);
  in.ranks.global_sum(row);
  rows.air_row.assign(row.begin(), row.end());
  for_each_site(in.layout, in.layout.cells(), [&](Site c) {
    if (const std::int64_t k = in.air->label[c]; k >= 0) rows.row[c] = rows.air_row[std::size_t(k)];
  });
}

}  // namespace

template <int Dim>
PressureRows<Dim> number_rows(const ProjectionInput<Dim>& in) {
  PressureRows<Dim> rows;
  rows.row = CellField<Dim, std::int64_t>(in.layout, PressureRows<Dim>::no_row);
  std::int64_t isolated = 0;
  for_each_index_in_order(in.layout, in.layout.cells(), [&](Site s, const IVec<Dim>&) {
    if (!(in.is_liquid(s) || in.has_gas())) return;
    if (in.is_separated(s))
      rows.row[s] = PressureRows<Dim>::separated_row;
    else if (touches_unknown(in, s))
      rows.cells.push_back(s);
    else if (in.is_liquid(s))
      ++isolated;
  });
  rows.liquid = rows.cells.size();
  if (in.air)
    for (const auto& [region, cell] : in.air->home) rows.cells.push_back(cell);
  const std::int64_t count = std::int64_t(rows.cells.size());
  rows.first = in.ranks.exclusive_prefix_sum(count);
  rows.global = in.ranks.global_sum(count);
  rows.isolated = in.ranks.global_sum(isolated);
  for (std::size_t n = 0; n < rows.liquid; ++n) rows.row[rows.cells[n]] = rows.first + Row(n);
  if (in.air) number_air(in, rows);
  in.halo.fill_ghosts({rows.row.data()});
  return rows;
}

namespace {

// Position of a column at or after `from`, or the end. A cell may touch the same region of air across several faces.
std::size_t find_column(const DistributedMatrix& m, std::size_t from, Row column) {
  return std::size_t(std::find(m.column.begin() + std::ptrdiff_t(from), m.column.end(), column) - m.column.begin());
}

// Appends the rows of the regions of air. Off-diagonal entries come from links; the diagonal is minus their sum.
template <int Dim>
void append_air_rows(const PressureRows<Dim>& rows, const std::vector<MatrixEntry>& links, DistributedMatrix& m) {
  auto next = links.begin();
  for (std::size_t n = rows.liquid; n < rows.cells.size(); ++n) {
    const std::size_t diagonal = m.value.size();
    m.column.push_back(rows.first + Row(n));
    m.value.push_back(0);
    for (; next != links.end() && next->row == rows.first + Row(n); ++next) {
      m.column.push_back(next->column);
      m.value.push_back(next->value);
      m.value[diagonal] -= next->value;
    }
    m.row_start.push_back(int(m.value.size()));
  }
}

}  // namespace

template <int Dim>
DistributedMatrix assemble_pressure_matrix(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows) {
  DistributedMatrix m;
  m.first_row = rows.first;
  m.global_rows = rows.global;
  m.column.reserve(rows.cells.size() * (2 * Dim + 1));
  m.value.reserve(rows.cells.size() * (2 * Dim + 1));
  std::vector<MatrixEntry> of_air;
  for (std::size_t n = 0; n < rows.liquid; ++n) {
    const Site cell = rows.cells[n];
    const std::size_t diagonal = m.value.size();
    m.column.push_back(rows.row[cell]);
    m.value.push_back(0);
    for_each_face_of(in.layout, cell, [&](int a, Site f, int, Site across) {
      if (!in.faces.is_unknown(a, f)) return;
      const Link link = link_across(in, rows, a, f, cell, across);
      m.value[diagonal] += link.weight;
      if (link.fixed_pressure) return;
      std::size_t place = m.column.size();
      if (rows.region(across) >= 0) {
        of_air.push_back({rows.row[across], rows.row[cell], -link.weight});
        place = find_column(m, diagonal, rows.row[across]);
      }
      if (place == m.column.size()) m.column.push_back(rows.row[across]), m.value.push_back(0);
      m.value[place] -= link.weight;
    });
    m.row_start.push_back(int(m.value.size()));
  }
  if (rows.air) append_air_rows(rows, send_to_owner(of_air, rows.first, rows.cells.size(), in.ranks), m);
  return m;
}

template <int Dim>
std::vector<double> pressure_right_side(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                        const FaceField<Dim>& u) {
  const double scale = in.density * in.layout.h() / in.dt;
  std::vector<double> b = net_fluxes(in, rows, u), of_air(rows.air_row.size());
  for (std::size_t n = 0; n < rows.liquid; ++n) {
    const Site cell = rows.cells[n];
    b[n] = -scale * (b[n] + in.missing_flux(cell));
    for_each_face_of(in.layout, cell, [&](int a, Site f, int, Site across) {
      if (!in.faces.is_unknown(a, f)) return;
      const Link link = link_across(in, rows, a, f, cell, across);
      const bool leaves = in.faces.kind_at(a, f) == FaceKind::outflow;
      b[n] += link.weight * (link.jump + (leaves ? in.faces.side_pressure.at(a, f) : 0));
      if (const std::int64_t k = rows.region(across); k >= 0) of_air[std::size_t(k)] -= link.weight * link.jump;
    });
  }
  if (of_air.empty()) return b;
  in.ranks.global_sum(of_air);
  for (std::size_t n = rows.liquid; n < b.size(); ++n)
    b[n] = of_air[std::size_t(rows.region(rows.cells[n]))] - scale * (b[n] + missing_flux(in, rows, n));
  return b;
}

template <int Dim>
double face_pressure_slope(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                           const CellField<Dim>& pressure, int axis, Site face) {
  const Site low = face - in.layout.stride(axis), high = face;
  const double scale = 1 / (in.density * in.layout.h());
  const bool has_low = rows.row[low] >= 0, has_high = rows.row[high] >= 0;
  if (!rows.touch_pressure(low, high)) return 0;
  const double p_low = has_low ? pressure[low] : 0, p_high = has_high ? pressure[high] : 0;
  if (in.faces.kind_at(axis, face) == FaceKind::outflow) {
    const double beyond = in.faces.side_pressure.at(axis, face), over = scale / 0.5 * in.entry_factor(axis, face);
    return rows.has_pressure(low) ? over * inverse_density_ratio_of_cell(in, low) * (beyond - p_low)
                                  : over * inverse_density_ratio_of_cell(in, high) * (p_high - beyond);
  }
  return scale * inverse_density_ratio_of_link(in, low, high) * (p_high - p_low + jump_over(in, axis, face));
}

// One Jacobi step on the rows of the air: (sum of weights) p_air = sum of weight p + right side. Jumps are part of the
// right side.
template <int Dim>
void equalise_air_pressure(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& u_star,
                           CellField<Dim>& pressure) {
  if (!rows.air) return;
  const std::size_t count = rows.air_row.size();
  const Vector b = pressure_right_side(in, rows, u_star);
  std::vector<double> sums(2 * count);
  for (std::size_t n = rows.liquid; n < b.size(); ++n) sums[std::size_t(rows.region(rows.cells[n]))] = b[n];
  for (std::size_t n = 0; n < rows.liquid; ++n)
    for_each_face_of(in.layout, rows.cells[n], [&](int a, Site f, int, Site across) {
      const std::int64_t k = rows.region(across);
      if (k < 0 || !in.faces.is_unknown(a, f)) return;
      const double weight = link_across(in, rows, a, f, rows.cells[n], across).weight;
      sums[std::size_t(k)] += weight * pressure[rows.cells[n]];
      sums[count + std::size_t(k)] += weight;
    });
  in.ranks.global_sum(sums);
  for_each_site(in.layout, in.layout.cells(), [&](Site c) {
    const std::int64_t k = rows.region(c);
    if (k >= 0 && sums[count + std::size_t(k)] > 0) pressure[c] = sums[std::size_t(k)] / sums[count + std::size_t(k)];
  });
  in.halo.fill_ghosts(pressure);
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
    g.row_of_cell.push_back(rows.has_own(s) ? int(rows.row[s] - rows.first) : -1);
  });
  return g;
}

template <int Dim>
double max_divergence(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& u) {
  const std::vector<double> flux = net_fluxes(in, rows, u);
  double largest = 0;
  for (std::size_t n = 0; n < flux.size(); ++n)
    largest = std::max(largest, std::abs(flux[n] + missing_flux(in, rows, n)));
  return in.ranks.global_max(largest) / in.layout.h();
}

namespace {

// Sum of |prescribed flux| over the faces of each row's cells, per face area (m/s).
template <int Dim>
std::vector<double> given_sizes(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows) {
  const auto of_cell = [&](Site cell) {
    double sum = std::abs(in.faces.cell_flux[cell]);
    for_each_face_of(in.layout, cell, [&](int a, Site f, int, Site) {
      sum += std::abs(in.faces.open.at(a, f) * in.faces.prescribed.at(a, f) + in.faces.closed_flux.at(a, f));
    });
    return sum;
  };
  return net_over_rows(in.layout, in.ranks, rows, of_cell, [](int, Site) { return 0.0; });
}

}  // namespace

template <int Dim>
VolumeMismatch worst_mismatch(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const NullSpace& closed) {
  std::vector<double> net(closed.count), scale(closed.count);
  const FaceField<Dim> still(in.layout);
  const std::vector<double> flux = net_fluxes(in, rows, still), size = given_sizes(in, rows);
  for (std::size_t n = 0; n < rows.cells.size(); ++n) {
    const int c = closed.component[n];
    if (c < 0) continue;
    net[c] += flux[n];
    scale[c] += size[n];
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
  template double inverse_density_ratio_of_link<D>(const ProjectionInput<D>&, Site, Site);                            \
  template double inverse_density_ratio_of_cell<D>(const ProjectionInput<D>&, Site);                                  \
  template double jump_over<D>(const ProjectionInput<D>&, int, Site);                                                 \
  template PressureRows<D> number_rows<D>(const ProjectionInput<D>&);                                                 \
  template DistributedMatrix assemble_pressure_matrix<D>(const ProjectionInput<D>&, const PressureRows<D>&);          \
  template std::vector<double> pressure_right_side<D>(const ProjectionInput<D>&, const PressureRows<D>&,              \
                                                      const FaceField<D>&);                                           \
  template double face_pressure_slope<D>(const ProjectionInput<D>&, const PressureRows<D>&, const CellField<D>&, int, \
                                         Site);                                                                       \
  template void equalise_air_pressure<D>(const ProjectionInput<D>&, const PressureRows<D>&, const FaceField<D>&,      \
                                         CellField<D>&);                                                              \
  template RowGrid row_grid<D>(const ProjectionInput<D>&, const PressureRows<D>&);                                    \
  template double max_divergence<D>(const ProjectionInput<D>&, const PressureRows<D>&, const FaceField<D>&);          \
  template VolumeMismatch worst_mismatch<D>(const ProjectionInput<D>&, const PressureRows<D>&, const NullSpace&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
