#include "coupling/transport/ripples.h"

#include <algorithm>

#include "coupling/state/fluids.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"

namespace seiche {
namespace {

constexpr int ripple_reach = 3;          // cells from closed ones
constexpr double ripple_depth = 2.5;     // cells from the surface
constexpr double slow_ripple = 0.1;      // cells a step
constexpr double ripple_strength = 0.5;  // of sqrt(g / h)

// 1 in the cells within `ripple_reach` steps along axes of a closed one. Ghosts filled.
template <int Dim>
CellField<Dim, char> cells_near(const Domain<Dim>& domain, CellField<Dim, char> marked) {
  const Layout<Dim>& layout = domain.layout;
  for (int n = 0; n < ripple_reach; ++n) {
    const CellField<Dim, char> before = marked;
    for_each_site(layout, layout.cells(), [&](Site c) {
      for (int a = 0; a < Dim; ++a)
        if (before[c - layout.stride(a)] || before[c + layout.stride(a)]) marked[c] = 1;
    });
    domain.halo.fill_ghosts({marked.data()});
  }
  return marked;
}

// 1 on the faces to brake.
template <int Dim>
FaceField<Dim, char> faces_to_brake(const Domain<Dim>& domain, const StepGeometry<Dim>& geometry,
                                    const CellField<Dim, char>& near, const CellField<Dim>& phi,
                                    const FaceField<Dim>& u, double dt) {
  const Layout<Dim>& layout = domain.layout;
  const double h = layout.h();
  FaceField<Dim, char> faces(layout);
  for (int a = 0; a < Dim; ++a) {
    for_each_site(layout, layout.faces(a), [&](Site f) {
      const Site low = f - layout.stride(a);
      const bool wet = std::min(phi[f], phi[low]) < 0 && std::max(phi[f], phi[low]) > -ripple_depth * h;
      if (wet && (near[f] || near[low]) && geometry.faces.open.at(a, f) > 0 &&
          std::abs(u.at(a, f)) * dt < slow_ripple * h)
        faces.at(a, f) = 1;
    });
    domain.halo.fill_ghosts({faces[a].data()});
  }
  return faces;
}

// (L u)_f = sum of u_n - u_f over the marked faces n beside f along all axes.
template <int Dim>
FaceField<Dim> laplacian(const Domain<Dim>& domain, const FaceField<Dim, char>& faces, const FaceField<Dim>& u) {
  const Layout<Dim>& layout = domain.layout;
  FaceField<Dim> Lu(layout);
  for (int a = 0; a < Dim; ++a) {
    for_each_marked(layout, layout.faces(a), faces[a].data(), [&](Site f) {
      for (int b = 0; b < Dim; ++b)
        for (const Site n : {f - layout.stride(b), f + layout.stride(b)})
          if (faces.at(a, n)) Lu.at(a, f) += u.at(a, n) - u.at(a, f);
    });
    domain.halo.fill_ghosts({Lu[a].data()});
  }
  return Lu;
}

}  // namespace

// u <- u - s L^2 u / (4 Dim)^2, s = dt/2 sqrt(g/h) at most 1: waves of two cells lose up to half of sqrt(g/h) a second,
// waves of n cells (2/n)^4 of that. L is symmetric, hence u loses energy.
template <int Dim>
void brake_ripples(const Domain<Dim>& domain, const Gravity& gravity, const State<Dim>& before,
                   const StepGeometry<Dim>& geometry, const CellField<Dim, char>& closed, const CellField<Dim>& phi,
                   double dt, FaceField<Dim>& u_star) {
  const Layout<Dim>& layout = domain.layout;
  const bool any = std::any_of(closed.data(), closed.data() + layout.size(), [](char c) { return c != 0; });
  if (!domain.ranks.any(any)) return;
  const double g = gravity.of_step(before.time + dt, dt).norm();
  const double strength = std::min(1.0, ripple_strength * dt * std::sqrt(g / layout.h())) / (16 * Dim * Dim);
  const FaceField<Dim, char> faces =
      faces_to_brake(domain, geometry, cells_near(domain, closed), phi, before.now->u, dt);
  fill_velocity_ghosts(layout, domain.halo, domain.sides, u_star);
  const FaceField<Dim> L2u = laplacian(domain, faces, laplacian(domain, faces, u_star));
  for (int a = 0; a < Dim; ++a)
    for_each_marked(layout, layout.faces(a), faces[a].data(),
                    [&](Site f) { u_star.at(a, f) -= strength * L2u.at(a, f); });
}

template void brake_ripples<2>(const Domain<2>&, const Gravity&, const State<2>&, const StepGeometry<2>&,
                               const CellField<2, char>&, const CellField<2>&, double, FaceField<2>&);
template void brake_ripples<3>(const Domain<3>&, const Gravity&, const State<3>&, const StepGeometry<3>&,
                               const CellField<3, char>&, const CellField<3>&, double, FaceField<3>&);

}  // namespace seiche
