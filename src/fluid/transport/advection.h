#pragma once
// Semi-Lagrangian transport: interpolates values at departure points.
#include "grid/fields.h"

namespace seiche {

// Velocity at x from the staggered field, each component by four-point Lagrange interpolation (m/s).
template <int Dim>
Vec<Dim> sample_velocity(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& x);

// Departure point of x in the frozen field u by the explicit midpoint rule, x - dt u(x - dt/2 u(x)). at_x: u(x).
template <int Dim>
Vec<Dim> trace_midpoint(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& at_x, const Vec<Dim>& x,
                        double dt);

// The same by Heun's third-order rule, x - dt/4 (u + 3 u(x - 2/3 dt u(x - 1/3 dt u))). In a flow that rotates by the
// angle a per step, the midpoint rule has an angular error of a^3/6.
template <int Dim>
Vec<Dim> trace_third_order(const Layout<Dim>& layout, const FaceField<Dim>& u, const Vec<Dim>& at_x, const Vec<Dim>& x,
                           double dt);

// Departure point of a face (index i) over dt, by the midpoint rule.
template <int Dim>
Vec<Dim> departure_of_face(const Layout<Dim>& layout, const FaceField<Dim>& u, int axis, Site face, const IVec<Dim>& i,
                           double dt);

enum class Trace { midpoint, third_order };

struct LevelSetTransport {
  Trace trace = Trace::midpoint;
  bool one_sided_at_medial_axis =
      true;  // one-sided interpolation at the medial axis, in the middle of threads and gaps
};

// moved(x) = phi(departure point), fourth order, at the owned cells with |phi| < band; the others keep phi(x). Ghosts
// of phi and u must be filled. Local.
template <int Dim>
void advect_level_set(const Layout<Dim>& layout, const FaceField<Dim>& u, double dt, double band,
                      const CellField<Dim>& phi, CellField<Dim>& moved, const LevelSetTransport& how = {});

// Number of Lagrange points along each axis. Six points reach one cell farther.
enum class Interpolation { four_points, six_points };

// Sets result(f) at the owned faces with near[f]. If interior[f] is set, it is inner(departure point), interpolated
// with the given number of points; else outer(departure point) with four points. Other faces keep their value. Local.
template <int Dim>
void advect_faces(const Layout<Dim>& layout, const FaceField<Dim>& path, double dt, const FaceField<Dim, char>& near,
                  const FaceField<Dim, char>& interior, const FaceField<Dim>& inner, const FaceField<Dim>& outer,
                  FaceField<Dim>& result, Interpolation interpolation = Interpolation::four_points);

}  // namespace seiche
