#pragma once
// Semi-Lagrangian transport: values are looked up where the flow brought them from.
#include "grid/fields.h"

namespace seiche {

// Velocity at x from the staggered field, each component by four-point Lagrange interpolation (m/s).
template <int Dim>
Vec<Dim> sample_velocity(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& x);

// Departure point of x under the frozen field u by the explicit midpoint rule, from the velocity at x.
template <int Dim>
Vec<Dim> trace_midpoint(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& at_x, const Vec<Dim>& x,
                        double dt);

// The same by Heun's rule of third order, x - dt/4 (u + 3 u(x - 2/3 dt u(x - 1/3 dt u))): in a flow that turns by the
// angle a a step the midpoint rule leaves a^3/6 of it.
template <int Dim>
Vec<Dim> trace_third_order(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& at_x, const Vec<Dim>& x,
                           double dt);

// Where the flow brought the value of a face (index i) from in dt, by the midpoint rule.
template <int Dim>
Vec<Dim> departure_of_face(const Layout<Dim>& layout, const FaceField<Dim>& u, int axis, Site face, const IVec<Dim>& i,
                           double dt);

enum class Trace { midpoint, third_order };

struct LevelSetTransport {
  Trace trace = Trace::midpoint;
  bool one_sided_at_medial_axis = true;  // where phi has a kink, in the middle of threads and gaps
};

// phi(x) <- phi(departure point), of fourth order, at the owned cells with |phi| < band; the others keep their value.
// Ghosts of phi and u must be filled.
template <int Dim>
void advect_level_set(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, double band,
                      const CellField<Dim>& phi, CellField<Dim>& moved, const LevelSetTransport& how = {});

// Lagrange points along each axis that values at departure points come from: six reach one cell farther.
enum class Interpolation { four_points, six_points };

// At the owned faces where near[f] is set: result(f) <- inner(departure point), interpolated as asked, where
// interior[f] is set, too, else outer(departure point) by four points. The others keep their value.
template <int Dim>
void advect_faces(const Layout<Dim>& layout, const FaceField<Dim>& path, double dt, const FaceField<Dim, char>& near,
                  const FaceField<Dim, char>& interior, const FaceField<Dim>& inner, const FaceField<Dim>& outer,
                  FaceField<Dim>& result, Interpolation interpolation = Interpolation::four_points);

}  // namespace seiche
