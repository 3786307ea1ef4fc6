#include "coupling/geometry/step_geometry.h"

#include <optional>

#include "coupling/geometry/periodic_places.h"
#include "coupling/geometry/placed_solid.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"
#include "levelset/fractions.h"
#include "solid/body/elastic_motion.h"

namespace seiche {
namespace {

constexpr double far_away = 1e30;
// Tolerance in cells. Nodes nearer to a solid count as on it, and narrower gaps between two solids as closed. This
// avoids sliver faces.
constexpr double snap = 1e-3;
// Gap tolerance (cells) at seams. It is larger because contact requires 2.5e-3 cells between edges at the start.
constexpr double seam_gap = 1e-2;
constexpr int cells_around_domain = 4;  // cells around the domain within which a body counts as near it

// Bound of the distance (m) from the pivot to points of the body at rest within the domain: sampled on at most 128
// nodes per axis, plus one sample spacing.
template <int Dim>
double surface_radius(const Layout<Dim>& layout, const Body<Dim>& body) {
  if (body.radius() > 0) return body.radius();
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

double snapped(double distance, double h) {
  return std::abs(distance) < snap * h ? 0 : distance;
}

// Faces of the owned block and two layers around it whose corners are all stored.
template <int Dim>
Box<Dim> measured_faces(const Layout<Dim>& layout) {
  Box<Dim> box = layout.grown(2);
  for (int b = 0; b < Dim; ++b) box.upper[b] = std::min(box.upper[b], layout.padded().upper[b] - 1);
  return box;
}

// visit(body, share) for the static bodies at a face. The closed fraction is split in proportion to the depths of the
// corners in each body.
template <int Dim, class Visit>
void for_each_static_share(const Layout<Dim>& layout, const StepGeometry<Dim>& g, int axis, Site face,
                           const Visit& visit) {
  constexpr int corners = 1 << (Dim - 1);
  const double closed = 1 - g.faces.open.at(axis, face);
  std::array<int, corners> body;
  std::array<double, corners> depth;
  double total = 0;
  for (int k = 0; k < corners; ++k) {
    Site node = face;
    for (int b = 1; b < Dim; ++b) node += ((k >> (b - 1)) & 1) * layout.stride((axis + b) % Dim);
    body[k] = g.body[node];
    depth[k] = std::max(-g.psi[node], 0.0);
    total += depth[k];
  }
  for (int k = 0; k < corners; ++k) {
    if (total == 0)
      visit(body[k], closed / corners);
    else if (depth[k] > 0)
      visit(body[k], closed * depth[k] / total);
  }
}

// Centres of the cells below and above a face, m.
template <int Dim>
std::array<Vec<Dim>, 2> centers_beside(const Layout<Dim>& layout, int axis, const IVec<Dim>& face) {
  IVec<Dim> below = face;
  below[axis] -= 1;
  return {layout.position(below, cell_offset<Dim>()), layout.position(face, cell_offset<Dim>())};
}

template <int Dim>
double fastest_node(const Eigen::VectorXd& velocity) {
  double fastest = 0;
  for (Eigen::Index n = 0; n + Dim <= velocity.size(); n += Dim)
    fastest = std::max(fastest, velocity.segment<Dim>(n).norm());
  return fastest;
}

// Appends a share, or adds it to the last one if that is of the same face. Shares come in the order of the faces.
void add_share(FaceShares& shares, const FaceShare& s) {
  if (!shares.empty() && shares.back().face == s.face && shares.back().axis == s.axis)
    shares.back().closed += s.closed;
  else
    shares.push_back(s);
}

}  // namespace

template <int Dim>
SolidGeometry<Dim>::SolidGeometry(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides,
                                  const std::vector<Body<Dim>>& bodies, SharedPairs shared)
    : layout_(layout), sides_(sides), bodies_(bodies), shared_(std::move(shared)) {
  still_.psi = NodeField<Dim>(layout, far_away);
  still_.body = NodeField<Dim, std::int16_t>(layout, -1);
  still_.faces = FaceGeometry<Dim>(layout);
  seams_ = find_seams(bodies, seam_gap * layout.h());
  for (const Body<Dim>& body : bodies)
    radius_.push_back(body.moves() && !body.deforms() ? surface_radius(layout, body) : 0);
  measure_static();
}

// True if the thin solid separates the centres of the adjacent cells or contains one. `distance`: signed distance (m)
// at the face's low corner.
template <int Dim>
bool SolidGeometry<Dim>::seals(const PlacedSolid<Dim>& solid, double distance, int axis, const IVec<Dim>& face) const {
  if (std::abs(distance) > 2 * layout_.h()) return false;
  const auto seals_between = [&](const Vec<Dim>& low, const Vec<Dim>& high) {
    return solid.lies_between(low, high) || solid.distance(low) < 0 || solid.distance(high) < 0;
  };
  const auto [low, high] = centers_beside(layout_, axis, face);
  if (seals_between(low, high)) return true;
  const Vec<Dim> shift = to_other_side(layout_, axis, face) * Vec<Dim>::Unit(axis);
  return shift[axis] != 0 && seals_between(low + shift, high + shift);
}

// Index of the thin static body that seals each face, or -1.
template <int Dim>
FaceField<Dim, std::int16_t> SolidGeometry<Dim>::seal_static() const {
  FaceField<Dim, std::int16_t> seal(layout_, -1);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (!bodies_[k].is_thin() || bodies_[k].moves()) continue;
    const std::unique_ptr<PlacedSolid<Dim>> solid = place_solid(layout_, bodies_[k], {});
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(layout_, measured_faces(layout_), [&](Site f, const IVec<Dim>& i) {
        const double distance =
            least_distance(layout_, i, [&](const Vec<Dim>& x) { return bodies_[k].distance_at_rest(x); });
        if (seals(*solid, distance, a, i)) seal.at(a, f) = std::int16_t(k);
      });
  }
  return seal;
}

template <int Dim>
void SolidGeometry<Dim>::measure_static() {
  bool any = false;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (bodies_[k].moves()) continue;
    any = true;
    for_each_index_in_order(layout_, layout_.padded(), [&](Site s, const IVec<Dim>& i) {
      const double d = snapped(
          least_distance(layout_, i, [&](const Vec<Dim>& x) { return bodies_[k].distance_at_rest(x); }), layout_.h());
      if (d >= still_.psi[s]) return;
      still_.psi[s] = d;
      still_.body[s] = std::int16_t(k);
    });
  }
  std::vector<FaceShares> shares(bodies_.size());
  const FaceField<Dim, std::int16_t> seal = seal_static();
  for (int a = 0; a < Dim && any; ++a)
    for_each_index_in_order(layout_, measured_faces(layout_), [&](Site f, const IVec<Dim>&) {
      const double open = open_part_of_face(layout_, still_.psi, a, f);
      const int sealing = seal.at(a, f);
      if (open == 1 && sealing < 0) return;
      still_.faces.open.set(a, f, open);
      if (open < 1)
        for_each_static_share(layout_, still_, a, f, [&](int k, double part) { add_share(shares[k], {f, a, part}); });
      if (sealing >= 0) {
        add_share(shares[sealing], {f, a, open});
        still_.sealed.push_back({f, a, sealing});
        still_.faces.open.set(a, f, 0);
      }
      still_.faces.kind.set(a, f, char(still_.faces.open.at(a, f) == 0 ? FaceKind::closed : FaceKind::open));
    });
  for (FaceShares& s : shares) still_.shares.push_back(std::make_shared<const FaceShares>(std::move(s)));
}

// Shares that body k closes without other moving bodies. Sets its attachments if it deforms.
template <int Dim>
FaceShares SolidGeometry<Dim>::measure_moving(int k, const Placement& placed, NodeField<Dim>& scratch,
                                              StepGeometry<Dim>& g) const {
  const std::unique_ptr<PlacedSolid<Dim>> solid = place_solid(layout_, bodies_[k], placed);
  const Box<Dim> box = solid->fill(scratch);
  FaceShares shares = take_in(k, *solid, box, scratch, g);
  if (!solid->deforms()) return shares;
  FaceWeights face_weights;
  for (const FaceShare& share : shares)
    face_weights.push_back(
        solid->weights_at(layout_.position(layout_.index(share.face), face_offset<Dim>(share.axis))));
  g.face_weights[k] = std::make_shared<const FaceWeights>(std::move(face_weights));
  return shares;
}

// Merges the distances of body k at the nodes of `box` into psi, appends its sealed faces, and returns its shares.
// Resets `scratch` to far_away.
template <int Dim>
FaceShares SolidGeometry<Dim>::take_in(int k, const PlacedSolid<Dim>& solid, const Box<Dim>& box,
                                       NodeField<Dim>& scratch, StepGeometry<Dim>& g) const {
  FaceShares shares;
  if (box.empty()) return shares;
  const bool whole_faces = solid.closes_whole_faces(), thin = bodies_[k].is_thin();
  for_each_index_in_order(layout_, box, [&](Site s, const IVec<Dim>&) {
    scratch[s] = snapped(scratch[s], layout_.h());
    if (whole_faces || scratch[s] >= g.psi[s]) return;
    g.psi[s] = scratch[s];
    g.body[s] = std::int16_t(k);
  });
  const Box<Dim> faces = measured_faces(layout_).cut({box.lower, box.upper.array() - 1});
  for (int a = 0; a < Dim && !faces.empty(); ++a)
    for_each_index_in_order(layout_, faces, [&](Site f, const IVec<Dim>& i) {
      const bool sealed = thin && seals(solid, scratch[f], a, i);
      const double closed = sealed ? 1 : whole_faces ? 0 : 1 - open_part_of_face(layout_, scratch, a, f);
      if (closed > 0) shares.push_back({f, a, closed});
      if (!sealed) return;
      g.sealed.push_back({f, a, k});
      solid.measure_gaps(centers_beside(layout_, a, i), g.sealed.back());
    });
  for_each_site(layout_, box, [&](Site s) { scratch[s] = far_away; });
  return shares;
}

// Static bodies keep their share of a face. Moving ones share the rest in proportion to the share that each would close
// alone. They are scaled if together they would close more, or leave a gap below the tolerance. At seams the gap from
// psi of all solids together counts, if smaller. At edges psi is not linear, so the shares of two touching solids leave
// slits. Where solids reach into each other, their shares close some parts twice: the gap from psi counts.
template <int Dim>
void SolidGeometry<Dim>::close_faces(std::vector<FaceShares>& shares, StepGeometry<Dim>& g) const {
  PagedFaceField<Dim> moving(layout_);
  for (const FaceShares& list : shares)
    for (const FaceShare& s : list) moving.add(s.axis, s.face, s.closed);
  const NodeField<Dim, char> seams = mark_seams(layout_, bodies_, seams_, g.placed);
  const NodeField<Dim, char> shared = mark_shared(layout_, bodies_, shared_, g.placed);
  for (FaceShares& list : shares)
    for (FaceShare& s : list) {
      const double room = still_.faces.open.at(s.axis, s.face), wanted = moving.at(s.axis, s.face);
      const bool alone = room == 1 && wanted == s.closed;
      double gap = room - wanted;
      const bool joined = !seams_.empty() && seams[s.face];
      const bool twice = !alone && !shared.empty() && shared[s.face];
      if (joined) gap = std::min(gap, open_part_of_face(layout_, g.psi, s.axis, s.face));
      if (twice) gap = std::min(room, open_part_of_face(layout_, g.psi, s.axis, s.face));
      const bool closes = gap <= 0 || (joined ? gap < seam_gap : !alone && gap < snap);
      if (closes) gap = 0;
      if (closes || joined || twice) s.closed *= (room - gap) / wanted;
      g.faces.open.set(s.axis, s.face, gap);
      g.faces.kind.set(s.axis, s.face, char(closes ? FaceKind::closed : FaceKind::open));
    }
}

// True if the ball of `radius` (m) about the body's pivot is clear of the domain and does not approach it.
template <int Dim>
bool SolidGeometry<Dim>::is_leaving(const Placement& placed, double radius) const {
  const Geometry<Dim>& g = layout_.geometry();
  const Vec3 center = placed.pose.apply(placed.pose.pivot), v = placed.twist.linear;
  const double clear = radius + cells_around_domain * g.h;
  for (int a = 0; a < Dim; ++a) {
    if (g.periodic[a]) continue;
    if (v[a] <= 0 && center[a] < g.lower[a] - clear) return true;
    if (v[a] >= 0 && center[a] > g.lower[a] + g.cells[a] * g.h + clear) return true;
  }
  return false;
}

template <int Dim>
StepGeometry<Dim> SolidGeometry<Dim>::measure(const std::vector<Placement>& placed, double t) const {
  StepGeometry<Dim> g = still_;
  g.placed = placed;
  g.face_weights.resize(bodies_.size());
  g.cell_fluxes.resize(bodies_.size());
  for (Placement& p : g.placed) p.twist = {{0, 0, 0}, {0, 0, 0}, p.twist.about}, p.velocity.setZero();
  NodeField<Dim> scratch;
  std::vector<FaceShares> shares(bodies_.size());
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (!bodies_[k].moves()) continue;
    if (scratch.empty()) scratch = NodeField<Dim>(layout_, far_away);
    shares[k] = measure_moving(int(k), placed[k], scratch, g);
  }
  close_faces(shares, g);
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (bodies_[k].moves()) g.shares[k] = std::make_shared<const FaceShares>(std::move(shares[k]));
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    g.pivots.push_back(placed[k].pose.apply(bodies_[k].reference_point()));
    set_motion(layout_, int(k), placed[k], g);
  }
  set_sides(t, g);
  return g;
}

template <int Dim>
void SolidGeometry<Dim>::set_sides(double t, StepGeometry<Dim>& g) const {
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2 && !layout_.geometry().periodic[a]; ++side) {
      for_each_index_in_order(layout_, padded_faces_of_side(layout_, a, side), [&](Site s, const IVec<Dim>& i) {
        if (g.faces.kind_at(a, s) == FaceKind::closed) return;
        const Vec<Dim> x = layout_.position(i, face_offset<Dim>(a));
        const bool outflow = sides_.is_outflow(a, side);
        g.faces.kind.set(a, s, char(outflow ? FaceKind::outflow : FaceKind::prescribed));
        if (outflow) g.faces.side_pressure.set(a, s, sides_.pressure(a, side, x, t));
        if (!outflow) g.faces.prescribed.set(a, s, sides_.velocity(a, side, a, x, t));
      });
    }
}

// Bound dt (|v| + |w| r) for each body, r from surface_radius(), and dt times the speed of the fastest node. Freely
// moving bodies that have left the domain do not count.
template <int Dim>
double SolidGeometry<Dim>::largest_displacement(const std::vector<Placement>& placed, double dt) const {
  double largest = 0;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Twist& v = placed[k].twist;
    largest = std::max(largest, dt * fastest_node<Dim>(placed[k].velocity));
    if (bodies_[k].is_free() && is_leaving(placed[k], radius_[k])) continue;
    largest = std::max(largest, dt * (v.linear.norm() + v.angular.norm() * radius_[k]));
  }
  return largest;
}

template struct StepGeometry<2>;
template struct StepGeometry<3>;
template class SolidGeometry<2>;
template class SolidGeometry<3>;

}  // namespace seiche
