#include "coupling/step/side_flow.h"

#include <algorithm>

#include "coupling/step/step.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {
template <int Dim>
double net_inflow(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const CellField<Dim>& phi,
                  const FaceField<Dim>& u) {
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    for (int side : {0, 1})
      for_each_index_in_order(domain.layout, faces_of_side(domain.layout, a, side), [&](Site f, const IVec<Dim>&) {
        const Site inside = side == 0 ? f : f - domain.layout.stride(a);
        const double inward = (side == 0 ? 1 : -1) * g.faces.open.at(a, f) * u.at(a, f);
        const bool fed = domain.sides.type(a, side) == SideType::inflow && inward > 0;
        const double share = std::clamp(0.5 - phi[inside] / domain.layout.h(), 0.0, 1.0);
        sum += inward * (fed ? 1 : share);
      });
  return domain.ranks.global_sum(sum) * domain.layout.geometry().face_area();
}

template <int Dim>
void find_entering(const Domain<Dim>& domain, const FaceField<Dim>& u, FaceGeometry<Dim>& faces) {
  const Layout<Dim>& layout = domain.layout;
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1}) {
      if (!domain.sides.is_outflow(a, side)) continue;
      for_each_index_in_order(layout, padded_faces_of_side(layout, a, side), [&](Site f, const IVec<Dim>&) {
        const double inward = side == 0 ? u.at(a, f) : -u.at(a, f);
        if (faces.kind_at(a, f) == FaceKind::outflow && inward > 0) faces.entering.set(a, f, inward);
      });
    }
}

template <int Dim>
void brake_entering(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, double dt, FaceField<Dim>& u_star) {
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1})
      for_each_index_in_order(domain.layout, faces_of_side(domain.layout, a, side), [&](Site f, const IVec<Dim>&) {
        u_star.at(a, f) *= faces.entry_factor(a, f, dt / domain.layout.h());
      });
}

template <int Dim>
void book_first_flow(const Setup<Dim>& s, const State<Dim>& start, const StepGeometry<Dim>& geometry, double dt,
                     Phases& phases, State<Dim>& end) {
  if (!s.domain.sides.any_passes() || s.tracks_volume()) return;
  constexpr double next_to_nothing = 1e-3;  // of the step; the mean errs by this share of what forces do in it
  const std::vector<std::string> told = phases.warnings;
  const Attempt<Dim> at_once = attempt_step(s, start, next_to_nothing * dt, phases);
  phases.warnings = told;
  if (!at_once.failure.empty()) return;
  const auto inflow = [&](const FaceField<Dim>& u) { return net_inflow(s.domain, geometry, start.phi, u); };
  const double lead = dt - end.since_solve, share = 0.5 * lead / dt;
  end.expected_volume +=
      lead * ((1 - share) * inflow(at_once.state.now->u) + share * inflow(end.now->u) - inflow(start.now->u));
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template double net_inflow<D>(const Domain<D>&, const StepGeometry<D>&, const CellField<D>&, const FaceField<D>&); \
  template void find_entering<D>(const Domain<D>&, const FaceField<D>&, FaceGeometry<D>&);                           \
  template void brake_entering<D>(const Domain<D>&, const FaceGeometry<D>&, double, FaceField<D>&);                  \
  template void book_first_flow<D>(const Setup<D>&, const State<D>&, const StepGeometry<D>&, double, Phases&,        \
                                   State<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
