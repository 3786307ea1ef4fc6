#include "coupling/step_geometry.h"

#include "grid/loops.h"
#include "levelset/fractions.h"

namespace seiche {
namespace {

constexpr double far_away = 1e30;
constexpr double snap = 1e-3;  // cells: nodes nearer than this to a solid count as on it, so that no sliver faces arise

// Farthest node from the pivot, among those of the whole domain that lie in the body at rest.
template <int Dim>
double surface_radius(const Layout<Dim>& layout, const Body<Dim>& body) {
  const Geometry<Dim>& g = layout.geometry();
  const Vec3 pivot = body.pose(0).pivot;
  const int step = std::max(1, g.cells.maxCoeff() / 64);
  const IVec<Dim> count = (g.cells.array() / step + 1).matrix();
  double radius = 0;
  for (int n = 0; n < count.prod(); ++n) {
    int rest = n;
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a, rest /= count[a - 1]) x[a] = g.lower[a] + g.h * step * (rest % count[a]);
    if (body.distance_at_rest(x) < step * g.h) radius = std::max(radius, (extend<Dim>(x) - pivot).norm() + step * g.h);
  }
  return radius;
}

}  // namespace

template <int Dim>
SolidGeometry<Dim>::SolidGeometry(const Layout<Dim>& layout, const Sides<Dim>& sides,
                                  const std::vector<Body<Dim>>& bodies)
    : layout_(layout), sides_(sides), bodies_(bodies) {
  still_.psi = NodeField<Dim>(layout, far_away);
  still_.body = NodeField<Dim, std::int16_t>(layout, -1);
  still_.faces = FaceGeometry<Dim>(layout);
  still_.twists.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    any_moves_ = any_moves_ || bodies[k].moves();
    radius_.push_back(bodies[k].moves() ? surface_radius(layout, bodies[k]) : 0);
    if (!bodies[k].moves()) measure_distances(bodies[k], std::int16_t(k), Pose{}, still_);
  }
  if (!bodies.empty()) close_faces(still_);
}

template <int Dim>
void SolidGeometry<Dim>::measure_distances(const Body<Dim>& body, std::int16_t index, const Pose& pose,
                                           StepGeometry<Dim>& g) const {
  for_each_index_in_order(layout_, layout_.padded(), [&](Site s, const IVec<Dim>& i) {
    const double d = body.distance_in(pose, layout_.position(i, node_offset<Dim>()));
    if (d >= g.psi[s]) return;
    g.psi[s] = d;
    g.body[s] = index;
  });
}

template <int Dim>
StepGeometry<Dim> SolidGeometry<Dim>::measure(double t0, double t1) const {
  StepGeometry<Dim> g = still_;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (!bodies_[k].moves()) continue;
    g.twists[k] = bodies_[k].twist(t0, t1);
    measure_distances(bodies_[k], std::int16_t(k), bodies_[k].pose(t1), g);
  }
  if (any_moves_) close_faces(g);
  set_sides(t1, g);
  return g;
}

// closed flux = sum_k s_k v_k(face centre) . e, s_k the share of the face that body k closes.
template <int Dim>
void SolidGeometry<Dim>::close_faces(StepGeometry<Dim>& g) const {
  for_each_site(layout_, layout_.padded(), [&](Site s) {
    if (std::abs(g.psi[s]) < snap * layout_.h()) g.psi[s] = 0;
  });
  open_fractions(layout_, g.psi, g.faces.open);
  for (int a = 0; a < Dim; ++a) {
    Box<Dim> box = layout_.grown(2);
    for (int b = 0; b < Dim; ++b) box.upper[b] = std::min(box.upper[b], layout_.padded().upper[b] - 1);
    for_each_index(layout_, box, [&](Site s, const IVec<Dim>& i) {
      g.faces.kind.at(a, s) = char(g.faces.open.at(a, s) == 0 ? FaceKind::closed : FaceKind::open);
      if (g.faces.open.at(a, s) == 1) return;
      const Vec3 x = extend<Dim>(layout_.position(i, face_offset<Dim>(a)));
      double flux = 0;
      for_each_closing_body(layout_, g, a, s, [&](int k, double share) { flux += share * g.twists[k].at(x)[a]; });
      g.faces.closed_flux.at(a, s) = flux;
    });
  }
}

template <int Dim>
void SolidGeometry<Dim>::set_sides(double t, StepGeometry<Dim>& g) const {
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2 && !layout_.geometry().periodic[a]; ++side) {
      Box<Dim> box = layout_.grown(2);
      const int edge = side == 0 ? 0 : layout_.geometry().cells[a];
      box.lower[a] = std::max(box.lower[a], edge);
      box.upper[a] = std::min(box.upper[a], edge + 1);
      for_each_index_in_order(layout_, box, [&](Site s, const IVec<Dim>& i) {
        if (g.faces.kind_at(a, s) == FaceKind::closed) return;
        const Vec<Dim> x = layout_.position(i, face_offset<Dim>(a));
        const bool outflow = sides_.is_outflow(a, side);
        g.faces.kind.at(a, s) = char(outflow ? FaceKind::outflow : FaceKind::prescribed);
        if (outflow) g.faces.side_pressure.at(a, s) = sides_.pressure(a, side, x, t);
        if (!outflow) g.faces.prescribed.at(a, s) = sides_.velocity(a, side, a, x, t);
      });
    }
}

// |d1 - d0| + turn r, r the largest distance from the pivot at which the body's surface stands in the domain.
template <int Dim>
double SolidGeometry<Dim>::largest_displacement(double t0, double t1) const {
  double largest = 0;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Twist v = bodies_[k].twist(t0, t1);
    largest = std::max(largest, (t1 - t0) * (v.linear.norm() + v.angular.norm() * radius_[k]));
  }
  return largest;
}

template struct StepGeometry<2>;
template struct StepGeometry<3>;
template class SolidGeometry<2>;
template class SolidGeometry<3>;

}  // namespace seiche
