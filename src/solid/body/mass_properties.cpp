#include "solid/body/mass_properties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/error.h"
#include "geometry/shapes/closed_surface.h"
#include "geometry/shapes/makers.h"

namespace seiche {
namespace {

using Matrix = Eigen::Matrix3d;

// Volume, centre and second moments  C = int (x - c)(x - c)' dV  of a shape. C determines the inertia and is easily
// scaled and rotated. Components along z are zero in 2D.
struct Moments {
  double volume = 0;
  Vec3 center{0, 0, 0};
  Matrix second = Matrix::Zero();
};

[[noreturn]] void fail(const ShapeSpec& spec, const std::string& message) {
  throw Error(ExitCode::bad_input, (spec.where.empty() ? "" : spec.where + ": ") + message);
}

// C = V e^2 / 12 along each edge e.
template <int Dim>
Moments box_moments(const ShapeSpec& s) {
  Moments m{1, 0.5 * (s.lower + s.upper), Matrix::Zero()};
  const Vec3 edges = s.upper - s.lower;
  for (int a = 0; a < Dim; ++a) m.volume *= edges[a];
  for (int a = 0; a < Dim; ++a) m.second(a, a) = m.volume * edges[a] * edges[a] / 12;
  if (Dim == 2) m.center[2] = 0;
  return m;
}

// Moments of a body of revolution (2D: a body symmetric about an axis): C = along a a' + across (1 - a a').
template <int Dim>
Moments about_axis(const ShapeSpec& s, double volume, double along, double across) {
  const Vec<Dim> from = truncate<Dim>(s.from), to = truncate<Dim>(s.to);
  const double length = (to - from).norm();
  Vec<Dim> a = Vec<Dim>::Unit(0);
  if (length > 0) a = (to - from) / length;
  Moments m{volume, extend<Dim>(Vec<Dim>(0.5 * (from + to))), Matrix::Zero()};
  const Eigen::Matrix<double, Dim, Dim> axial = a * a.transpose();
  m.second.template topLeftCorner<Dim, Dim>() =
      along * axial + across * (Eigen::Matrix<double, Dim, Dim>::Identity() - axial);
  return m;
}

template <int Dim>
double axis_length(const ShapeSpec& s) {
  return truncate<Dim>(Vec3(s.to - s.from)).norm();
}

// A disc has C = V r^2/4 (1), a ball V r^2/5 (1).
template <int Dim>
double ball_volume(double r) {
  return Dim == 2 ? std::numbers::pi * r * r : 4 * std::numbers::pi / 3 * r * r * r;
}
template <int Dim>
double ball_second(double r) {
  return ball_volume<Dim>(r) * r * r / (Dim + 2);
}

template <int Dim>
Moments sphere_moments(const ShapeSpec& s) {
  Moments m{ball_volume<Dim>(s.radius), extend<Dim>(truncate<Dim>(s.center)), Matrix::Zero()};
  m.second.topLeftCorner<Dim, Dim>().diagonal().setConstant(ball_second<Dim>(s.radius));
  return m;
}

// Across the axis: r^2/4 in 3D (a disc), r^2/3 in 2D (a rectangle of width 2 r).
template <int Dim>
Moments cylinder_moments(const ShapeSpec& s) {
  const double l = axis_length<Dim>(s), r = s.radius;
  const double volume = Dim == 2 ? 2 * r * l : std::numbers::pi * r * r * l;
  return about_axis<Dim>(s, volume, volume * l * l / 12, volume * r * r / (Dim == 2 ? 3 : 4));
}

// A cylinder and two half balls. The centre of a half lies 3r/8 (2D: 4r/(3 pi)) beyond its flat side. Its second
// moments about the plane of the flat side are half of the ball's.
template <int Dim>
Moments capsule_moments(const ShapeSpec& s) {
  const double l = axis_length<Dim>(s), r = s.radius, ball = ball_volume<Dim>(r);
  const Moments middle = cylinder_moments<Dim>(s);
  const double offset = Dim == 2 ? 4 * r / (3 * std::numbers::pi) : 3 * r / 8;
  // int (l/2 + x)^2 over both halves
  const double ends = ball * l * l / 4 + ball * l * offset + ball_second<Dim>(r);
  const double along = middle.volume * l * l / 12 + ends;
  const double across = middle.volume * r * r / (Dim == 2 ? 3 : 4) + ball_second<Dim>(r);
  return about_axis<Dim>(s, middle.volume + ball, along, across);
}

// Integrals over the simplices between a reference point and the surface (Mirtich 1996 by the divergence theorem;
// Tonon 2004). With D = determinant of the corners relative to the reference point,
//   V = sum D/d!,  int x = sum D/(d+1)! s,  int x x' = sum D/(d+2)! (s s' + sum_i p_i p_i'),  s = sum_i p_i.
template <int Corners>
void add_simplex(const std::array<Vec3, Corners>& p, double determinant, Moments& m) {
  constexpr double d = Corners == 2 ? 2 : 6;  // d!
  Vec3 sum = Vec3::Zero();
  Matrix squares = Matrix::Zero();
  for (const Vec3& corner : p) {
    sum += corner;
    squares += corner * corner.transpose();
  }
  m.volume += determinant / d;
  m.center += determinant / (d * (Corners + 1)) * sum;
  m.second += determinant / (d * (Corners + 1) * (Corners + 2)) * (sum * sum.transpose() + squares);
}

// Converts integrals about the reference point into moments about the centre.
Moments settle(Moments m, const Vec3& reference) {
  if (!(m.volume > 0)) return m;
  m.center /= m.volume;
  m.second -= m.volume * m.center * m.center.transpose();
  m.center += reference;
  return m;
}

Vec3 mean_point(const SurfaceMesh& surface) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : surface.points) sum += p;
  return surface.points.empty() ? sum : Vec3(sum / double(surface.points.size()));
}

template <int Dim>
Moments surface_moments(const SurfaceMesh& surface) {
  const Vec3 o = mean_point(surface);  // near the body, to avoid cancellation
  const auto point = [&](int i) { return Vec3(surface.points[std::size_t(i)] - o); };
  Moments m;
  for (const auto& [i, j] : surface.segments) {
    const Vec3 a = point(i), b = point(j);
    add_simplex<2>({a, b}, a[0] * b[1] - a[1] * b[0], m);
  }
  for (const auto& [i, j, k] : surface.triangles) {
    const Vec3 a = point(i), b = point(j), c = point(k);
    add_simplex<3>({a, b, c}, a.dot(b.cross(c)), m);
  }
  return settle(m, o);
}

// Transform x -> t + R (s x): V scales as s^d, C as s^(d+2).
template <int Dim>
Moments transformed(const Moments& own, const TransformSpec& t) {
  Matrix r = Matrix::Identity();
  r.topLeftCorner<Dim, Dim>() = shape::rotation<Dim>(t.rotate);
  const double volume_scale = std::pow(t.scale, Dim);
  const Vec3 moved = extend<Dim>(truncate<Dim>(t.translate)) + r * (t.scale * own.center);
  return {own.volume * volume_scale, moved, volume_scale * t.scale * t.scale * r * own.second * r.transpose()};
}

// I = density (tr(C) 1 - C); in 2D about z only.
template <int Dim>
MassProperties with_density(const Moments& m, double density) {
  MassProperties result{density * m.volume, m.volume, m.center, Matrix::Zero()};
  const Matrix inertia = density * (m.second.trace() * Matrix::Identity() - m.second);
  if (Dim == 3) result.inertia = inertia;
  if (Dim == 2) result.inertia(2, 2) = inertia(2, 2);
  return result;
}

void require_bounded(const ShapeSpec& spec) {
  if (spec.kind == "plane") {
    fail(spec, "a rigid solid must be bounded and a plane is not; write it as a box, or make the solid static");
  }
  if (spec.invert) {
    fail(spec,
         "a rigid solid must be bounded and an inverted shape is not; drop invert, write a hollow body as a mesh"
         " or an expression (phi = \"max(outer, -inner)\"), or make the solid static");
  }
}

// Bounding box of a surface's points, enlarged by `slack`.
template <int Dim>
struct Bounds {
  Vec<Dim> lower = Vec<Dim>::Constant(INFINITY), upper = Vec<Dim>::Constant(-INFINITY);
  Bounds(const SurfaceMesh& surface, double slack) {
    for (const Vec3& p : surface.points) {
      lower = lower.cwiseMin(truncate<Dim>(p));
      upper = upper.cwiseMax(truncate<Dim>(p));
    }
    lower.array() -= slack;
    upper.array() += slack;
  }
};

// Spacing for sums over points. The error of the volume is about 1e-3 for a ball of 5 cells radius. Coarser if the
// number of points would exceed `most_points` (a second or two of a formula).
template <int Dim>
double fine_spacing(const Bounds<Dim>& bounds, double cell_size) {
  constexpr double finest = 4, most_points = 1e6;
  const double volume = (bounds.upper - bounds.lower).prod() / std::pow(cell_size, Dim);
  return cell_size / std::clamp(std::pow(most_points / volume, 1.0 / Dim), 1.0, finest);
}

// Sums over points at the given spacing. A cube about a point counts with the inside fraction 1/2 - phi/spacing: exact
// for faces normal to an axis, second order elsewhere.
template <int Dim>
Moments sampled_moments(const ShapeField<Dim>& field, const Bounds<Dim>& bounds, double spacing) {
  const Vec<Dim> count = ((bounds.upper - bounds.lower) / spacing).array().ceil();
  const Vec3 middle = extend<Dim>(Vec<Dim>(0.5 * (bounds.lower + bounds.upper)));  // near the body
  const double cube = std::pow(spacing, Dim);
  Moments m;
  for (long long n = 0, end = std::llround(count.prod()); n < end; ++n) {
    Vec<Dim> x = bounds.lower;
    long long rest = n;
    for (int a = 0; a < Dim; rest /= std::llround(count[a++]))
      x[a] += (double(rest % std::llround(count[a])) + 0.5) * spacing;
    const double share = cube * std::clamp(0.5 - field(x) / spacing, 0.0, 1.0);
    const Vec3 arm = extend<Dim>(x) - middle;
    m.volume += share;
    m.center += share * arm;
    m.second += share * arm * arm.transpose();
  }
  return settle(m, middle);
}

template <int Dim>
Moments field_moments(const ShapeSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                      const Vec<Dim>& upper) {
  const SurfaceMesh coarse = contact_surface<Dim>(spec, options, lower, upper);
  if (coarse.points.empty()) return {};
  const Bounds<Dim> bounds(coarse, options.cell_size), inside(coarse, -options.cell_size);
  if (!(inside.lower.array() >= lower.array()).all() || !(inside.upper.array() <= upper.array()).all()) {
    fail(spec, "the shape of a rigid solid must be bounded and lie within the domain; this " + spec.kind +
                   " reaches beyond it: make the domain larger or cut phi off, for example with max(phi, y-1)");
  }
  const auto field = make_shape<Dim>(spec, options);
  return sampled_moments<Dim>(*field, bounds, fine_spacing(bounds, options.cell_size));
}

template <int Dim>
struct Row {
  const char* kind;
  Moments (*moments)(const ShapeSpec&);
};
template <int Dim>
constexpr std::array<Row<Dim>, 4> closed_forms{{{"box", box_moments<Dim>},
                                                {"sphere", sphere_moments<Dim>},
                                                {"cylinder", cylinder_moments<Dim>},
                                                {"capsule", capsule_moments<Dim>}}};

template <int Dim>
Moments moments_of(const ShapeSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  for (const Row<Dim>& row : closed_forms<Dim>) {
    if (spec.kind != row.kind) continue;
    make_shape<Dim>(spec, options);  // throws for impossible sizes
    return transformed<Dim>(row.moments(spec), spec.transform);
  }
  if (spec.has_facets()) return surface_moments<Dim>(contact_surface<Dim>(spec, options, lower, upper));
  return field_moments<Dim>(spec, options, lower, upper);
}

}  // namespace

template <int Dim>
MassProperties mass_of_surface(const SurfaceMesh& surface, double density) {
  return with_density<Dim>(surface_moments<Dim>(surface), density);
}

template <int Dim>
MassProperties mass_properties(const ShapeSpec& spec, double density, const ShapeOptions& options,
                               const Vec<Dim>& lower, const Vec<Dim>& upper) {
  require_bounded(spec);
  const Moments m = moments_of<Dim>(spec, options, lower, upper);
  if (!(m.volume > 0) || !std::isfinite(m.volume)) {
    fail(spec, "the shape of the rigid solid encloses no volume that the grid could see; give it a size");
  }
  return with_density<Dim>(m, density);
}

#define SEICHE_INSTANTIATE(Dim)                                                                                \
  template MassProperties mass_of_surface<Dim>(const SurfaceMesh&, double);                                    \
  template MassProperties mass_properties<Dim>(const ShapeSpec&, double, const ShapeOptions&, const Vec<Dim>&, \
                                               const Vec<Dim>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)
#undef SEICHE_INSTANTIATE

}  // namespace seiche
