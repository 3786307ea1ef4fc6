#include "fluid/pressure/separation.h"

#include "fluid/pressure/pressure.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Net volume flux out of a cell, a unit of face area, with the velocity that the pressure leaves.
template <int Dim>
double flux_after(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const CellField<Dim>& pressure,
                  const FaceField<Dim>& u_star, Site cell) {
  double sum = in.faces.cell_flux[cell];
  for_each_face_of(in.layout, cell, [&](int a, Site f, int sign, Site) {
    const bool given = in.faces.kind_at(a, f) == FaceKind::prescribed;
    const double u =
        given ? in.faces.prescribed.at(a, f) : u_star.at(a, f) - in.dt * face_pressure_slope(in, rows, pressure, a, f);
    sum += sign * (in.faces.open.at(a, f) * u + in.faces.closed_flux.at(a, f));
  });
  return sum;
}

template <int Dim>
bool touches_solid(const ProjectionInput<Dim>& in, Site cell) {
  bool any = false;
  for_each_face_of(in.layout, cell, [&](int a, Site f, int, Site) {
    any = any || in.faces.open.at(a, f) < 1 || in.faces.kind_at(a, f) == FaceKind::prescribed;
  });
  return any;
}

}  // namespace

template <int Dim>
void start_separation(const ProjectionInput<Dim>& in, Separation<Dim>& separation) {
  for_each_site(in.layout, in.layout.cells(),
                [&](Site c) { separation.separated[c] = in.phi[c] < 0 && separation.gap[c] > 0; });
  in.halo.fill_ghosts({separation.separated.data()});
}

template <int Dim>
CellField<Dim, char> cells_that_may_part(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                         const std::vector<int>& closed_component) {
  CellField<Dim, char> may = in.separation->separated;
  for (std::size_t n = 0; n < rows.cells.size(); ++n) {
    const bool closed = !closed_component.empty() && closed_component[n] >= 0;
    may[rows.cells[n]] = !closed && touches_solid(in, rows.cells[n]);
  }
  return may;
}

template <int Dim>
WrongGuesses find_wrong_guesses(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows,
                                const CellField<Dim>& pressure, const FaceField<Dim>& u_star,
                                const CellField<Dim, char>& eligible, double tolerance,
                                const Separation<Dim>& separation) {
  const Box<Dim>& cells = in.layout.cells();
  const double h = in.layout.h(), stiffness = in.density * h / in.dt;
  const double largest =
      in.ranks.global_max(local_max(in.layout, cells, 0.0, [&](Site c) { return std::abs(pressure[c]); }));
  WrongGuesses wrong;
  double worst = 0;
  for_each_index_in_order(in.layout, cells, [&](Site c, const IVec<Dim>&) {
    double error = 0;
    if (separation.separated[c])
      error = -stiffness * (flux_after(in, rows, pressure, u_star, c) + in.missing_flux(c));
    else if (eligible[c])
      error = -pressure[c];
    if (error <= tolerance * largest) return;
    wrong.cells.push_back(c);
    worst = std::max(worst, error);
  });
  wrong.count = in.ranks.global_sum(std::int64_t(wrong.cells.size()));
  if (largest > 0) wrong.worst = in.ranks.global_max(worst) / largest;
  return wrong;
}

template <int Dim>
void advance_gaps(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const CellField<Dim>& pressure,
                  const FaceField<Dim>& u_star, Separation<Dim>& separation) {
  for_each_site(in.layout, in.layout.cells(), [&](Site c) {
    const double opened = in.dt / in.layout.h() * flux_after(in, rows, pressure, u_star, c);
    separation.gap[c] = separation.separated[c] ? std::max(separation.gap[c] + opened, 0.0) : 0;
  });
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template void start_separation<D>(const ProjectionInput<D>&, Separation<D>&);                                       \
  template WrongGuesses find_wrong_guesses<D>(const ProjectionInput<D>&, const PressureRows<D>&, const CellField<D>&, \
                                              const FaceField<D>&, const CellField<D, char>&, double,                 \
                                              const Separation<D>&);                                                  \
  template CellField<D, char> cells_that_may_part<D>(const ProjectionInput<D>&, const PressureRows<D>&,               \
                                                     const std::vector<int>&);                                        \
  template void advance_gaps<D>(const ProjectionInput<D>&, const PressureRows<D>&, const CellField<D>&,               \
                                const FaceField<D>&, Separation<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
